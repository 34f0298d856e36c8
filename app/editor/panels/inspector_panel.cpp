#include "app/editor/panels/inspector_panel.h"

#include <imgui.h>

#include "app/editor/panels/inspectors.h"
#include "app/editor/scene_tree.h"
#include "app/editor/theme.h"
#include "core/scene/nodes.h"

namespace voledit {

namespace {

/// The lengths of what a node acts on: its own frame's, else the whole object's.
Box3 boxOf(const Workspace& workspace, const std::string& path) {
    const Transfer* transfer = findTransferAt(workspace.document.scene(), path);
    if (transfer && transfer->frame) return boundsOf(transfer->frame->at(workspace.time));
    return workspace.compiled.root ? workspace.compiled.root->bounds : Box3{};
}

void heading(const Workspace& workspace, const std::string& path) {
    const std::vector<SceneRow> rows = sceneRows(workspace.document.scene(), {});
    const SceneRow* row = rowAt(rows, path);
    if (!row) return;
    ImGui::PushFont(font(FontRole::Strong));
    ImGui::TextUnformatted((std::string(row->icon) + "  " + row->label).c_str());
    ImGui::PopFont();
    noteWidget("Title");
    if (!row->detail.empty()) ui::finePrint(row->detail);
}

/// What is odd about the node at `path`: a deflection that folds.
void drawWarnings(const Workspace& workspace, const std::string& path) {
    for (const std::string& warning : workspace.compiled.warnings)
        if (warning.starts_with(path + ": ")) ui::warning(warning.substr(path.size() + 2));
}

}  // namespace

void InspectorPanel::draw(Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    // Of a `use`, what it names is inspected.
    const std::string path = followedUse(scene, workspace.selection.node);
    if (path != state_.shown) {
        state_ = InspectorState{};
        state_.shown = path;
    }
    if (!workspace.document.previewing() || state_.box.empty()) state_.box = boxOf(workspace, path);
    heading(workspace, workspace.selection.node);
    drawWarnings(workspace, path);
    Inspection inspection(workspace, state_, path);
    // Whole copies go back: a preview starts from the last commit and holds this one edit.
    if (const Transfer* at = findTransferAt(scene, path)) {
        Transfer transfer = *at;
        inspection.write = [&](Scene& s) { editTransferAt(s, path, [&](Transfer& t) { t = transfer; }); };
        inspectTransfer(inspection, transfer);
        inspection.finish();
    } else if (const Object* object = findObjectAt(scene, path)) {
        Object copy = *object;
        inspection.write = [&](Scene& s) { editObjectAt(s, path, [&](Object& o) { o = copy; }); };
        inspectObject(inspection, copy);
        inspection.finish();
    } else if (const Displacement* displacement = findDisplacementAt(scene, path)) {
        Displacement copy = *displacement;
        inspection.write = [&](Scene& s) { editDisplacementAt(s, path, [&](Displacement& d) { d = copy; }); };
        inspectDisplacement(inspection, copy);
        inspection.finish();
    } else if (const Field* field = findFieldAt(scene, path)) {
        Field copy = *field;
        inspection.write = [&](Scene& s) { editFieldAt(s, path, [&](Field& f) { f = copy; }); };
        inspectField(inspection, copy);
        inspection.finish();
    }
    if (const auto wrong = state_.formulas.typingWrong()) workspace.pending.wrong = *wrong;
}

bool hasInspector(const Workspace& workspace) {
    return workspace.open && !workspace.selection.node.empty() && workspace.selection.lattice.empty();
}

}  // namespace voledit
