#include "app/editor/timeline/key_row.h"

#include <utility>

#include "app/editor/theme.h"
#include "app/editor/widget_parts.h"

namespace voledit {

namespace {

// Of fields, and of what fills the bars of sliders.
constexpr Vec4f kAnimatedField{0.135f, 0.225f, 0.150f, 1}, kKeyedField{0.285f, 0.240f, 0.100f, 1};
constexpr Vec4f kAnimatedBar{0.390f, 0.680f, 0.350f, 1}, kKeyedBar{0.900f, 0.730f, 0.250f, 1};

}  // namespace

KeyRow::KeyRow(Workspace& workspace, ValuePath path, const char* label, KeyState state)
    : workspace_(workspace), path_(std::move(path)), label_(label), state_(state), from_(ImGui::GetCursorScreenPos()) {
    if (path_.empty() || state_ == KeyState::None) return;
    const bool keyed = state_ == KeyState::Keyed;
    ImGui::PushStyleColor(ImGuiCol_FrameBg, packed(keyed ? kKeyedField : kAnimatedField));
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, packed(keyed ? kKeyedBar : kAnimatedBar));
}

KeyRow::~KeyRow() {
    if (path_.empty()) return;
    if (state_ != KeyState::None) ImGui::PopStyleColor(2);
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    const ImVec2 to(right, ImGui::GetItemRectMax().y);
    if (!ImGui::IsRectVisible(from_, to)) return;
    workspace_.timeline.fields.push_back({path_, Vec2(from_.x, from_.y), Vec2(to.x, to.y)});
    menu();
}

void KeyRow::menu() const {
    const std::string id = "##keys of " + path_;
    const ImVec2 to = ImGui::GetItemRectMax();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) && ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect(from_, ImVec2(right, to.y)))
        ImGui::OpenPopup(id.c_str());
    if (!ImGui::BeginPopup(id.c_str())) return;
    const WidgetScope scope(ui::shownPart(label_));
    const auto entry = [&](const char* title, const char* action, const char* keys, bool enabled) {
        if (ImGui::MenuItem(title, keys, false, enabled)) workspace_.timeline.request = {action, path_, false};
        noteWidget(title);
    };
    const bool keyed = state_ == KeyState::Keyed, animated = state_ != KeyState::None;
    entry(keyed ? "Replace key" : "Insert key", "key.insert", "I", true);
    entry("Delete key", "key.remove", "Alt+I", keyed);
    entry("Clear keys", "key.clear", "", animated);
    ImGui::Separator();
    entry("Next key", "key.next", "", animated);
    entry("Previous key", "key.previous", "", animated);
    ImGui::EndPopup();
}

bool takeKeyWish(Workspace& workspace, const ValuePath& path) {
    TimelineState::Request& request = workspace.timeline.request;
    if (path.empty() || request.path != path || request.action != "key.insert") return false;
    if (valueAt(workspace.document.scene(), path)) return false;
    request = {};
    return true;
}

void runKeyRequest(Workspace& workspace) {
    TimelineState::Request& request = workspace.timeline.request;
    if (request.action.empty()) return;
    const bool missing = request.action == "key.insert" && !valueAt(workspace.document.scene(), request.path);
    if (missing && !std::exchange(request.waited, true)) return;
    const TimelineState::Request now = std::exchange(request, {});
    workspace.actions.run(now.action, now.path);
}

}  // namespace voledit
