#include "app/editor/timeline/playback.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {

// Times are sums of frames' lengths: what is so near to a frame is meant to be it.
constexpr double kSameFrame = 1e-6;
constexpr double kMostFrames = 1e9;

int whole(double frame) {
    return int(std::clamp(frame, -kMostFrames, kMostFrames));
}

}  // namespace

int frameCount(const Timeline& timeline) {
    return std::max(1, timeline.end - timeline.start);
}

double timeOfFrame(double frame, const Timeline& timeline) {
    return frame / timeline.fps;
}

int nearestFrame(double t, const Timeline& timeline) {
    return whole(std::round(t * timeline.fps));
}

int frameAt(double t, const Timeline& timeline) {
    return whole(std::floor(t * timeline.fps + kSameFrame));
}

double steppedTime(double t, int by, const Timeline& timeline) {
    const double frame = t * timeline.fps;
    const double from = by > 0 ? std::floor(frame + kSameFrame) : std::ceil(frame - kSameFrame);
    return timeOfFrame(by == 0 ? frame : from + by, timeline);
}

void Playback::start(double t, const Timeline& timeline) {
    const int frame = frameAt(t, timeline), last = timeline.start + frameCount(timeline) - 1;
    const bool inside = frame >= timeline.start && frame < last;
    position_ = inside ? t : timeOfFrame(timeline.start, timeline);
    playing_ = true;
    dropped_ = 0;
    rate_.reset();
    counted_ = 0;
    shown_ = 0;
}

double Playback::advance(double seconds, const Timeline& timeline) {
    const auto frames = std::int64_t(frameCount(timeline));
    const std::int64_t last = timeline.start + frames - 1, from = frameAt(position_, timeline);
    position_ += std::max(0.0, seconds);
    std::int64_t to = frameAt(position_, timeline);
    if (!loop && to > last) {
        to = std::max(from, last);
        stop();
    }
    count(to - from, seconds);
    // Rounds are counted as frames like any others and taken away at the end.
    const std::int64_t rounds = to > last ? (to - timeline.start) / frames : 0;
    position_ -= timeOfFrame(double(rounds * frames), timeline);
    return timeOfFrame(double(to - rounds * frames), timeline);
}

void Playback::count(std::int64_t steps, double seconds) {
    if (steps > 0) dropped_ += steps - 1;
    if (steps > 0) ++shown_;
    counted_ += std::max(0.0, seconds);
    if (counted_ < 1) return;
    rate_ = shown_ / counted_;
    counted_ = 0;
    shown_ = 0;
}

double Playback::untilNext(const Timeline& timeline) const {
    return std::max(0.0, timeOfFrame(frameAt(position_, timeline) + 1, timeline) - position_);
}

}  // namespace voledit
