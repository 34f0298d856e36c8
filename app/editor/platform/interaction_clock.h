#pragma once
// How fast pictures followed the last interaction.

#include <optional>
#include <vector>

#include "app/editor/editor.h"

namespace voledit {

/// An interaction is a run of changed pictures with no rest of half a second between them.
class InteractionClock {
public:
    struct Frame {
        double start = 0;      // when its input was read, seconds
        double shown = 0;      // when it was on the screen
        bool changed = false;  // it answers to something new
        bool picture = false;  // it shows another picture than the frame before
        bool final = false;    // the picture is of full quality
    };
    void note(const Frame& frame);
    /// nullopt until a picture has answered to something.
    std::optional<FrameTimes> times() const;

private:
    std::vector<double> milliseconds_;
    double lastChange_ = -1, lastShown_ = -1;
    bool waiting_ = false;  // for a picture that answers
    double refinedMs_ = 0;
};

}  // namespace voledit
