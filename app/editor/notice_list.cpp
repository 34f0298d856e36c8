#include "app/editor/notice_list.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/editor/formula_field.h"
#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace {

constexpr double kInfoSeconds = 5, kWarningSeconds = 12;
constexpr std::size_t kMostShown = 4;

double secondsOf(Notice::Kind kind) {
    switch (kind) {
        case Notice::Kind::Info:
            return kInfoSeconds;
        case Notice::Kind::Warning:
            return kWarningSeconds;
        case Notice::Kind::Problem:
            break;
    }
    return kInfinity;
}

Vec4f colorOf(Notice::Kind kind) {
    return kind == Notice::Kind::Info      ? theme::kAccent
           : kind == Notice::Kind::Warning ? theme::kWarning
                                           : theme::kProblem;
}

}  // namespace

void NoticeList::draw(const Workspace& workspace, const PixelRect& area) {
    const auto& notices = workspace.notices;
    float bottom = float(area.origin.y + area.size.y) - 10 * workspace.scale;
    std::size_t shown = 0;
    for (std::size_t n = notices.size(); n-- > 0 && shown < kMostShown;) {
        if (closed_.contains(n) || workspace.clock - notices[n].time > secondsOf(notices[n].kind)) continue;
        ++shown;
        if (drawOne(workspace, area, n, bottom)) closed_.insert(n);
    }
}

bool NoticeList::drawOne(const Workspace& workspace, const PixelRect& area, std::size_t index, float& bottom) {
    const Notice& notice = workspace.notices[index];
    const float scale = workspace.scale, margin = 10 * scale;
    const float width = std::min(460 * scale, float(area.size.x) - 2 * margin);
    if (width < 60 * scale) return false;
    ImGui::SetNextWindowPos(ImVec2(float(area.origin.x) + margin, bottom), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSize(ImVec2(width, 0));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, packed(withAlpha(theme::kHeader, 0.96f)));
    bool close = false;
    if (ImGui::Begin(("##notice" + std::to_string(index)).c_str(), nullptr, flags)) {
        const WidgetScope scope("Notice");
        const float right = ImGui::GetWindowContentRegionMax().x;
        const float button = ImGui::GetFrameHeight();
        ImGui::PushStyleColor(ImGuiCol_Text, packed(colorOf(notice.kind)));
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(notice.kind == Notice::Kind::Info ? icons::kInfo : icons::kWarning);
        ImGui::PopStyleColor();
        ImGui::SameLine();
        ImGui::PushTextWrapPos(right - button - ImGui::GetStyle().ItemSpacing.x);
        const FormulaProblem text = problemOf(notice.text);
        ImGui::BeginGroup();
        ImGui::TextUnformatted(text.message.c_str());
        if (!text.excerpt.empty()) ui::excerpt(text.excerpt, right - button - 3 * ImGui::GetStyle().ItemSpacing.x);
        ImGui::EndGroup();
        ImGui::PopTextWrapPos();
        ImGui::SameLine(right - button);
        close = ui::iconButton(icons::kClose, "Close", "Closes this message");
    }
    bottom -= ImGui::GetWindowHeight() + 6 * scale;
    ImGui::End();
    ImGui::PopStyleColor();
    return close;
}

}  // namespace voledit
