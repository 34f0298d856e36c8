#pragma once
// How fast pictures followed the last interaction.

#include <optional>
#include <vector>

#include "app/editor/editor.h"

namespace voledit {

/// An interaction is a run of changed pictures with no rest of half a second between them.
class InteractionClock {
public:
    /// A frame began at `start` (when its input was read) and was on the screen at `shown`, seconds; `changed`: it
    /// showed something new; `refining`: its picture is not final.
    void frame(bool changed, bool refining, double start, double shown);
    /// nullopt until something has changed.
    std::optional<FrameTimes> times() const;

private:
    std::vector<double> milliseconds_;
    double lastChange_ = -1;
    double refinedMs_ = 0;
};

}  // namespace voledit
