#include <imgui.h>

#include <algorithm>

#include "app/editor/add_actions.h"
#include "app/editor/panels/inspectors.h"
#include "core/base/error.h"
#include "core/scene/compile.h"
#include "core/scene/node_edits.h"

namespace voledit {

namespace {

bool isBox(const Frame& frame) {
    return frame == frameOf(boundsOf(frame));
}

void frameRows(Inspection& inspection, Transfer& transfer) {
    ui::heading("FRAME");
    if (transfer.frame) {
        if (transfer.frame->animated()) {
            ui::note("Changes over time.");
        } else if (isBox(*transfer.frame)) {
            const Box3 box = boundsOf(*transfer.frame);
            Tracked<Vec3> min = box.min, max = box.max;
            inspection.position("Frame min", "", min, "Lower corner of the box that the formulas call 0");
            inspection.position("Frame max", "", max, "Upper corner of the box that the formulas call 1");
            const bool solid = min->x < max->x && min->y < max->y && min->z < max->z;
            if (solid && (*min != box.min || *max != box.max)) transfer.frame = TrackedFrame(frameOf(Box3{min, max}));
        } else {
            ui::note("An oblique frame, as the file gives it.");
        }
    } else {
        ui::note("The object's box, at the timeline's start.");
    }
    const bool fit = ui::button("Fit to object", "Sets the frame to the box of the object as it is before this");
    if (!fit) return;
    if (const auto frame =
            fittedFrame(inspection.workspace(), inspection.workspace().document.scene(), inspection.path())) {
        transfer.frame = frame;
        inspection.note({true, true, false}, "Fit frame");
    }
}

void amountRows(Inspection& inspection, Transfer& transfer, bool usesOutside) {
    NumberFormat share{0, 1, 0, 2};
    inspection.tracked("Amount", "/amount", transfer.amount, [&](double& now) {
        return ui::slider("Amount", now, share, "How much of the deformation is applied; 0 is none of it");
    });
    if (usesOutside) {
        static const std::vector<std::string> kinds{"Hide", "Keep"};
        int outside = transfer.outside.value_or(Outside::Hide) == Outside::Keep ? 1 : 0;
        const Edit edit =
            ui::choice("Outside", outside, kinds, "What lies outside its domain: hidden, or kept as it is");
        if (edit.changed) transfer.outside = outside == 1 ? Outside::Keep : Outside::Hide;
        inspection.note(edit, "Change outside");
    }
    const Edit edit = ui::checkbox("Enabled", transfer.enabled, "Switched off it leaves things as they are (H)");
    inspection.note(edit, transfer.enabled ? "Enable" : "Disable");
}

void inspectLets(Inspection& inspection, ExpressionTransfer& expression) {
    ui::heading("LET");
    auto& lets = expression.let;
    std::optional<std::size_t> gone;
    for (std::size_t i = 0; i < lets.size(); ++i) {
        ImGui::PushID(int(i));
        const std::string number = std::to_string(i + 1);
        std::string name = lets[i].first;
        Edit named = ui::text(("Name " + number).c_str(), name, "What the formulas that follow call it");
        named.changed &= !name.empty();
        if (named.changed) lets[i].first = name;
        inspection.note(named, "Rename let");
        inspection.formula(("Let " + number).c_str(), "/let/" + std::to_string(i), lets[i].second,
                           [&](const std::string& to) { lets[i].second = to; });
        if (ui::button(("Remove##let " + number).c_str(), "Removes this name")) gone = i;
        noteWidget("Remove let " + number);
        ImGui::PopID();
    }
    if (gone) {
        lets.erase(lets.begin() + std::ptrdiff_t(*gone));
        inspection.note({true, true, false}, "Remove let");
    } else if (ui::button("Add let", "Names a part that the formulas use more than once")) {
        lets.emplace_back("a" + std::to_string(lets.size() + 1), "0");
        inspection.note({true, true, false}, "Add let");
    }
}

void inspectExpression(Inspection& inspection, ExpressionTransfer& expression) {
    ui::note("Where each point of the deformed object comes from. x, y, z are the point, t the time in seconds.");
    static const std::vector<std::string> spaces{"Normalised", "World"};
    int space = expression.world ? 1 : 0;
    const Edit edit =
        ui::choice("Space", space, spaces, "Normalised: 0 to 1 over the frame. World: the scene's units.");
    if (edit.changed) expression.world = space == 1;
    inspection.note(edit, "Change space");
    const auto row = [&](const char* label, const char* member, std::string& formula, const char* help) {
        inspection.formula(
            label, member, formula, [&](const std::string& to) { formula = to; }, help);
    };
    row("X", "/x", expression.x, "Enter: done.  Ctrl+Enter: new line.  Esc: as it was.");
    row("Y", "/y", expression.y, "Enter: done.  Ctrl+Enter: new line.  Esc: as it was.");
    row("Z", "/z", expression.z, "Enter: done.  Ctrl+Enter: new line.  Esc: as it was.");
    row("Undefined", "/undefined", expression.undefined,
        "A condition, for example x < 0.5: where it holds there is nothing. Empty: nowhere.");
    inspectLets(inspection, expression);
}

void inspectFields(Inspection& inspection, FieldsTransfer& fields) {
    const bool volume = !fields.asset.empty();
    ui::note(volume ? "The values of \"" + fields.asset + "\", three components, in world units."
                    : "Three scalar fields in world units.");
    const ParameterFormat any;
    if (!volume) {
        inspection.field("X", "/x", fields.fields[0], any);
        inspection.field("Y", "/y", fields.fields[1], any);
        inspection.field("Z", "/z", fields.fields[2], any);
    }
    const Edit edit = ui::checkbox("Displacement", fields.displacement,
                                   "The fields are what is added to a point, not where it comes from");
    inspection.note(edit, "Change displacement");
}

void inspectMapped(const MappedTransfer& mapped) {
    ui::note(std::to_string(mapped.points->size()) + " points in " + std::to_string(mapped.cells.size()) +
             " cells, as the file gives them.");
}

bool usesFrame(const Transfer& transfer, const LoadedAssets& assets) {
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind)) {
        const TransferDefinitionPtr definition = definitionOf(*library, assets);
        return definition && definition->usesFrame();
    }
    const auto* expression = std::get_if<ExpressionTransfer>(&transfer.kind);
    return std::holds_alternative<FfdTransfer>(transfer.kind) || (expression && !expression->world);
}

