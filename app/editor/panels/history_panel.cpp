#include "app/editor/panels/history_panel.h"

#include <imgui.h>

#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit {

void drawHistoryPanel(Workspace& workspace) {
    Document& document = workspace.document;
    const std::vector<std::string> done = document.undoNames(), undone = document.redoNames();
    std::size_t target = done.size();
    const auto step = [&](std::size_t number, const std::string& name) {
        ImGui::PushID(int(number));
        const bool ahead = number > done.size();
        if (ahead) ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
        if (ImGui::Selectable(name.c_str(), number == done.size())) target = number;
        if (ahead) ImGui::PopStyleColor();
        noteWidget("Step " + std::to_string(number));
        ImGui::PopID();
    };
    step(0, "Opened");
    for (std::size_t i = 0; i < done.size(); ++i) step(i + 1, done[i]);
    // The next step to redo comes last in its list.
    for (std::size_t i = 0; i < undone.size(); ++i) step(done.size() + 1 + i, undone[undone.size() - 1 - i]);
    for (std::size_t n = done.size(); n > target; --n) document.undo();
    for (std::size_t n = done.size(); n < target; ++n) document.redo();
}

}  // namespace voledit
