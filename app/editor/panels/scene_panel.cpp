#include "app/editor/panels/scene_panel.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/editor/add_menu.h"
#include "app/editor/icons.h"
#include "app/editor/node_actions.h"
#include "app/editor/scene_tree.h"
#include "app/editor/theme.h"
#include "app/editor/tree_row.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace {

constexpr const char* kDragged = "voledit node";
constexpr const char* kRowMenu = "row menu";

TreeRow lookOf(const Workspace& workspace, const SceneRow& row) {
    TreeRow look;
    look.name = row.widget;
    look.label = row.label;
    look.detail =
        row.unused && row.depth == 0 ? row.detail + (row.detail.empty() ? "" : "  ·  ") + "unused" : row.detail;
    look.icon = row.icon;
    look.depth = row.depth;
    look.parent = row.parent;
    look.open = row.open;
    look.selected = workspace.selection.node == row.path;
    look.link = row.link && row.repeated;
    look.on = row.on;
    if (row.on) look.eyeHelp = std::string(*row.on ? "Switch off" : "Switch on") + " this deformation (H)";
    look.scrollTo = workspace.tree.reveal == row.path;
    look.help = row.label + (row.detail.empty() ? "" : "  ·  " + row.detail);
    if (row.repeated) look.help += "\nShared: the same as further up; edits show in both places.";
    return look;
}

/// Dropping a dragged row on another of the same list moves it there.
void dragAndDrop(Workspace& workspace, const SceneRow& row) {
    if (ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceNoHoldToOpenOthers)) {
        ImGui::SetDragDropPayload(kDragged, row.path.data(), row.path.size());
        ImGui::TextUnformatted((std::string(row.icon) + "  " + row.label).c_str());
        ImGui::EndDragDropSource();
    }
    if (!ImGui::BeginDragDropTarget()) return;
    const ImGuiPayload* payload = ImGui::GetDragDropPayload();
    const std::string dragged =
        payload && payload->IsDataType(kDragged)
            ? std::string(static_cast<const char*>(payload->Data), std::size_t(payload->DataSize))
            : "";
    const auto from = listPlace(dragged), to = listPlace(row.path);
    if (from && to && from->list == to->list && from->index != to->index) {
        const bool down = to->index > from->index;
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        const float y = down ? max.y : min.y;
        ImGui::GetWindowDrawList()->AddLine({min.x, y}, {max.x, y}, packed(theme::kAccent),
                                            std::max(1.0f, 2 * workspace.scale));
        if (ImGui::AcceptDragDropPayload(kDragged, ImGuiDragDropFlags_AcceptNoDrawDefaultRect))
            moveTransferTo(workspace, dragged, to->index);
    }
    ImGui::EndDragDropTarget();
}

void rowMenu(Workspace& workspace) {
    if (!ImGui::BeginPopup(kRowMenu)) return;
    const WidgetScope scope("Node");
    const Actions& actions = workspace.actions;
    const bool add = ImGui::BeginMenu("Add");
    noteWidget("Add");
    if (add) {
        drawAddMenu(workspace);
        ImGui::EndMenu();
    }
    ImGui::Separator();
    for (const char* id : {"node.enable", "node.rename", "node.move-up", "node.move-down"})
        ui::actionMenuItem(actions, id);
    ImGui::Separator();
    ui::actionMenuItem(actions, "node.delete");
    ImGui::EndPopup();
}

void typedName(Workspace& workspace, const TreeRowEvents& events) {
    if (!events.nameDone && !events.nameDropped) return;
    TreeState& tree = workspace.tree;
    const std::string typed = tree.typed;
    tree.renaming.clear();
    if (events.nameDone && !typed.empty()) workspace.actions.run("node.rename", typed);
}

void drawRow(Workspace& workspace, const SceneRow& row) {
    TreeState& tree = workspace.tree;
    TreeRow look = lookOf(workspace, row);
    const bool typing = tree.renaming == row.path;
    if (typing) {
        look.edited = &tree.typed;
        look.focus = std::exchange(tree.beginTyping, false);
    }
    const TreeRowEvents events = ui::treeRow(look);
    if (typing) return typedName(workspace, events);
    dragAndDrop(workspace, row);
    if (events.arrow) {
        if (!tree.closed.erase(row.path)) tree.closed.insert(row.path);
        return;
    }
    if (events.clicked || events.menu) selectNode(workspace, row.path);
    if (events.menu) ImGui::OpenPopup(kRowMenu);
    if (events.doubleClicked && !events.arrow) workspace.actions.run("node.rename");
    if (events.eye) enableNode(workspace, row, !*row.on);
}

void drawTools(const Workspace& workspace) {
    const Actions& actions = workspace.actions;
    const float side = ImGui::GetFrameHeight() * 1.1f;
    if (ui::button((std::string(icons::kAdd) + " Add###Add").c_str(), actions.tooltip("add.menu")))
        actions.run("add.menu");
    noteWidget("Add");
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 3 * side);
    ui::actionButton(actions, "node.move-up", icons::kUp);
    ImGui::SameLine(0, 0);
    ui::actionButton(actions, "node.move-down", icons::kDown);
    ImGui::SameLine(0, 0);
    ui::actionButton(actions, "node.delete", icons::kRemove);
}

}  // namespace

void drawScenePanel(Workspace& workspace) {
    if (!workspace.open) return ui::note("Nothing is open. Drop a volume or a scene here, or use File > Open.");
    drawTools(workspace);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
    // A copy: a row may change the scene.
    for (const SceneRow& row : sceneRows(workspace.document.scene(), workspace.tree.closed)) drawRow(workspace, row);
    ImGui::PopStyleVar();
    workspace.tree.reveal.clear();
    rowMenu(workspace);
}

}  // namespace voledit
