#include "app/editor/platform/interaction_clock.h"

#include <algorithm>
#include <numeric>

namespace voledit {

namespace {
constexpr double kRest = 0.5;     // seconds
constexpr double kAtOnce = 0.01;  // a frame that starts within so much of the last picture did not wait for input
// The last ones count: what plays goes on without end.
constexpr std::size_t kMostFrames = 600;
}  // namespace

void InteractionClock::note(const Frame& frame) {
    if (frame.changed) {
        if (frame.start - lastChange_ > kRest) milliseconds_.clear();
        if (!waiting_ && frame.start - lastShown_ > kAtOnce) lastShown_ = frame.start;
        waiting_ = true;
        lastChange_ = frame.start;
        refinedMs_ = 0;
    }
    if (frame.picture && waiting_) {
        if (milliseconds_.size() == kMostFrames) milliseconds_.erase(milliseconds_.begin());
        milliseconds_.push_back(1000 * (frame.shown - lastShown_));
        waiting_ = false;
    }
    if (frame.picture) lastShown_ = frame.shown;
    if (frame.final && refinedMs_ == 0 && !milliseconds_.empty()) refinedMs_ = 1000 * (frame.shown - lastChange_);
}

std::optional<FrameTimes> InteractionClock::times() const {
    if (milliseconds_.empty()) return std::nullopt;
    std::vector<double> sorted = milliseconds_;
    const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double sum = std::accumulate(milliseconds_.begin(), milliseconds_.end(), 0.0);
    return FrameTimes{
        .frameMs = *middle, .picturesPerSecond = 1000 * double(milliseconds_.size()) / sum, .refinedMs = refinedMs_};
}

}  // namespace voledit
