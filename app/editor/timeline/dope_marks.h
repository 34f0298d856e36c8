#pragma once
// How the dope sheet's marks, labels and strips look.

#include <imgui.h>

#include <string>

#include "app/editor/timeline/dope_rows.h"
#include "app/editor/timeline/timeline_range.h"
#include "app/editor/workspace.h"

namespace voledit {

struct MarkLook {
    bool selected = false, hovered = false;
    bool small = false;  // of a row that stands for others
    Track::Interpolation interpolation = Track::Interpolation::Linear;
};

/// A diamond (linear), a disc (smooth) or a square (step). All in screen pixels, `scale` pixels a design pixel.
void drawMark(ImDrawList& list, const ImVec2& at, const MarkLook& look, float scale);
/// Between two keys of a value that does not stand still.
void drawSpan(ImDrawList& list, const ImVec2& from, const ImVec2& to, float scale);
/// What a motion covers, from `top` to `bottom`.
void drawStrip(ImDrawList& list, const DopeRow& row, const TimelineRange& range, const Workspace& workspace, float top,
               float bottom);
/// The row's name, indented, with an arrow for nodes; `rect` is left, top, right, bottom.
void drawRowLabel(ImDrawList& list, const DopeRow& row, const ImVec4& rect, float scale);
/// The line of the time that is shown.
void drawPlayhead(ImDrawList& list, double pixel, float top, float bottom, float scale);
/// A selection's box.
void drawBox(ImDrawList& list, const ImVec2& from, const ImVec2& to, float scale);

/// "bend · angle\nframe 12  ·  0.50 s  ·  linear\n45" for a tooltip.
std::string textOf(const DopeRow& row, const DopeMark& mark, const Scene& scene);

}  // namespace voledit
