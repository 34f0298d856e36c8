#include "app/editor/timeline/dope_marks.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/timeline/key_actions.h"

namespace voledit {

namespace {

constexpr Vec4f kMark{0.745f, 0.757f, 0.788f, 1};
constexpr Vec4f kStrip{0.255f, 0.400f, 0.400f, 1};
constexpr std::size_t kMostNumbers = 4;  // of a value in a tooltip

std::string numberText(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.5g", value);
    return text.data();
}

}  // namespace

void drawMark(ImDrawList& list, const ImVec2& at, const MarkLook& look, float scale) {
    const float half = (look.small ? 4.2f : 5.2f) * scale, line = std::max(1.0f, scale);
    const ImU32 fill = packed(look.selected ? theme::kAnimated : kMark, look.selected || !look.small ? 1 : 0.75f);
    const ImU32 edge = packed(look.hovered ? theme::kText : theme::kLine);
    switch (look.interpolation) {
        case Track::Interpolation::Step: {
            const float side = std::round(0.85f * half + 0.3f * scale);
            const ImVec2 min(at.x - side, at.y - side), max(at.x + side, at.y + side);
            list.AddRectFilled(min, max, fill, scale);
            list.AddRect(min, max, edge, scale, 0, line);
            break;
        }
        case Track::Interpolation::Smooth:
            list.AddCircleFilled(at, 0.9f * half, fill, 16);
            list.AddCircle(at, 0.9f * half, edge, 16, line);
            break;
        case Track::Interpolation::Linear: {
            const std::array<ImVec2, 4> p{ImVec2(at.x - half, at.y), ImVec2(at.x, at.y - half),
                                          ImVec2(at.x + half, at.y), ImVec2(at.x, at.y + half)};
            list.AddQuadFilled(p[0], p[1], p[2], p[3], fill);
            list.AddQuad(p[0], p[1], p[2], p[3], edge, line);
            break;
        }
    }
}

void drawSpan(ImDrawList& list, const ImVec2& from, const ImVec2& to, float scale) {
    const float half = std::max(1.0f, std::round(scale));
    list.AddRectFilled(ImVec2(from.x, from.y - half), ImVec2(to.x, to.y + half), packed(theme::kTextDim, 0.28f));
}

void drawStrip(ImDrawList& list, const DopeRow& row, const TimelineRange& range, const Workspace& workspace, float top,
               float bottom) {
    const double fps = workspace.document.scene().timeline.fps;
    const float inset = std::round(3 * workspace.scale);
    const float left = float(range.pixelOf(row.from * fps));
    const float right = std::max(left + 2, float(range.pixelOf(row.to * fps)));
    list.AddRectFilled(ImVec2(left, top + inset), ImVec2(right, bottom - inset), packed(kStrip), 3 * workspace.scale);
    std::array<char, 48> text;
    std::snprintf(text.data(), text.size(), "%.2f s", row.to - row.from);
    const ImVec2 extent = ImGui::CalcTextSize(text.data());
    const float x = std::max(left, float(range.left)) + 8 * workspace.scale;
    if (x + extent.x + 4 * workspace.scale < right)
        list.AddText(ImVec2(std::round(x), std::round(0.5f * (top + bottom - extent.y))), packed(theme::kText, 0.8f),
                     text.data());
}

void drawRowLabel(ImDrawList& list, const DopeRow& row, const ImVec4& rect, float scale) {
    const bool node = row.kind == DopeRow::Kind::Node, value = row.kind == DopeRow::Kind::Value;
    const float em = ImGui::GetFontSize(), y = std::round(0.5f * (rect.y + rect.w - em));
    float x = rect.x + 10 * scale;
    if (node) {
        list.AddText(ImVec2(x, y), packed(theme::kTextDim), row.open ? icons::kOpenSection : icons::kClosedSection);
        x += 16 * scale;
    } else if (value) {
        x += 28 * scale;
    } else if (row.kind == DopeRow::Kind::Motion) {
        list.AddText(ImVec2(x - 2 * scale, y), packed(theme::kTextDim), icons::kFilm);
        x += 20 * scale;
    }
    const ImVec2 size = ImGui::CalcTextSize(row.label.c_str());
    const float right = rect.z - 6 * scale;
    ImGui::PushStyleColor(ImGuiCol_Text, packed(value ? theme::kTextDim : theme::kText));
    ImGui::RenderTextEllipsis(&list, ImVec2(x, y), ImVec2(right, y + size.y), right, right, row.label.c_str(), nullptr,
                              &size);
    ImGui::PopStyleColor();
}

void drawPlayhead(ImDrawList& list, double pixel, float top, float bottom, float scale) {
    const float half = std::max(1.0f, scale), x = std::round(float(pixel));
    list.AddRectFilled(ImVec2(x - half, top), ImVec2(x + half, bottom), packed(theme::kAccent));
}

void drawBox(ImDrawList& list, const ImVec2& from, const ImVec2& to, float scale) {
    const ImVec2 min = ImMin(from, to), max = ImMax(from, to);
    list.AddRectFilled(min, max, packed(theme::kAccent, 0.12f));
    list.AddRect(min, max, packed(theme::kAccent, 0.9f), 0, 0, std::max(1.0f, scale));
}

std::string textOf(const DopeRow& row, const DopeMark& mark, const Scene& scene) {
    std::array<char, 64> when;
    std::snprintf(when.data(), when.size(), "frame %.5g  ·  %.3g s", mark.time * scene.timeline.fps, mark.time);
    std::string text = row.label + "\n" + when.data();
    if (row.kind != DopeRow::Kind::Value)
        return text + "\n" + std::to_string(mark.keys.size()) + (mark.keys.size() == 1 ? " key" : " keys");
    text += "  ·  " + wordOf(mark.interpolation);
    const std::vector<double> numbers = numbersAt(scene, row.id, mark.time);
    std::string values;
    for (std::size_t n = 0; n < std::min(numbers.size(), kMostNumbers); ++n)
        values += (n ? ", " : "") + numberText(numbers[n]);
    if (numbers.size() > kMostNumbers) values += " and " + std::to_string(numbers.size() - kMostNumbers) + " more";
    return text + "\n" + values;
}

}  // namespace voledit
