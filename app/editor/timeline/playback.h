#pragma once
// Playing the scene's timeline: which frame is shown when.

#include <cstdint>
#include <optional>

#include "core/scene/scene.h"

namespace voledit {

/// How many frames the timeline has, at least one.
int frameCount(const Timeline& timeline);
/// Time of a frame, seconds.
double timeOfFrame(double frame, const Timeline& timeline);
/// The frame that t seconds lie nearest to; the one that is shown then (whose time is at or before t).
int nearestFrame(double t, const Timeline& timeline);
int frameAt(double t, const Timeline& timeline);
/// `by` frames on from t: between two frames the first step leads to the next one that way.
double steppedTime(double t, int by, const Timeline& timeline);

/// Whole frames by the wall clock: those that come too late are left out, never slowed down. Frames last 1/fps each,
/// the last as long as the others; then the first follows (`loop`), or it stops.
class Playback {
public:
    bool playing() const { return playing_; }
    bool loop = true;

    /// Plays on from t; from the first frame where t is not before the last.
    void start(double t, const Timeline& timeline);
    void stop() { playing_ = false; }
    /// Goes on from t without a pause: someone has scrubbed.
    void jump(double t) { position_ = t; }
    /// `seconds` have passed (≥ 0): the time to show now. Stops by itself at the end where it does not loop.
    double advance(double seconds, const Timeline& timeline);
    /// Until the next frame is due, seconds.
    double untilNext(const Timeline& timeline) const;

    /// Frames a second that were shown, over the last second; nullopt before it has passed.
    std::optional<double> shownRate() const { return rate_; }
    /// Left out since it was started.
    std::int64_t dropped() const { return dropped_; }

private:
    void count(std::int64_t steps, double seconds);

    bool playing_ = false;
    double position_ = 0;  // seconds on the scene's clock, not yet a whole frame's; rounds add up
    std::int64_t dropped_ = 0;
    std::optional<double> rate_;
    double counted_ = 0;  // seconds, and frames shown in them, since `rate_` was taken
    int shown_ = 0;
};

}  // namespace voledit
