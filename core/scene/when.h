#pragma once
// When an edit of a value holds: at all times, or at one, as a key.

#include <cmath>
#include <optional>

#include "core/scene/tracked.h"

namespace voledit {

/// `{}`: the value is set for all times; keys that it had go. With `time` (seconds), a value that has keys gets one
/// there, and with `makeKey` (auto-key) any other, too.
struct When {
    std::optional<double> time;
    bool makeKey = false;
};

/// Times of keys that are as good as one.
inline constexpr double kSameKeyTime = 1e-6;  // seconds

/// Gives `tracked` a value as `when` says. Where only parts of it have keys, the others change for all times.
template <class T>
void setWhen(Tracked<T>& tracked, const T& value, const When& when) {
    if (!when.time || !(tracked.animated() || when.makeKey)) {
        tracked = value;
        return;
    }
    double time = *when.time;
    for (const PartTrack& part : tracked.tracks())
        for (const Track::Key& key : part.track.keys)
            if (std::abs(key.time - time) <= kSameKeyTime) time = key.time;
    if (tracked.animated())
        tracked.set(value, time);
    else
        tracked.setTracks({{PartTrack::kWhole, Track{{{time, numbersOf(value)}}}}});
}

}  // namespace voledit
