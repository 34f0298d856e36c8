#include "app/editor/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widget_parts.h"

namespace voledit {

void applyEdit(Document& document, const Edit& edit, const std::string& name,
               const std::function<void(Scene&)>& change) {
    if (edit.cancelled) {
        document.cancel();
        return;
    }
    if (edit.changed) document.preview(change);
    if (edit.finished) document.commit(name);
}

namespace ui {

namespace {

constexpr float kLabelShare = 0.39f;

bool escapePressed() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
}

std::string formatOf(const NumberFormat& format) {
    std::string unit;
    for (const char* c = format.unit; *c; ++c) unit += *c == '%' ? "%%" : std::string(1, *c);
    return "%." + std::to_string(format.decimals) + "f" + unit;
}

float speedOf(const NumberFormat& format, double value) {
    if (format.speed > 0) return float(format.speed);
    const bool bounded = std::isfinite(format.min) && std::isfinite(format.max);
    return float(bounded ? (format.max - format.min) / 300 : std::max(std::abs(value) / 100, 0.01));
}

/// Where `value` lies between the format's bounds, 0…1.
double shareOf(const NumberFormat& format, double value) {
    const double clamped = std::clamp(value, format.min, format.max);
    if (format.logarithmic) return std::log(clamped / format.min) / std::log(format.max / format.min);
    return (clamped - format.min) / (format.max - format.min);
}

constexpr const char* kAxisLabels[] = {"X", "Y", "Z"};

}  // namespace

std::string shownPart(const char* label) {
    const char* end = std::strstr(label, "##");
    return end ? std::string(label, end) : std::string(label);
}

std::string hidden(const char* label) {
    return std::string("##") + label;
}

Edit finish(const char* label, bool changed, const std::string& help) {
    noteWidget(label);
    tooltip(help);
    Edit edit{changed, ImGui::IsItemDeactivatedAfterEdit(), false};
    // While a field is typed in, Escape is the text field's own: it puts the old text back.
    const ImGuiID id = ImGui::GetItemID();
    if (ImGui::IsItemActive() && !ImGui::TempInputIsActive(id) && escapePressed()) {
        ImGui::ClearActiveID();
        edit = {false, false, true};
    }
    return edit;
}

bool dragField(const char* label, double& value, const NumberFormat& format) {
    const double low = std::isfinite(format.min) ? format.min : -1e30;
    const double high = std::isfinite(format.max) ? format.max : 1e30;
    const bool bounded = std::isfinite(format.min) || std::isfinite(format.max);
    return ImGui::DragScalar(label, ImGuiDataType_Double, &value, speedOf(format, value), bounded ? &low : nullptr,
                             bounded ? &high : nullptr, formatOf(format).c_str(),
                             bounded ? ImGuiSliderFlags_AlwaysClamp : ImGuiSliderFlags_None);
}

void axisMark(int a) {
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const float width = std::round(ImGui::GetFontSize() * 0.18f);
    ImGui::GetWindowDrawList()->AddRectFilled(min, {min.x + width, max.y}, packed(theme::kAxis[std::size_t(a)], 0.9f),
                                              ImGui::GetStyle().FrameRounding, ImDrawFlags_RoundCornersLeft);
}

float shareOfRow(int count) {
    const float spacing = ImGui::GetStyle().ItemInnerSpacing.x;
    return (ImGui::GetContentRegionAvail().x - float(count - 1) * spacing) / float(count);
}

float labelColumn() {
    return std::round(ImGui::GetWindowContentRegionMax().x * kLabelShare);
}

void row(const char* label) {
    const std::string shown = shownPart(label);
    if (shown.empty()) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        return;
    }
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(shown.c_str());
    const float right = at.x + labelColumn() - ImGui::GetCursorPosX() - 0.15f * ImGui::GetFontSize();
    const float y = at.y + ImGui::GetStyle().FramePadding.y;
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), {at.x, y}, {right, y + size.y}, right, right, shown.c_str(),
                              nullptr, &size);
    ImGui::PopStyleColor();
    ImGui::Dummy({std::max(1.0f, right - at.x), ImGui::GetFrameHeight()});
    ImGui::SameLine(labelColumn());
    ImGui::SetNextItemWidth(-FLT_MIN);
}

