#pragma once
// The timeline below the viewport: transport, ruler, dope sheet.

#include "app/editor/layout.h"
#include "app/editor/timeline/dope_sheet.h"
#include "app/editor/workspace.h"

struct ImVec2;

namespace voledit {

/// Drawn once a frame where `workspace.timeline.shown`. The ruler is scrubbed by dragging; the wheel zooms about the
/// pointer, a middle drag pans; the upper edge is dragged to make it higher.
class TimelinePanel {
public:
    void draw(Workspace& workspace, const PixelRect& rect);
    /// Keys follow the mouse, or a box is drawn: no shortcut may change the scene below.
    bool busy() const { return dopeSheet_.busy(); }
    void cancel(Workspace& workspace) { dopeSheet_.cancel(workspace); }

private:
    void drawEdge(Workspace& workspace, const PixelRect& rect);
    void drawRuler(Workspace& workspace, const ImVec2& min, const ImVec2& max);
    void reveal(Workspace& workspace);
    void navigate(Workspace& workspace, const ImVec2& min, const ImVec2& max);

    DopeSheet dopeSheet_;
    TimelineRange range_;   // as drawn last
    float edgeFrom_ = 0;    // height when the edge's drag began
    bool panning_ = false;  // by the middle button, from this pixel
    double pannedFrom_ = 0;
};

/// The row of buttons and fields: play, step, loop, auto-key; frame, time; start, end, rate.
void drawTransport(Workspace& workspace);

}  // namespace voledit
