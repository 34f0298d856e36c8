#include "app/editor/progress_box.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit {

bool drawProgressBox(const char* scope, const std::string& text, double fraction, const PixelRect& area, float scale) {
    const Vec2 center = Vec2(area.origin) + 0.5 * Vec2(area.size);
    ImGui::SetNextWindowPos(ImVec2(float(std::round(center.x)), float(std::round(center.y))), ImGuiCond_Always,
                            ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(std::min(360 * scale, float(area.size.x)), 0));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, packed(withAlpha(theme::kHeader, 0.96f)));
    bool cancelled = false;
    if (ImGui::Begin((std::string("##") + scope).c_str(), nullptr, flags)) {
        const WidgetScope widgets(scope);
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
        ImGui::TextUnformatted(text.c_str());
        ImGui::ProgressBar(float(fraction), ImVec2(-1, 0));
        cancelled = ui::button("Cancel", "Stops it (Escape)");
    }
    ImGui::End();
    ImGui::PopStyleColor();
    return cancelled;
}

}  // namespace voledit
