#include "app/editor/timeline/timeline_panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/editor/theme.h"
#include "app/editor/timeline/dope_marks.h"
#include "app/editor/timeline/timeline_actions.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoScrollWithMouse;
// Design pixels.
constexpr float kTransportHeight = 38, kRulerHeight = 24, kEdge = 5, kLeast = 70, kMost = 1200;
constexpr float kNumberSpacing = 56;
constexpr double kZoomANotch = 1.2;

float labelWidth(float width, float scale) {
    return std::round(std::clamp(0.22f * width, 110 * scale, 230 * scale));
}

}  // namespace

void TimelinePanel::draw(Workspace& workspace, const PixelRect& rect) {
    const float scale = workspace.scale;
    ImGui::SetNextWindowPos(ImVec2(float(rect.origin.x), float(rect.origin.y)));
    ImGui::SetNextWindowSize(ImVec2(float(rect.size.x), float(rect.size.y)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::Begin("##time", nullptr, kFixed);
    ImGui::PopStyleVar(3);
    const WidgetScope scope("Timeline");
    drawEdge(workspace, rect);
    const float bar = std::round(kTransportHeight * scale), pad = std::round(8 * scale);
    ImGui::SetCursorPos(ImVec2(pad, std::round(0.5f * (bar - ImGui::GetFrameHeight()))));
    ImGui::BeginGroup();
    ImGui::PushClipRect(ImGui::GetWindowPos(),
                        ImVec2(ImGui::GetWindowPos().x + float(rect.size.x) - pad, ImGui::GetWindowPos().y + bar),
                        true);
    drawTransport(workspace);
    ImGui::PopClipRect();
    ImGui::EndGroup();

    const ImVec2 origin = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const ImVec2 min(origin.x + labelWidth(size.x, scale), origin.y + bar), max(origin.x + size.x, origin.y + size.y);
    const Timeline& timeline = workspace.document.scene().timeline;
    range_ = workspace.timeline.range.value_or(framedRange({}, timeline.start, timeline.start + frameCount(timeline)));
    range_.left = min.x;
    range_.width = std::max(1.0f, max.x - min.x);
    const float ruler = std::min(max.y, min.y + std::round(kRulerHeight * scale));
    if (max.y > min.y) {
        reveal(workspace);
        navigate(workspace, min, max);
        drawRuler(workspace, min, ImVec2(max.x, ruler));
        if (max.y > ruler + 1) dopeSheet_.draw(workspace, range_, ImVec2(origin.x, ruler), max);
    }
    ImGui::End();
}

void TimelinePanel::drawEdge(Workspace& workspace, const PixelRect& rect) {
    const float scale = workspace.scale, thickness = std::round(kEdge * scale);
    ImGui::SetCursorPos(ImVec2(0, 0));
    ImGui::InvisibleButton("##edge", ImVec2(float(rect.size.x), thickness));
    noteWidget("Edge");
    const bool active = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
    if (ImGui::IsItemActivated()) edgeFrom_ = float(rect.size.y) / scale;
    if (active) {
        const float dragged = ImGui::GetMouseDragDelta(0, 0).y / scale;
        workspace.timeline.height = std::clamp(edgeFrom_ - dragged, kLeast, kMost);
    }
    if (active || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    const ImVec2 at = ImGui::GetWindowPos();
    const float line = std::max(1.0f, std::round(scale * (active || hovered ? 2 : 1)));
    ImGui::GetWindowDrawList()->AddRectFilled(at, ImVec2(at.x + float(rect.size.x), at.y + line),
                                              packed(active || hovered ? theme::kAccent : theme::kLine));
}

// A key that an event file names comes into view: its time here, its row in the dope sheet.
void TimelinePanel::reveal(Workspace& workspace) {
    TimelineState& state = workspace.timeline;
    if (state.reveal.empty()) return;
    const Scene& scene = workspace.document.scene();
    if (const auto value = valueAt(scene, state.reveal)) std::erase(state.closed, value->node);
    const std::vector<KeyMark> marks = keysOf(scene, state.reveal);
    if (state.revealKey < 0 || state.revealKey >= int(marks.size())) return;
    const TimelineRange shown = revealedRange(range_, marks[std::size_t(state.revealKey)].time * scene.timeline.fps);
    if (shown == range_) return;
    range_ = shown;
    state.range = shown;
}

void TimelinePanel::navigate(Workspace& workspace, const ImVec2& min, const ImVec2& max) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool inside = ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) && io.MousePos.x >= min.x &&
                        io.MousePos.y >= min.y && io.MousePos.y < max.y;
    if (inside && io.MouseWheel != 0 && !io.KeyShift) {
        range_ = zoomedRange(range_, io.MousePos.x, std::pow(kZoomANotch, -double(io.MouseWheel)));
        workspace.timeline.range = range_;
    }
    if (inside && ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
        panning_ = true;
        pannedFrom_ = io.MousePos.x;
    }
    panning_ = panning_ && io.MouseDown[ImGuiMouseButton_Middle];
    if (!panning_ || io.MousePos.x == pannedFrom_) return;
    range_ = pannedRange(range_, pannedFrom_, io.MousePos.x);
    pannedFrom_ = io.MousePos.x;
    workspace.timeline.range = range_;
}

void TimelinePanel::drawRuler(Workspace& workspace, const ImVec2& min, const ImVec2& max) {
    const float scale = workspace.scale;
    const Timeline& timeline = workspace.document.scene().timeline;
    ImGui::SetCursorScreenPos(min);
    ImGui::InvisibleButton("##ruler", ImVec2(std::max(1.0f, max.x - min.x), std::max(1.0f, max.y - min.y)));
    noteWidget("Ruler");
    if (ImGui::IsItemActive()) {
        const double frame = range_.frameAt(ImGui::GetIO().MousePos.x);
        const double snapped = ImGui::GetIO().KeyShift ? frame : std::round(frame);
        goToTime(workspace, timeOfFrame(snapped, timeline));
    }
    ui::tooltip("Drag: go through time  ·  Shift: between frames  ·  Wheel: zoom  ·  Middle drag: pan");

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 origin = ImGui::GetWindowPos();
    list.AddRectFilled(ImVec2(origin.x, min.y), max, packed(theme::kWindow));
    list.PushClipRect(min, max, true);
    const auto clampedPixel = [&](double frame) {
        return float(std::clamp(range_.pixelOf(frame), double(min.x), double(max.x)));
    };
    list.AddRectFilled(ImVec2(clampedPixel(timeline.start), min.y), ImVec2(clampedPixel(timeline.end), max.y),
                       packed(theme::kHeader));
    const RulerMarks marks = rulerMarks(range_, kNumberSpacing * scale);
    ImFont* small = font(FontRole::Small);
    const float tick = std::round(5 * scale), line = std::max(1.0f, std::round(scale));
    for (const double frame : marks.frames) {
        for (int part = 0; part < marks.parts; ++part) {
            const float x = std::round(float(range_.pixelOf(frame + double(marks.step) * part / marks.parts)));
            list.AddRectFilled(ImVec2(x, max.y - (part == 0 ? tick : 0.5f * tick)), ImVec2(x + line, max.y),
                               packed(theme::kTextDim, part == 0 ? 0.8f : 0.4f));
        }
        const std::string text = std::to_string(std::int64_t(frame));
        const ImVec2 extent = small->CalcTextSizeA(small->FontSize, FLT_MAX, 0, text.c_str());
        list.AddText(small, small->FontSize,
                     ImVec2(std::round(float(range_.pixelOf(frame)) - 0.5f * extent.x),
                            std::round(min.y + 0.42f * (max.y - min.y - tick - extent.y) + scale)),
                     packed(theme::kTextDim), text.c_str());
    }
    const std::string now = std::to_string(nearestFrame(workspace.time, timeline));
    const ImVec2 extent = small->CalcTextSizeA(small->FontSize, FLT_MAX, 0, now.c_str());
    const float x = std::round(float(range_.pixelOf(workspace.time * timeline.fps)));
    const float half = std::round(0.5f * extent.x + 6 * scale), inset = std::round(3 * scale);
    list.AddRectFilled(ImVec2(x - half, min.y + inset), ImVec2(x + half, max.y - inset), packed(theme::kAccent),
                       4 * scale);
    list.AddText(small, small->FontSize,
                 ImVec2(std::round(x - 0.5f * extent.x), std::round(0.5f * (min.y + max.y - extent.y))),
                 packed(theme::kText), now.c_str());
    drawPlayhead(list, x, max.y - inset, max.y, scale);
    list.PopClipRect();
}

}  // namespace voledit
