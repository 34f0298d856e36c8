#include "app/editor/tree_row.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit::ui {

namespace {

/// Where the parts of a row stand, screen pixels.
struct RowParts {
    ImVec2 min, max;
    float arrow, icon, label, right;  // left ends; `right` is where the label must end
    float baseline;                   // top of its text
};

RowParts partsOf(const TreeRow& row) {
    const float em = ImGui::GetFontSize(), height = treeRowHeight();
    RowParts parts{};
    parts.min = ImGui::GetCursorScreenPos();
    parts.max = {parts.min.x + ImGui::GetContentRegionAvail().x, parts.min.y + height};
    parts.arrow = parts.min.x + float(row.depth) * 0.95f * em;
    parts.icon = parts.arrow + 1.05f * em;
    parts.label = parts.icon + 1.6f * em;
    parts.right = parts.max.x - (row.on ? 1.9f * em : 0.4f * em);
    parts.baseline = parts.min.y + std::floor(0.5f * (height - em));
    return parts;
}

/// A square button without a frame; `dim` until hovered.
bool plainButton(const char* id, const char* icon, float x, const RowParts& parts, float width, bool dim) {
    ImGui::SetCursorScreenPos({x, parts.min.y});
    const bool clicked = ImGui::InvisibleButton(id, {width, parts.max.y - parts.min.y});
    const bool bright = ImGui::IsItemHovered() || !dim;
    const float size = ImGui::CalcTextSize(icon).x;
    ImGui::GetWindowDrawList()->AddText({x + std::floor(0.5f * (width - size)), parts.baseline},
                                        packed(bright ? theme::kText : theme::kTextDim), icon);
    return clicked;
}

/// Lines that lead from a row up to its parents.
void guides(const TreeRow& row, const RowParts& parts) {
    const float em = ImGui::GetFontSize();
    for (int d = 0; d < row.depth; ++d) {
        const float x = std::floor(parts.min.x + (float(d) * 0.95f + 0.5f) * em) + 0.5f;
        ImGui::GetWindowDrawList()->AddLine({x, parts.min.y}, {x, parts.max.y}, packed(theme::kText, 0.09f));
    }
}

void drawLabel(const TreeRow& row, const RowParts& parts) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool off = row.on && !*row.on;
    const float em = ImGui::GetFontSize();
    list.AddText({parts.icon, parts.baseline}, packed(row.selected ? theme::kText : theme::kTextDim), row.icon);
    float x = parts.label;
    const auto mark = [&](const char* icon, const Vec4f& color) {
        if (x + em > parts.right) return;
        list.AddText(nullptr, 0.85f * em, {x + 0.35f * em, parts.baseline + 0.1f * em}, packed(color), icon);
        x += 1.5f * em;
    };
    const ImVec2 size = ImGui::CalcTextSize(row.label.c_str());
    const float end = std::min(x + size.x, parts.right);
    ImGui::PushStyleColor(ImGuiCol_Text, packed(off ? theme::kTextDim : theme::kText));
    ImGui::RenderTextEllipsis(&list, {x, parts.baseline}, {end, parts.max.y}, end, end, row.label.c_str(), nullptr,
                              &size);
    ImGui::PopStyleColor();
    x = end;
    if (row.link) mark(icons::kLink, theme::kTextDim);
    if (row.wrong) mark(icons::kWarning, theme::kWarning);
    x += 0.6f * em;
    if (row.detail.empty() || x + em > parts.right) return;
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim, 0.85f));
    ImGui::RenderTextEllipsis(&list, {x, parts.baseline}, {parts.right, parts.max.y}, parts.right, parts.right,
                              row.detail.c_str(), nullptr, nullptr);
    ImGui::PopStyleColor();
}

void drawNameField(const TreeRow& row, const RowParts& parts, TreeRowEvents& events) {
    const float pad = std::floor(0.5f * (parts.max.y - parts.min.y - ImGui::GetFontSize()));
    ImGui::SetCursorScreenPos({parts.label - pad, parts.min.y});
    ImGui::SetNextItemWidth(parts.right - parts.label + pad);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {pad, pad});
    if (row.focus) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##name", row.edited,
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopStyleVar();
    noteWidget("Name");
    events.nameDropped = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    events.nameDone = !events.nameDropped && (entered || ImGui::IsItemDeactivated());
}

}  // namespace

float treeRowHeight() {
    return std::round(1.65f * ImGui::GetFontSize());
}

TreeRowEvents treeRow(const TreeRow& row) {
    TreeRowEvents events;
    ImGui::PushID(row.name.c_str());
    const RowParts parts = partsOf(row);
    const float em = ImGui::GetFontSize();
    const ImVec2 size{parts.max.x - parts.min.x, parts.max.y - parts.min.y};
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    // The whole row is one item below the smaller ones.
    const bool pressed = ImGui::InvisibleButton("row", size, ImGuiButtonFlags_PressedOnClick);
    ImGui::SetItemAllowOverlap();
    const ImGuiLastItemData item = ImGui::GetCurrentContext()->LastItemData;
    const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    events.doubleClicked = hovered && ImGui::IsMouseDoubleClicked(0);
    events.menu = hovered && ImGui::IsMouseClicked(1);
    if (row.scrollTo) ImGui::SetScrollHereY();
    noteWidget(row.name);
    tooltip(row.help);
    if (row.selected || hovered)
        ImGui::GetWindowDrawList()->AddRectFilled(
            parts.min, parts.max, row.selected ? ImGui::GetColorU32(ImGuiCol_Header) : packed(theme::kText, 0.05f),
            ImGui::GetStyle().FrameRounding);
    guides(row, parts);
    if (row.edited) {
        ImGui::GetWindowDrawList()->AddText({parts.icon, parts.baseline}, packed(theme::kText), row.icon);
        drawNameField(row, parts, events);
    } else {
        drawLabel(row, parts);
    }
    bool onButton = false;
    if (row.parent) {
        events.arrow = plainButton("arrow", row.open ? icons::kOpenSection : icons::kClosedSection, parts.arrow, parts,
                                   1.05f * em, true);
        noteWidget("Open " + row.name);
        onButton |= ImGui::IsItemHovered();
    }
    if (row.on) {
        events.eye = plainButton("eye", *row.on ? icons::kEye : icons::kEyeOff, parts.max.x - 1.8f * em, parts,
                                 1.6f * em, !*row.on);
        noteWidget("Show " + row.name);
        onButton |= ImGui::IsItemHovered();
        tooltip(row.eyeHelp);
    }
    events.clicked = pressed && !onButton;
    events.doubleClicked &= !onButton;
    ImGui::SetCursorScreenPos({parts.min.x, parts.max.y});
    ImGui::PopStyleVar();
    ImGui::PopID();
    ImGui::GetCurrentContext()->LastItemData = item;
    return events;
}

}  // namespace voledit::ui
