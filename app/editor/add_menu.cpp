#include "app/editor/add_menu.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/editor/add_actions.h"
#include "app/editor/formula_files.h"
#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"
#include "core/base/error.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace {

constexpr const char* kPopup = "Add##popup";

/// An entry that runs `action` with `argument`.
void entry(const Actions& actions, const char* icon, const std::string& title, const std::string& help,
           const std::string& action, const std::string& argument) {
    const Action* known = actions.find(action);
    const bool clicked =
        ImGui::MenuItem((std::string(icon) + "  " + title).c_str(), nullptr, false, known && known->isEnabled());
    noteWidget(title);
    ui::tooltip(help);
    if (clicked) actions.run(action, argument);
}

void dim(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

/// Files of the scene's folder, then those added lately from elsewhere.
void fileEntries(const Workspace& workspace) {
    std::vector<std::filesystem::path> files = formulaFilesIn(workspace.folder);
    for (const auto& file : workspace.formulaFiles.recent())
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    for (const auto& file : files)
        entry(workspace.actions, icons::kFormulaFile, file.stem().string(), file.string(), "transfer.add-file",
              file.string());
    entry(workspace.actions, icons::kFormulaFile, "Formula file…", workspace.actions.tooltip("transfer.add-file"),
          "transfer.add-file", "");
}

void transferEntries(const Workspace& workspace) {
    const Actions& actions = workspace.actions;
    entry(actions, icons::kLattice, "Lattice", "A box of control points to drag (free-form deformation)",
          "transfer.add", "lattice");
    entry(actions, icons::kFormula, "Expression", "Three formulas, typed here", "transfer.add", "expression");
    ImGui::Separator();
    try {
        for (const TransferDefinitionPtr& definition : transferLibrary())
            entry(actions, icons::kMagic, definition->title(),
                  definition->description() + (definition->source().empty() ? "" : "\n" + definition->source()),
                  "transfer.add", definition->name());
    } catch (const Error& error) {
        dim("The library cannot be read");
        ui::tooltip(error.what());
    }
    ImGui::Separator();
    fileEntries(workspace);
}

void objectEntries(const Workspace& workspace) {
    const Actions& actions = workspace.actions;
    for (const AddChoice& solid : solidChoices())
        entry(actions, solid.icon, solid.title, solid.help, "solid.add", solid.name);
}

void combineEntries(const Workspace& workspace) {
    for (const AddChoice& choice : combineChoices())
        entry(workspace.actions, choice.icon, choice.title, choice.help, "object.combine", choice.name);
}

void wrapEntries(const Workspace& workspace) {
    for (const AddChoice& choice : wrapChoices())
        entry(workspace.actions, choice.icon, choice.title, choice.help, "object.wrap", choice.name);
}

void submenu(const char* title, const Workspace& workspace, void (*draw)(const Workspace&)) {
    const bool open = ImGui::BeginMenu(title);
    noteWidget(title);
    if (!open) return;
    const WidgetScope scope(title);
    draw(workspace);
    ImGui::EndMenu();
}

}  // namespace

void drawAddMenu(const Workspace& workspace) {
    submenu("Transfers", workspace, transferEntries);
    submenu("Objects", workspace, objectEntries);
    submenu("Combine with a solid", workspace, combineEntries);
    submenu("Around the selection", workspace, wrapEntries);
}

void drawAddPopup(Workspace& workspace) {
    if (std::exchange(workspace.addMenuWanted, false)) ImGui::OpenPopup(kPopup);
    if (!ImGui::BeginPopup(kPopup)) return;
    const WidgetScope scope("Add");
    dim("Add");
    ImGui::Separator();
    drawAddMenu(workspace);
    ImGui::EndPopup();
}

}  // namespace voledit