bool usesOutside(const Transfer& transfer, const LoadedAssets& assets) {
    if (const auto* library = std::get_if<LibraryTransfer>(&transfer.kind)) {
        const TransferDefinitionPtr definition = definitionOf(*library, assets);
        return definition && definition->usesOutside();
    }
    return std::holds_alternative<FfdTransfer>(transfer.kind) ||
           std::holds_alternative<MappedTransfer>(transfer.kind) ||
           std::holds_alternative<FieldsTransfer>(transfer.kind);
}

}  // namespace

void inspectTransfer(Inspection& inspection, Transfer& transfer) {
    if (auto* library = std::get_if<LibraryTransfer>(&transfer.kind)) inspectLibraryTransfer(inspection, *library);
    if (auto* expression = std::get_if<ExpressionTransfer>(&transfer.kind)) inspectExpression(inspection, *expression);
    if (auto* affine = std::get_if<AffineTransfer>(&transfer.kind)) inspection.placementRows(affine->placement);
    if (auto* fields = std::get_if<FieldsTransfer>(&transfer.kind)) inspectFields(inspection, *fields);
    if (const auto* mapped = std::get_if<MappedTransfer>(&transfer.kind)) inspectMapped(*mapped);
    if (const auto* skeleton = std::get_if<SkeletonTransfer>(&transfer.kind))
        ui::note("Limb " + skeleton->limb + " of a skeleton, as the file gives it.");
    if (std::holds_alternative<SequenceTransfer>(transfer.kind)) ui::note("Applied in order, the first first.");
    if (std::holds_alternative<TransferredTransfer>(transfer.kind)) ui::note("The second, moved by the first.");
    ui::heading("STRENGTH");
    amountRows(inspection, transfer, usesOutside(transfer, inspection.workspace().assets));
    if (usesFrame(transfer, inspection.workspace().assets)) frameRows(inspection, transfer);
}

}  // namespace voledit
