#pragma once
// What part of time the timeline shows, and where its marks stand.

#include <vector>

#include "core/scene/scene.h"

namespace voledit {

/// A stretch of frames seen from pixel `left` on, `width` pixels wide. A value.
struct TimelineRange {
    double first = 0, last = 48;  // frames at the left and right edge, first < last
    double left = 0, width = 1;   // pixels

    double pixelOf(double frame) const { return left + (frame - first) / (last - first) * width; }
    double frameAt(double pixel) const { return first + (pixel - left) / width * (last - first); }
    double pixelsPerFrame() const { return width / (last - first); }
    bool operator==(const TimelineRange&) const = default;
};

/// `range` with `from` … `to` in it, and a little room beside them.
TimelineRange framedRange(TimelineRange range, double from, double to);
/// `factor` > 1 shows more; what is at `pixel` stays there. Between two frames and ten million are shown.
TimelineRange zoomedRange(TimelineRange range, double pixel, double factor);
/// What was at `from` is at `to` now, pixels.
TimelineRange pannedRange(TimelineRange range, double from, double to);
/// The least move that brings `frame` into view.
TimelineRange revealedRange(TimelineRange range, double frame);

/// Frames that get a number, `spacing` pixels apart or more: multiples of 1, 2, 5, 10, 20 … And into how many parts the
/// lines between divide that distance (never less than a frame each).
struct RulerMarks {
    std::vector<double> frames;
    int step = 1;
    int parts = 1;
};
RulerMarks rulerMarks(const TimelineRange& range, double spacing);

}  // namespace voledit
