#include "app/editor/widget_places.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace voledit {

void WidgetPlaces::newFrame() {
    shown_ = std::move(noted_);
    noted_.clear();
    scopes.clear();
}

void WidgetPlaces::note(const std::string& path, const WidgetPlace& place) {
    const auto [at, isNew] = noted_.try_emplace(path, place);
    if (!isNew && (place.front || !at->second.front)) at->second = place;
}

std::optional<WidgetPlace> WidgetPlaces::find(const std::string& path) const {
    const auto at = shown_.find(path);
    if (at == shown_.end()) return std::nullopt;
    return at->second;
}

bool WidgetPlaces::takeWanted(const std::string& path) {
    if (wanted_.empty() || path != wanted_) return false;
    wanted_.clear();
    return true;
}

std::vector<std::string> WidgetPlaces::names() const {
    std::vector<std::string> names;
    for (const auto& [name, place] : shown_) names.push_back(name);
    return names;
}

WidgetPlaces* widgetPlaces() {
    return ImGui::GetCurrentContext() ? static_cast<WidgetPlaces*>(ImGui::GetIO().UserData) : nullptr;
}

WidgetScope::WidgetScope(std::string_view name) {
    if (WidgetPlaces* places = widgetPlaces()) places->scopes.emplace_back(name);
}

WidgetScope::~WidgetScope() {
    if (WidgetPlaces* places = widgetPlaces(); places && !places->scopes.empty()) places->scopes.pop_back();
}

void noteWidget(std::string_view label) {
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    noteWidget(label, Vec2(min.x, min.y), Vec2(max.x, max.y));
}

void noteWidget(std::string_view label, const Vec2& min, const Vec2& max) {
    WidgetPlaces* places = widgetPlaces();
    if (!places) return;
    std::string path;
    for (const std::string& scope : places->scopes) path += scope + "/";
    path += label.substr(0, label.find("##"));
    const Vec2 center = 0.5 * (min + max);
    ImGuiWindow& window = *ImGui::GetCurrentWindow();
    const bool visible = window.ClipRect.Contains(ImVec2(float(center.x), float(center.y)));
    if (places->takeWanted(path) && !visible)
        ImGui::ScrollToBringRectIntoView(
            &window, ImRect(ImVec2(float(min.x), float(min.y)), ImVec2(float(max.x), float(max.y))));
    places->note(path, {min, max, visible, (window.RootWindow->Flags & ImGuiWindowFlags_Popup) != 0});
}

}  // namespace voledit
