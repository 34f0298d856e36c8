#pragma once
// Which frames an animation has, and when each is shown.

#include <string>

#include "core/scene/scene.h"

namespace voledit {

/// Frame numbers first … last, both included; first ≤ last.
struct FrameRange {
    int first = 0, last = 0;
    bool operator==(const FrameRange&) const = default;

    int count() const { return last - first + 1; }
};

/// Frames that one run may have.
inline constexpr int kMostFrames = 1000000;

/// "12-47" (both ends included), "12" (one frame) or "-5--1". Throws Error that says what is expected; also for more
/// than `kMostFrames` frames.
FrameRange parseFrameRange(const std::string& text);

/// The frames of the whole timeline where frame n is at n / fps seconds: those at times within [start, end) of the
/// timeline, whatever its own rate is. Throws Error for an empty timeline.
FrameRange framesOf(const Timeline& timeline, double fps);

}  // namespace voledit
