#include "app/editor/panels/scene_panel.h"

#include <imgui.h>

#include <cstdio>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/tools/tool_actions.h"
#include "app/editor/widgets.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// "512 × 512 × 174 · int16 · 0.49 × 0.49 × 0.7 mm"
std::string describe(const Volume& volume) {
    const VolumeGrid& grid = volume.grid();
    const Vec3 spacing = grid.spacing();
    std::string text = std::to_string(grid.size.x) + " × " + std::to_string(grid.size.y) + " × " +
                       std::to_string(grid.size.z) + "  ·  " + std::string(nameOf(volume.type()));
    if (grid.channels > 1) text += " × " + std::to_string(grid.channels);
    return text + "\nspacing " + number(spacing.x) + " × " + number(spacing.y) + " × " + number(spacing.z) +
           "\nvalues " + number(volume.statistics().min) + " … " + number(volume.statistics().max);
}

void drawAsset(const Workspace& workspace, const std::string& name) {
    ImGui::PushFont(font(FontRole::Strong));
    ImGui::TextUnformatted((std::string(icons::kVolume) + " " + name).c_str());
    ImGui::PopFont();
    noteWidget(name);
    const auto found = workspace.assets.volumes.find(name);
    ui::tooltip(workspace.document.scene().assets.at(name).path);
    if (found == workspace.assets.volumes.end() || !found->second) return ui::note("not loaded");
    ImGui::PushFont(font(FontRole::Small));
    ui::note(describe(*found->second));
    ImGui::PopFont();
}

/// A lattice's row: its name selects it, the eye switches it, the bin removes it.
void drawLattice(Workspace& workspace, const std::string& name) {
    Document& document = workspace.document;
    const Transfer* transfer = findTransfer(document.scene(), name);
    const bool enabled = transfer && transfer->enabled;
    ImGui::PushID(name.c_str());
    const float side = ImGui::GetFrameHeight() * 1.1f, room = ImGui::GetContentRegionAvail().x - 2 * side;
    const bool active = activeLattice(workspace) == name;
    ImGui::PushStyleColor(ImGuiCol_Text, packed(enabled ? theme::kText : theme::kTextDim));
    const std::string label = std::string(icons::kLattice) + "  " + name;
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0.02f, 0.5f));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    const bool clicked = ImGui::Selectable(label.c_str(), active, 0, {room, ImGui::GetFrameHeight()});
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
    noteWidget(name);
    if (clicked && workspace.selection.lattice != name) workspace.selection = {name, {}};

    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 2 * side);
    const std::string word = enabled ? "Disable " : "Enable ";
    if (ui::iconButton(enabled ? icons::kEye : icons::kEyeOff, ("Show " + name).c_str(), word + "this deformation"))
        document.apply(word + "lattice", [&](Scene& scene) { setTransferEnabled(scene, name, !enabled); });
    ImGui::SameLine(0, 0);
    if (ui::iconButton(icons::kRemove, ("Remove " + name).c_str(), "Remove this lattice and its deformation")) {
        document.apply("Remove lattice", [&](Scene& scene) { removeTransfer(scene, name); });
        if (workspace.selection.lattice == name) workspace.selection = {};
    }
    ImGui::PopID();
}

}  // namespace

void drawScenePanel(Workspace& workspace) {
    if (!workspace.open) return ui::note("Nothing is open. Drop a volume or a scene here, or use File > Open.");
    for (const auto& [name, asset] : workspace.document.scene().assets) drawAsset(workspace, name);
    ui::heading("DEFORMATIONS");
    // A copy: a row may remove its lattice.
    for (const std::string& name : latticeNames(workspace.document.scene())) drawLattice(workspace, name);
    if (latticeNames(workspace.document.scene()).empty()) ui::note("None yet. Add a lattice to bend the object.");
    ui::actionButton(workspace.actions, "lattice.add");
}

}  // namespace voledit
