#include "app/editor/add_actions.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/editor/icons.h"
#include "app/editor/node_actions.h"
#include "core/base/error.h"
#include "core/scene/compile.h"
#include "core/scene/node_edits.h"

namespace voledit {

namespace {

/// The object that additions go to: the selected one, or the one around the selected STF; by default the root.
std::string targetObject(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    for (std::string path = workspace.selection.node; !path.empty(); path = parentOf(scene, path))
        if (findObjectAt(scene, path)) return path;
    return kRootPath;
}

Box3 boundsOfScene(const Workspace& workspace) {
    const Box3 unit{Vec3(-1), Vec3(1)};
    return workspace.compiled.root && !workspace.compiled.root->bounds.empty() ? workspace.compiled.root->bounds : unit;
}

Transfer libraryUse(const TransferDefinition& definition, const std::string& written, bool isFile, const Box3& box) {
    LibraryTransfer use{written, isFile, {}};
    for (const TransferParameter& parameter : definition.parameters())
        if (!parameter.initial || parameter.suggested != *parameter.initial)
            use.arguments[parameter.name] = sceneArgument(parameter, suggestedFor(parameter, box));
    Transfer transfer;
    transfer.kind = std::move(use);
    return transfer;
}

/// Adds `transfer` to what is selected, with the frame that it is fitted to where it needs one.
void addToSelection(Workspace& workspace, const Transfer& transfer, const std::string& name, const std::string& title,
                    bool framed) {
    const std::string object = targetObject(workspace);
    std::string used;
    workspace.document.apply("Add " + title, [&](Scene& scene) {
        used = addTransfer(scene, object, transfer, name, std::nullopt);
        if (!framed) return;
        const auto frame = fittedFrame(workspace, scene, transferPath(used));
        if (frame) editTransferAt(scene, transferPath(used), [&](Transfer& added) { added.frame = frame; });
    });
    selectTarget(workspace, transferPath(used));
}

/// A name that is one: of letters, digits and what joins them.
std::string nameFrom(const std::string& text) {
    std::string name;
    for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '-';
    return name.empty() ? "transfer" : name;
}

void addTransferAction(Workspace& workspace, const std::string& argument) {
    if (argument == "lattice" || argument == "ffd") {
        Transfer lattice;
        lattice.kind = FfdTransfer{};
        return addToSelection(workspace, lattice, "lattice", "lattice", true);
    }
    if (argument == "expression") {
        Transfer expression;
        expression.kind = ExpressionTransfer{"x", "y", "z", "", {}, false, {}};
        return addToSelection(workspace, expression, "expression", "expression", true);
    }
    const TransferDefinitionPtr definition = libraryTransfer(argument);
    if (!definition) {
        std::string names = "lattice, expression";
        for (const TransferDefinitionPtr& known : transferLibrary()) names += ", " + known->name();
        throw Error("transfer.add", "there is no transfer \"" + argument + "\"", "there are " + names);
    }
    addToSelection(workspace, libraryUse(*definition, argument, false, boundsOfScene(workspace)), argument,
                   definition->name(), definition->usesFrame());
}

void addFileAction(Workspace& workspace, const std::string& argument) {
    const std::string written = writtenPath(argument, workspace.folder);
    workspace.formulaFiles.read(written, workspace.folder, workspace.assets);
    workspace.formulaFiles.remember(argument);
    const TransferDefinition& definition = *workspace.assets.transfers.at(written);
    addToSelection(workspace, libraryUse(definition, written, true, boundsOfScene(workspace)),
                   nameFrom(std::filesystem::path(argument).stem().string()), definition.name(),
                   definition.usesFrame());
}

std::string freeObjectName(const Scene& scene, const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; scene.objects.contains(name); ++n) name = wanted + "-" + std::to_string(n);
    return name;
}

/// The target of additions and a new solid of shape `shape`, under `by`.
void combineWithSolid(Workspace& workspace, CvgOperator by, const std::string& shape, const std::string& title) {
    const std::string object = targetObject(workspace);
    const SolidObject solid = solidNamed(shape, boundsOfScene(workspace));
    std::string name;
    workspace.document.apply(title, [&](Scene& scene) {
        name = freeObjectName(scene, shape);
        scene.objects[name] = Object{solid};
        CvgObject cvg;
        cvg.by = by;
        cvg.of = {Object{}, Object{ObjectUse{name}}};
        if (by == CvgOperator::Blend) cvg.weight = Field{NumberField{0.5}};
        wrapObject(scene, object, Object{cvg});
    });
    selectTarget(workspace, objectPath(name));
}

void combineAction(Workspace& workspace, const std::string& argument) {
    const std::string word = argument.substr(0, argument.find(' '));
    const std::string shape = word.size() < argument.size() ? argument.substr(word.size() + 1) : "sphere";
    const auto& choices = combineChoices();
    const auto at =
        std::find_if(choices.begin(), choices.end(), [&](const AddChoice& choice) { return word == choice.name; });
    if (at == choices.end())
        throw Error("object.combine", "there is no operator \"" + word + "\"",
                    "there are union, intersection, difference, merge, cap, trim, blend");
    combineWithSolid(workspace, CvgOperator(at - choices.begin()), shape, std::string("Add ") + word);
}

void wrapAction(Workspace& workspace, const std::string& argument) {
    const std::string object = targetObject(workspace);
    Object outer;
    if (argument == "place") {
        outer.kind = PlaceObject{};
    } else if (argument == "recolor") {
        RecolorObject recolor;
        recolor.opacity = Tracked<PiecewiseLinear>(PiecewiseLinear{{{0, 0}, {1, 1}}});
        outer.kind = recolor;
    } else if (argument == "displace") {
        const TransferDefinitionPtr twist = libraryTransfer("twist");
        if (!twist) throw Error("object.wrap", "the library has no twist to begin with", {});
        const OfDisplacement whole{libraryUse(*twist, "twist", false, boundsOfScene(workspace))};
        outer.kind = DisplaceObject{Displacement{ScaleDisplacement{Field{NumberField{0.5}}, Displacement{whole}}}, {}};
    } else {
        throw Error("object.wrap", "there is no \"" + argument + "\"", "there are place, recolor, displace");
    }
    workspace.document.apply("Add " + argument, [&](Scene& scene) { wrapObject(scene, object, outer); });
    selectAndReveal(workspace, object);
}

}  // namespace

