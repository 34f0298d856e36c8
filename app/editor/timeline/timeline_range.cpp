#include "app/editor/timeline/timeline_range.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {

constexpr double kFewest = 2, kMost = 1e7;  // frames that are shown
constexpr double kRoom = 0.03;              // of the width, beside what is framed
constexpr double kFarthest = 1e7;           // frames from the first

TimelineRange spanning(TimelineRange range, double first, double last) {
    const double length = std::clamp(last - first, kFewest, kMost), middle = 0.5 * (first + last);
    range.first = std::clamp(middle - 0.5 * length, -kFarthest, kFarthest);
    range.last = range.first + length;
    return range;
}

}  // namespace

TimelineRange framedRange(TimelineRange range, double from, double to) {
    const double room = kRoom * std::max(to - from, kFewest);
    return spanning(range, from - room, to + room);
}

TimelineRange zoomedRange(TimelineRange range, double pixel, double factor) {
    const double length = range.last - range.first, share = (pixel - range.left) / range.width;
    const double wanted = std::clamp(length * factor, kFewest, kMost), fixed = range.frameAt(pixel);
    return spanning(range, fixed - share * wanted, fixed + (1 - share) * wanted);
}

TimelineRange pannedRange(TimelineRange range, double from, double to) {
    const double by = (from - to) / range.pixelsPerFrame();
    return spanning(range, range.first + by, range.last + by);
}

TimelineRange revealedRange(TimelineRange range, double frame) {
    const double room = kRoom * (range.last - range.first);
    const double by = std::min(0.0, frame - room - range.first) + std::max(0.0, frame + room - range.last);
    return by == 0 ? range : spanning(range, range.first + by, range.last + by);
}

RulerMarks rulerMarks(const TimelineRange& range, double spacing) {
    RulerMarks marks;
    const double fewest = spacing / range.pixelsPerFrame();
    static constexpr int kSteps[] = {1, 2, 5};
    for (int power = 1, n = 0; marks.step < fewest && power < 100'000'000; n = (n + 1) % 3) {
        marks.step = power * kSteps[n];
        if (n == 2) power *= 10;
    }
    marks.parts = marks.step == 1 ? 1 : marks.step % 5 == 0 ? 5 : 2;
    for (double frame = std::ceil(range.first / marks.step) * marks.step; frame <= range.last; frame += marks.step)
        marks.frames.push_back(frame);
    return marks;
}

}  // namespace voledit
