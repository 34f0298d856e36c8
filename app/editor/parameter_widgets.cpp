#include "app/editor/parameter_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widget_parts.h"

namespace voledit::ui {

namespace {

const std::array<std::string, 3> kAxes{"X", "Y", "Z"};

/// A bar where the slider has ends, else a field to drag.
bool field(const char* label, double& value, const ParameterFormat& format) {
    if (std::isfinite(format.format.min) && std::isfinite(format.format.max))
        return barField(label, value, format.format, format.allowed);
    NumberFormat dragged = format.format;
    dragged.min = std::max(dragged.min, format.allowed.low);
    dragged.max = std::min(dragged.max, format.allowed.high);
    return dragField(label, value, dragged);
}

}  // namespace

Edit parameter(const char* label, double& value, const ParameterFormat& format, const std::string& help) {
    row(label);
    return finish(label, field(hidden(label).c_str(), value, format), help);
}

Edit parameterOrFormula(const char* label, double& value, const ParameterFormat& format, const std::string& help,
                        bool& formulaWanted) {
    row(label);
    const float button = ImGui::GetFrameHeight() * 1.1f;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button);
    const Edit edit = finish(label, field(hidden(label).c_str(), value, format), help);
    ImGui::SameLine(0, 0);
    formulaWanted = iconButton(icons::kFormula, (shownPart(label) + " formula").c_str(), "Type a formula instead");
    return edit;
}

Edit pair(const char* label, std::array<double, 2>& values, const ParameterFormat& format, const std::string& help) {
    row(label);
    const float width = shareOfRow(2);
    Edit edit;
    for (int i = 0; i < 2; ++i) {
        if (i > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::SetNextItemWidth(width);
        const std::string part = shownPart(label) + " " + std::to_string(i + 1);
        edit = edit | finish(part.c_str(), field(hidden(part.c_str()).c_str(), values[std::size_t(i)], format), help);
    }
    return edit;
}

Edit axis(const char* label, int& axis, const std::string& help) {
    return choice(label, axis, kAxes, help);
}

Edit axes(const char* label, std::vector<int>& axes, const std::string& help) {
    row(label);
    const auto has = [&](int a) { return std::find(axes.begin(), axes.end(), a) != axes.end(); };
    const int clicked = buttonRow(label, kAxes, has, help);
    if (clicked < 0 || (axes.size() == 1 && has(clicked))) return {};
    if (has(clicked))
        std::erase(axes, clicked);
    else
        axes.push_back(clicked);
    std::sort(axes.begin(), axes.end());
    return {true, true, false};
}

void animatedMark(const char* label) {
    const float em = ImGui::GetFontSize(), half = std::round(0.24f * em);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 center{at.x + labelColumn() - ImGui::GetCursorPosX() - 0.55f * em,
                        at.y + 0.5f * ImGui::GetFrameHeight()};
    ImGui::GetWindowDrawList()->AddQuadFilled({center.x - half, center.y}, {center.x, center.y - half},
                                              {center.x + half, center.y}, {center.x, center.y + half},
                                              packed(theme::kAnimated));
    noteWidget(shownPart(label) + " animated", Vec2(center.x - half, center.y - half),
               Vec2(center.x + half, center.y + half));
}

}  // namespace voledit::ui