void addAddActions(Actions& actions, Workspace& workspace, const std::function<void()>& chooseFile) {
    const auto open = [&workspace] { return workspace.open; };
    actions.add({"add.menu", "Add…", "Shift+A", "", "A menu of deformations and objects to add to what is selected",
                 [&](const std::string&) { workspace.addMenuWanted = true; }, open});
    actions.add({"transfer.add", "Add Transfer…", "", "NAME",
                 "Adds a deformation to what is selected: lattice, expression, or one of the library",
                 [&](const std::string& argument) { addTransferAction(workspace, argument); }, open});
    actions.add({"transfer.add-file", "Formula File…", "", "PATH",
                 "Adds a deformation that a formula file (.stf) describes; the file stays where it is",
                 [&workspace, chooseFile](const std::string& argument) {
                     if (argument.empty())
                         chooseFile();
                     else
                         addFileAction(workspace, argument);
                 },
                 open});
    actions.add({"solid.add", "Add Solid…", "", "SHAPE",
                 "Joins a sphere, box, cylinder, capsule, torus, text or expression",
                 [&](const std::string& argument) {
                     combineWithSolid(workspace, CvgOperator::Union, argument, "Add " + argument);
                 },
                 open});
    actions.add({"object.combine", "Combine with a Solid…", "", "OPERATOR [SHAPE]",
                 "Combines what is selected with a new solid: union, intersection, difference, merge, cap, trim, blend",
                 [&](const std::string& argument) { combineAction(workspace, argument); }, open});
    actions.add({"object.wrap", "Put Around…", "", "KIND", "Puts a place, recolor or displace around what is selected",
                 [&](const std::string& argument) { wrapAction(workspace, argument); }, open});
}