void note(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void finePrint(const std::string& text) {
    ImGui::PushFont(font(FontRole::Small));
    note(text);
    ImGui::PopFont();
}

void warning(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kWarning));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted((std::string(icons::kWarning) + " " + text).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

namespace {
// Below the item drawn last, or above it, no wider than its window: what is beside a panel stays seen.
void placeTooltip(const std::string& text, float& wrap) {
    const ImGuiWindow& window = *ImGui::GetCurrentWindowRead()->RootWindow;
    if (window.Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_ChildMenu)) return;
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    wrap = std::min(wrap, std::max(1.0f, window.Size.x - 2 * padding.x));
    const ImVec2 inner = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 size{inner.x + 2 * padding.x, inner.y + 2 * padding.y};
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const float gap = 0.3f * ImGui::GetFontSize(), right = window.Pos.x + window.Size.x - size.x;
    const bool below = max.y + gap + size.y <= ImGui::GetIO().DisplaySize.y;
    ImGui::SetNextWindowPos(
        {std::max(window.Pos.x, std::min(min.x, right)), below ? max.y + gap : min.y - gap - size.y});
}
}  // namespace

void tooltip(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
    if (ImGui::GetCurrentContext()->HoveredIdTimer < 0.5f) return;
    float wrap = ImGui::GetFontSize() * 22;
    placeTooltip(text, wrap);
    ImGui::BeginTooltip();
    // From the tooltip's left edge.
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(font(FontRole::Small));
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

bool button(const char* label, const std::string& help, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool clicked = ImGui::Button(label);
    ImGui::EndDisabled();
    noteWidget(label);
    tooltip(help);
    return clicked;
}

bool iconButton(const char* icon, const char* name, const std::string& help, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    ImGui::PushStyleColor(ImGuiCol_Button, 0);
    const float side = ImGui::GetFrameHeight();
    const bool clicked = ImGui::Button((std::string(icon) + "##" + name).c_str(), {side * 1.1f, side});
    ImGui::PopStyleColor();
    ImGui::EndDisabled();
    noteWidget(name);
    tooltip(help.empty() ? name : help);
    return clicked;
}

void actionButton(const Actions& actions, const std::string& id, const char* icon) {
    const Action* action = actions.find(id);
    if (!action) return;
    const bool clicked = icon ? iconButton(icon, action->title.c_str(), actions.tooltip(id), action->isEnabled())
                              : button(action->title.c_str(), actions.tooltip(id), action->isEnabled());
    if (clicked) actions.run(id);
}

void actionMenuItem(const Actions& actions, const std::string& id) {
    const Action* action = actions.find(id);
    if (!action) return;
    const bool clicked = ImGui::MenuItem(action->title.c_str(), action->shortcut.c_str(),
                                         action->checked && action->checked(), action->isEnabled());
    noteWidget(action->title);
    tooltip(action->help);
    if (clicked) actions.run(id);
}

Edit checkbox(const char* label, bool& value, const std::string& help) {
    row(label);
    const bool changed = ImGui::Checkbox(hidden(label).c_str(), &value);
    Edit edit = finish(label, changed, help);
    edit.finished = changed;
    return edit;
}

bool beginCombo(const char* label, const std::string& shown) {
    const bool open = ImGui::BeginCombo(hidden(label).c_str(), shown.c_str(),
                                        ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton);
    if (open) return true;
    noteWidget(label);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const float em = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddText({max.x - em * 1.35f, min.y + (max.y - min.y - em) / 2},
                                        ImGui::GetColorU32(packed(theme::kTextDim)), icons::kDrop);
    return false;
}

Edit combo(const char* label, int& index, std::span<const std::string> items, const std::string& help) {
    row(label);
    const bool known = index >= 0 && std::size_t(index) < items.size();
    bool changed = false;
    const bool open = beginCombo(label, known ? items[std::size_t(index)] : "");
    if (!open) {
        tooltip(help);
        return {};
    }
    const WidgetScope scope(shownPart(label));
    for (int i = 0; i < int(items.size()); ++i) {
        const bool chosen = ImGui::Selectable(items[std::size_t(i)].c_str(), i == index);
        noteWidget(items[std::size_t(i)]);
        if (i == index && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        if (chosen && i != index) {
            index = i;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return {changed, changed, false};
}

int buttonRow(const char* label, std::span<const std::string> items, const std::function<bool(int)>& on,
              const std::string& help) {
    const int count = int(items.size());
    const float spacing = std::max(1.0f, std::round(ImGui::GetStyle().ItemInnerSpacing.x / 6));
    const float width = (ImGui::GetContentRegionAvail().x - spacing * float(count - 1)) / float(std::max(1, count));
    const WidgetScope scope(shownPart(label));
    ImGui::PushID(label);
    int clicked = -1;
    for (int i = 0; i < count; ++i) {
        if (i > 0) ImGui::SameLine(0, spacing);
        const bool pressed = on(i);
        if (pressed) {
            ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_Header));
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetColorU32(ImGuiCol_Header));
        }
        if (ImGui::Button(items[std::size_t(i)].c_str(), {width, 0})) clicked = i;
        if (pressed) ImGui::PopStyleColor(2);
        noteWidget(items[std::size_t(i)]);
        tooltip(help);
    }
    ImGui::PopID();
    return clicked;
}

Edit choice(const char* label, int& index, std::span<const std::string> items, const std::string& help) {
    row(label);
    const int now = index;
    const int clicked = buttonRow(
        label, items, [&](int i) { return i == now; }, help);
    if (clicked < 0 || clicked == now) return {};
    index = clicked;
    return {true, true, false};
}

Edit number(const char* label, double& value, const NumberFormat& format, const std::string& help) {
    row(label);
    const bool changed = dragField(hidden(label).c_str(), value, format);
    return finish(label, changed, help);
}

Edit integer(const char* label, int& value, int min, int max, const std::string& help) {
    row(label);
    const bool changed =
        ImGui::DragInt(hidden(label).c_str(), &value, 0.1f, min, max, "%d", ImGuiSliderFlags_AlwaysClamp);
    return finish(label, changed, help);
}

bool barField(const char* label, double& value, const NumberFormat& format, const Interval& allowed) {
    const ImGuiSliderFlags flags = format.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    // A bar that is filled as far as the value goes says more than a grab.
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const float width = ImGui::CalcItemWidth(), height = ImGui::GetFrameHeight();
    const bool active = ImGui::GetActiveID() == ImGui::GetID(label);
    const float rounding = ImGui::GetStyle().FrameRounding;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, {min.x + width, min.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
    // From zero, where the bar has it inside.
    const bool signedBar = !format.logarithmic && format.min < 0 && format.max > 0;
    const float from = signedBar ? width * float(shareOf(format, 0)) : 0, to = width * float(shareOf(format, value));
    const float low = std::min(from, to), high = std::max(from, to);
    if (high - low > 1) {
        const int left = low < 1 ? ImDrawFlags_RoundCornersLeft : 0;
        const int right = high > width - 1 ? ImDrawFlags_RoundCornersRight : 0;
        list.AddRectFilled({min.x + low, min.y}, {min.x + high, min.y + height},
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram, active ? 0.75f : 0.5f), rounding,
                           left + right ? left + right : int(ImDrawFlags_RoundCornersNone));
    }
    for (const ImGuiCol c : {ImGuiCol_FrameBg, ImGuiCol_FrameBgActive, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
        ImGui::PushStyleColor(c, 0);
    ImGui::PushStyleColor(ImGuiCol_FrameBgHovered, packed(theme::kText, 0.06f));
    ImGui::SetNextItemWidth(width);
    const bool changed = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &format.min, &format.max,
                                             formatOf(format).c_str(), flags);
    ImGui::PopStyleColor(5);
    if (changed) value = std::clamp(value, allowed.low, allowed.high);
    return changed;
}

Edit slider(const char* label, double& value, const NumberFormat& format, const std::string& help) {
    row(label);
    const bool changed = barField(hidden(label).c_str(), value, format, {format.min, format.max});
    return finish(label, changed, help);
}

Edit vector(const char* label, Vec3& value, const NumberFormat& format, const std::string& help) {
    row(label);
    const float width = shareOfRow(3);
    const std::string name = shownPart(label);
    Edit edit;
    for (int a = 0; a < 3; ++a) {
        if (a > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::SetNextItemWidth(width);
        const std::string part = name + " " + kAxisLabels[a];
        const bool changed = dragField(hidden(part.c_str()).c_str(), value[a], format);
        edit = edit | finish(part.c_str(), changed, help);
        axisMark(a);
    }
    return edit;
}

Edit integers(const char* label, Index3& value, int min, int max, const std::string& help) {
    row(label);
    const float width = shareOfRow(3);
    const std::string name = shownPart(label);
    Edit edit;
    for (int a = 0; a < 3; ++a) {
        if (a > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::SetNextItemWidth(width);
        const std::string part = name + " " + kAxisLabels[a];
        const bool changed =
            ImGui::DragInt(hidden(part.c_str()).c_str(), &value[a], 0.1f, min, max, "%d", ImGuiSliderFlags_AlwaysClamp);
        edit = edit | finish(part.c_str(), changed, help);
        axisMark(a);
    }
    return edit;
}

Edit color(const char* label, Vec3& value, const std::string& help) {
    row(label);
    ImGui::PushID(label);
    const ImVec4 shown{float(value.x), float(value.y), float(value.z), 1};
    const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
    const auto flags = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
    if (ImGui::ColorButton("##swatch", shown, flags, size)) ImGui::OpenPopup("picker");
    noteWidget(label);
    tooltip(help);
    Edit edit;
    // Beside the panel where there is room, so that it does not cover what is painted.
    const float em = ImGui::GetFontSize(), left = ImGui::GetWindowPos().x - 0.5f * em;
    const float lowest = ImGui::GetIO().DisplaySize.y - 21 * em;
    if (left > 17 * em)
        ImGui::SetNextWindowPos({left, std::max(0.0f, std::min(ImGui::GetItemRectMin().y, lowest))}, ImGuiCond_Always,
                                {1, 0});
    if (ImGui::BeginPopup("picker")) {
        const WidgetScope scope(shownPart(label));
        float rgb[3] = {shown.x, shown.y, shown.z};
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
        const bool changed = ImGui::ColorPicker3(
            "##picker", rgb,
            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_PickerHueBar | ImGuiColorEditFlags_NoSmallPreview);
        if (changed) value = Vec3(rgb[0], rgb[1], rgb[2]);
        edit = finish("Picker", changed, "");
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return edit;
}

Edit text(const char* label, std::string& value, const std::string& help) {
    row(label);
    const bool changed = ImGui::InputText(hidden(label).c_str(), &value);
    noteWidget(label);
    tooltip(help);
    return {changed, ImGui::IsItemDeactivatedAfterEdit(), false};
}

bool section(const char* label, bool openAtFirst) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(label);
    bool open = storage.GetBool(id, openAtFirst);
    const float em = ImGui::GetFontSize(), height = std::round(em * 1.75f);
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 max{min.x + ImGui::GetContentRegionAvail().x, min.y + height};
    if (ImGui::InvisibleButton(label, {max.x - min.x, height})) storage.SetBool(id, open = !open);
    noteWidget(shownPart(label));

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool hovered = ImGui::IsItemHovered();
    list.AddRectFilled(min, max, ImGui::GetColorU32(packed(hovered ? theme::kControl : theme::kHeader)),
                       ImGui::GetStyle().FrameRounding);
    const float y = min.y + (height - em) / 2;
    list.AddText({min.x + em * 0.2f, y}, ImGui::GetColorU32(packed(theme::kTextDim)),
                 open ? icons::kOpenSection : icons::kClosedSection);
    ImGui::PushFont(font(FontRole::Strong));
    list.AddText({min.x + em * 1.6f, y}, ImGui::GetColorU32(ImGuiCol_Text), shownPart(label).c_str());
    ImGui::PopFont();
    return open;
}

}  // namespace ui
}  // namespace voledit
