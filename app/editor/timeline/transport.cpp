#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/timeline/timeline_actions.h"
#include "app/editor/timeline/timeline_panel.h"
#include "app/editor/widget_parts.h"
#include "core/scene/keys.h"

namespace voledit {

namespace {

constexpr float kFieldWidth = 84;  // design pixels
constexpr float kGap = 4;

void gap(float design, float scale) {
    ImGui::SameLine(0, design * scale);
}

/// A button with the words of an action, noted as `name`; `color` of its icon.
bool iconOf(const Workspace& workspace, const char* id, const char* icon, const char* name, const Vec4f& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(color));
    const bool clicked = ui::iconButton(icon, name, workspace.actions.tooltip(id));
    ImGui::PopStyleColor();
    if (clicked) workspace.actions.run(id);
    return clicked;
}

void buttons(Workspace& workspace) {
    const float scale = workspace.scale;
    const bool playing = workspace.timeline.playback.playing();
    iconOf(workspace, "timeline.start", icons::kToStart, "Go to start", theme::kText);
    gap(0, scale);
    iconOf(workspace, "timeline.back", icons::kStepBack, "Step back", theme::kText);
    gap(0, scale);
    iconOf(workspace, "timeline.toggle", playing ? icons::kPause : icons::kPlay, "Play",
           playing ? theme::kAccent : theme::kText);
    gap(0, scale);
    iconOf(workspace, "timeline.forward", icons::kStepForward, "Step forward", theme::kText);
    gap(0, scale);
    iconOf(workspace, "timeline.end", icons::kToEnd, "Go to end", theme::kText);
    gap(2 * kGap, scale);
    const bool loop = workspace.timeline.playback.loop;
    iconOf(workspace, "timeline.loop", icons::kLoop, "Loop", loop ? theme::kAccent : theme::kTextDim);
    gap(0, scale);
    const bool keying = workspace.timeline.autoKey;
    iconOf(workspace, "key.auto", icons::kRecord, "Auto-key", keying ? theme::kProblem : theme::kTextDim);
}

/// A whole number to drag or type, in a field of one width.
Edit wholeField(const char* name, int& value, int least, int most, const char* format, const std::string& help) {
    const std::string hidden = ui::hidden(name);
    const bool changed =
        ImGui::DragInt(hidden.c_str(), &value, 0.15f, least, most, format, ImGuiSliderFlags_AlwaysClamp);
    return ui::finish(name, changed, help);
}

void nowFields(Workspace& workspace, bool withTime) {
    const Timeline& timeline = workspace.document.scene().timeline;
    const float scale = workspace.scale;
    int frame = nearestFrame(workspace.time, timeline);
    ImGui::SetNextItemWidth(kFieldWidth * scale);
    if (wholeField("Frame", frame, -1'000'000, 1'000'000, "Frame %d", "Current frame (timeline.frame)").changed)
        goToTime(workspace, timeOfFrame(frame, timeline));
    if (!withTime) return;
    gap(kGap, scale);
    double time = workspace.time;
    NumberFormat format;
    format.speed = 0.01;
    format.decimals = 2;
    format.unit = " s";
    ImGui::SetNextItemWidth(kFieldWidth * scale);
    const bool changed = ui::dragField("##Time", time, format);
    if (ui::finish("Time", changed, "Time on the scene's clock (timeline.goto)").changed) goToTime(workspace, time);
}

void rangeFields(Workspace& workspace) {
    const float scale = workspace.scale;
    Timeline timeline = workspace.document.scene().timeline;
    Edit edit;
    ImGui::SetNextItemWidth(kFieldWidth * scale);
    edit = edit | wholeField("Start", timeline.start, -1'000'000, timeline.end - 1, "Start %d", "First frame");
    gap(kGap, scale);
    ImGui::SetNextItemWidth(kFieldWidth * scale);
    edit =
        edit | wholeField("End", timeline.end, timeline.start + 1, 1'000'000, "End %d", "The frame after the last one");
    gap(kGap, scale);
    NumberFormat format{0.01, 1000, 0.1, 0, " fps"};
    if (timeline.fps != std::round(timeline.fps)) format.decimals = 2;
    ImGui::SetNextItemWidth(kFieldWidth * scale);
    const bool changed = ui::dragField("##Frame rate", timeline.fps, format);
    edit = edit | ui::finish("Frame rate", changed, "Frames a second");
    applyEdit(workspace.document, edit, "Change timeline", [&](Scene& scene) { setTimeline(scene, timeline); });
}

}  // namespace

void drawTransport(Workspace& workspace) {
    const float scale = workspace.scale, spacing = kGap * scale, field = kFieldWidth * scale;
    // As much room at the right as at the left.
    const float left = ImGui::GetCursorPosX(), inner = ImGui::GetContentRegionAvail().x - left;
    const float button = 1.1f * ImGui::GetFrameHeight();
    buttons(workspace);
    gap(2 * kGap, scale);
    // What does not fit goes: first the seconds, then what is seldom changed.
    const float used = 7 * button + 6 * spacing, three = 3 * field + 2 * spacing;
    nowFields(workspace, used + 2 * field + spacing + three + 4 * spacing <= inner);
    if (used + field + three + 4 * spacing > inner) return;
    ImGui::SameLine(left + inner - three);
    rangeFields(workspace);
}

}  // namespace voledit
