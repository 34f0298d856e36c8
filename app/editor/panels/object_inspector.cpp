#include <algorithm>
#include <array>
#include <cstdio>

#include "app/editor/panels/inspectors.h"
#include "core/scene/node_edits.h"

namespace voledit {

namespace {

const ParameterFormat kShare{{0, 1, 0, 2}, {0, 1}};
const ParameterFormat kAnyNumber{};

std::string numberText(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

/// "512 × 512 × 174  ·  int16", spacing and values on lines of their own.
std::string describe(const Volume& volume) {
    const VolumeGrid& grid = volume.grid();
    const Vec3 spacing = grid.spacing();
    std::string text = std::to_string(grid.size.x) + " × " + std::to_string(grid.size.y) + " × " +
                       std::to_string(grid.size.z) + "  ·  " + std::string(nameOf(volume.type()));
    if (grid.channels > 1) text += " × " + std::to_string(grid.channels);
    return text + "\nspacing " + numberText(spacing.x) + " × " + numberText(spacing.y) + " × " + numberText(spacing.z) +
           "\nvalues " + numberText(volume.statistics().min) + " … " + numberText(volume.statistics().max);
}

void inspectVolume(Inspection& inspection, VolumeObject& volume) {
    const Workspace& workspace = inspection.workspace();
    const auto loaded = workspace.assets.volumes.find(volume.asset);
    if (loaded != workspace.assets.volumes.end() && loaded->second) {
        ui::finePrint(describe(*loaded->second));
        const int channels = loaded->second->grid().channels;
        if (channels > 1) {
            const Edit edit = ui::integer("Channel", volume.channel, 0, channels - 1, "Which of the file's values");
            inspection.note(edit, "Change channel");
        }
    }
    static const std::vector<std::string> kinds{"Linear", "Nearest", "Cubic"};
    static constexpr std::array kValues{Interpolation::Linear, Interpolation::Nearest, Interpolation::Cubic};
    int index = int(std::find(kValues.begin(), kValues.end(), volume.interpolation) - kValues.begin());
    const Edit edit =
        ui::choice("Interpolation", index, kinds, "Between samples. Cubic is a B-spline: smoother, and slower.");
    if (edit.changed) volume.interpolation = kValues[std::size_t(index)];
    inspection.note(edit, "Change interpolation");
}

// ---- Solids -------------------------------------------------------------------------------------------------------

constexpr double kSmallest = 1e-6;  // of sizes, which must be above 0

void shapeRows(Inspection& in, SolidSphere& sphere) {
    in.position("Center", "/shape/sphere/center", sphere.center);
    in.length("Radius", "/shape/sphere/radius", sphere.radius, kSmallest);
}
void shapeRows(Inspection& in, SolidBox& box) {
    in.boxRows("Min", "Max", "/shape/box", box.box);
}
void shapeRows(Inspection& in, SolidCylinder& cylinder) {
    in.position("From", "/shape/cylinder/from", cylinder.from, "Centre of one end");
    in.position("To", "/shape/cylinder/to", cylinder.to, "Centre of the other end");
    in.length("Radius", "/shape/cylinder/radius", cylinder.radius, kSmallest);
}
void shapeRows(Inspection& in, SolidCapsule& capsule) {
    in.position("From", "/shape/capsule/from", capsule.from, "Centre of one round end");
    in.position("To", "/shape/capsule/to", capsule.to, "Centre of the other round end");
    in.length("Radius", "/shape/capsule/radius", capsule.radius, kSmallest);
}
void shapeRows(Inspection& in, SolidTorus& torus) {
    in.position("Center", "/shape/torus/center", torus.center);
    in.direction("Axis", "/shape/torus/axis", torus.axis, "Which it goes round");
    in.length("Major", "/shape/torus/major", torus.major, kSmallest, "From the centre to the middle of the tube");
    in.length("Minor", "/shape/torus/minor", torus.minor, kSmallest, "Radius of the tube");
}
void shapeRows(Inspection& in, SolidText& text) {
    std::string string = text.string;
    Edit edit = ui::text("Text", string, "Letters that stand in the x–z plane");
    edit.changed &= string.find_first_not_of(" \t\n") != string.npos;
    if (edit.changed) text.string = string;
    in.note(edit, "Change text");
    in.length("Height", "/shape/text/height", text.height, kSmallest, "Of capital letters");
    in.length("Depth", "/shape/text/depth", text.depth, kSmallest, "Along y");
}
void shapeRows(Inspection& in, SolidFormula& shape) {
    in.formula(
        "Distance", "/shape/expression/d", shape.d, [&](const std::string& to) { shape.d = to; },
        "Signed distance to the surface over x, y, z, t: negative inside");
    in.boxRows("Min", "Max", "/shape/expression/bounds", shape.bounds);
}

// ---- Recolouring --------------------------------------------------------------------------------------------------

/// The tables that are shown: a missing one leaves things as they are, and is drawn as a grey ramp, as opacity 0 to 1.
TransferFunction tablesOf(const RecolorObject& recolor, const VolumeStatistics& range, double time) {
    TransferFunction tables = greyRamp(range.min, range.max);
    if (recolor.color) tables.color = recolor.color->at(time);
    if (recolor.opacity) tables.opacity = recolor.opacity->at(time);
    return tables;
}

/// The values that `from` can have: those of the loaded volumes for "scalar", else 0 … 1.
VolumeStatistics valuesOf(const std::string& from, const LoadedVolumes& volumes) {
    VolumeStatistics range;
    range.max = 1;
    if (from != "scalar") return range;
    for (const auto& [name, volume] : volumes)
        if (volume) return volume->statistics();
    return range;
}

void recolorRows(Inspection& in, RecolorObject& recolor) {
    ui::note("Colour and opacity as tables over an attribute of what is below.");
    std::string from = recolor.from;
    Edit edit = ui::text("From", from, "opacity, r, g, b, scalar (of a volume), or a named attribute");
    edit.changed &= !from.empty();
    if (edit.changed) recolor.from = from;
    in.note(edit, "Change attribute");

    const Workspace& workspace = in.workspace();
    const VolumeStatistics range = valuesOf(recolor.from, workspace.assets.volumes);
    const TransferFunction shown = tablesOf(recolor, range, workspace.time);
    const Object* before = findObjectAt(workspace.document.committed(), in.path());
    const auto* committed = before ? std::get_if<RecolorObject>(&before->kind) : nullptr;
    const TransferPlot::Result result =
        in.plot().draw(shown, committed ? tablesOf(*committed, range, workspace.time) : shown, range);
    if (result.function.color != shown.color) recolor.color = Tracked<ColorTable>(result.function.color);
    if (result.function.opacity != shown.opacity) recolor.opacity = Tracked<PiecewiseLinear>(result.function.opacity);
    in.note(result.edit, result.step);
    const auto present = [&](const char* label, auto& table, const auto& start, const char* help) {
        bool has = table.has_value();
        const Edit switched = ui::checkbox(label, has, help);
        if (switched.changed && has) table = start;
        if (switched.changed && !has) table.reset();
        // One of the two there must be.
        if (!recolor.color && !recolor.opacity) table = start;
        in.note(switched, "Change tables");
    };
    present("Colour", recolor.color, Tracked<ColorTable>(shown.color), "Whether the table changes colour");
    present("Opacity", recolor.opacity, Tracked<PiecewiseLinear>(shown.opacity), "Whether the table changes opacity");
}

// ---- The others ---------------------------------------------------------------------------------------------------

void cvgRows(Inspection& in, CvgObject& cvg) {
    static const std::vector<std::string> kNames{"Union", "Intersection", "Difference", "Merge",
                                                 "Cap",   "Trim",         "Blend"};
    static constexpr const char* kHelp[] = {"The denser of the two at each place",
                                            "The thinner of the two at each place",
                                            "The first less the second",
                                            "Both added up, colours mixed",
                                            "The first where it is no denser than the second",
                                            "The first where it is no thinner than the second",
                                            "A weighted mean of two"};
    // Blend takes two, the others two or more.
    const std::size_t count = cvg.of.size() == 2 ? kNames.size() : kNames.size() - 1;
    int index = int(cvg.by);
    const Edit edit = ui::combo("Operator", index, std::span(kNames.data(), count), kHelp[std::size_t(cvg.by)]);
    if (edit.changed) {
        if (CvgOperator(index) == CvgOperator::Blend && cvg.by != CvgOperator::Blend)
            cvg.weight = Field{NumberField{0.5}};
        if (CvgOperator(index) != CvgOperator::Blend) cvg.weight = FieldRef{};
        cvg.by = CvgOperator(index);
    }
    in.note(edit, "Change operator");
    ui::note(kHelp[std::size_t(cvg.by)]);
    if (cvg.by == CvgOperator::Blend) in.field("Weight", "/weight", cvg.weight, kShare, "0 is the first, 1 the second");
}

void fieldsRows(Inspection& in, FieldsObject& fields) {
    in.field("Opacity", "/opacity", fields.opacity, kShare);
    static constexpr const char* kColors[] = {"Red", "Green", "Blue"};
    for (std::size_t c = 0; c < 3; ++c) in.field(kColors[c], "/color/" + std::to_string(c), fields.color[c], kShare);
    for (auto& [name, field] : fields.attributes) in.field(name.c_str(), "/" + name, field, kAnyNumber);
    ui::heading("BOUNDS");
    in.boxRows("Min", "Max", "/bounds", fields.bounds);
    ui::note("Outside there is nothing.");
}

void combineRows(Inspection& in, TransferObject& transfer) {
    ui::note(std::to_string(transfer.by.size()) + (transfer.by.size() == 1 ? " deformation" : " deformations") +
             ", applied in order, the first first.");
    static const std::vector<std::string> kinds{"Union", "Merge", "Intersection", "First"};
    int index = int(transfer.combine);
    const Edit edit = ui::combo("Combine", index, kinds, "Where a deformation folds and a place shows several parts");
    if (edit.changed) transfer.combine = Combine(index);
    in.note(edit, "Change combine");
}

}  // namespace

void inspectSolid(Inspection& inspection, SolidObject& solid) {
    std::visit([&](auto& shape) { shapeRows(inspection, shape); }, solid.shape);
    ui::heading("LOOK");
    inspection.tracked("Color", "/color", solid.color, [](Vec3& now) { return ui::color("Color", now); });
    inspection.scalar("Opacity", "/opacity", solid.opacity, kShare,
                      "A number, or a formula over x, y, z, r (distance from the centre), d (signed distance)");
    inspection.length("Falloff", "/falloff", solid.falloff, 0, "Length over which opacity fades outside the surface");
}

void inspectObject(Inspection& inspection, Object& object) {
    if (auto* volume = std::get_if<VolumeObject>(&object.kind)) inspectVolume(inspection, *volume);
    if (auto* solid = std::get_if<SolidObject>(&object.kind)) inspectSolid(inspection, *solid);
    if (auto* fields = std::get_if<FieldsObject>(&object.kind)) fieldsRows(inspection, *fields);
    if (auto* cvg = std::get_if<CvgObject>(&object.kind)) cvgRows(inspection, *cvg);
    if (auto* transfer = std::get_if<TransferObject>(&object.kind)) combineRows(inspection, *transfer);
    if (auto* place = std::get_if<PlaceObject>(&object.kind)) inspection.placementRows(place->placement);
    if (auto* recolor = std::get_if<RecolorObject>(&object.kind)) recolorRows(inspection, *recolor);
    if (auto* actor = std::get_if<ActorObject>(&object.kind)) inspectActor(inspection, *actor);
    if (std::holds_alternative<DisplaceObject>(object.kind))
        ui::note("Each point shows what lies at it plus the displacement.");
}

}  // namespace voledit