std::optional<TrackedFrame> fittedFrame(const Workspace& workspace, const Scene& scene, const std::string& path) {
    try {
        Scene without = scene;
        editTransferAt(without, path, [](Transfer& transfer) { transfer.frame.reset(); });
        const Scene written = withDefaultsWrittenOut(without, workspace.assets);
        const Transfer* transfer = findTransferAt(written, path);
        return transfer ? transfer->frame : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

const std::vector<AddChoice>& solidChoices() {
    static const std::vector<AddChoice> choices{
        {"sphere", "Sphere", icons::kSolid, "A ball"},
        {"box", "Box", icons::kVolume, "A box along the axes"},
        {"cylinder", "Cylinder", icons::kSolid, "A round rod with flat ends"},
        {"capsule", "Capsule", icons::kSolid, "A round rod with round ends"},
        {"torus", "Torus", icons::kSolid, "A ring"},
        {"text", "Text", icons::kText, "Letters standing in the x–z plane"},
        {"expression", "Shape by a formula", icons::kFormula, "A signed distance, typed as a formula"},
    };
    return choices;
}

const std::vector<AddChoice>& combineChoices() {
    static const std::vector<AddChoice> choices{
        {"union", "Union", icons::kCombine, "The denser of the two at each place"},
        {"intersection", "Intersection", icons::kCombine, "The thinner of the two: what lies in the solid"},
        {"difference", "Difference", icons::kCombine, "The selection less the solid: cuts a hole"},
        {"merge", "Merge", icons::kCombine, "Both added up, colours mixed"},
        {"cap", "Cap", icons::kCombine, "The selection where it is no denser than the solid"},
        {"trim", "Trim", icons::kCombine, "The selection where it is no thinner than the solid"},
        {"blend", "Blend", icons::kCombine, "A weighted mean of the two"},
    };
    return choices;
}

const std::vector<AddChoice>& wrapChoices() {
    static const std::vector<AddChoice> choices{
        {"place", "Place", icons::kPlace, "Moves, turns and scales what is selected"},
        {"recolor", "Recolour", icons::kRecolor, "Colour and opacity as tables over an attribute"},
        {"displace", "Displace", icons::kDisplace, "A displacement to scale and combine: begins with half a twist"},
    };
    return choices;
}

SolidObject solidNamed(const std::string& name, const Box3& box) {
    const Vec3 center = 0.5 * (box.min + box.max), size = box.size();
    const double r = 0.25 * std::max({size.x, size.y, size.z});
    const Vec3 up{0, 0, r};
    SolidObject solid;
    solid.color = Vec3(0.80, 0.62, 0.42);
    if (name == "sphere")
        solid.shape = SolidSphere{center, r};
    else if (name == "box")
        solid.shape = SolidBox{Box3{center - Vec3(r), center + Vec3(r)}};
    else if (name == "cylinder")
        solid.shape = SolidCylinder{center - up, center + up, 0.5 * r};
    else if (name == "capsule")
        solid.shape = SolidCapsule{center - up, center + up, 0.5 * r};
    else if (name == "torus")
        solid.shape = SolidTorus{center, Vec3(0, 0, 1), r, 0.3 * r};
    else if (name == "text")
        solid.shape = SolidText{"Text", r, 0.25 * r};
    else if (name == "expression")
        solid.shape = SolidFormula{"length([x, y, z]) - " + std::to_string(r), Box3{Vec3(-1.1 * r), Vec3(1.1 * r)}};
    else
        throw Error("solid.add", "there is no shape \"" + name + "\"",
                    "there are sphere, box, cylinder, capsule, torus, text, expression");
    return solid;
}

}  // namespace voledit
