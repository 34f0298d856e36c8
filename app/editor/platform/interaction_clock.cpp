#include "app/editor/platform/interaction_clock.h"

#include <algorithm>

namespace voledit {

namespace {
constexpr double kRest = 0.5;  // seconds
// The last ones count: what plays goes on without end.
constexpr std::size_t kMostFrames = 600;
}  // namespace

void InteractionClock::frame(bool changed, bool refining, double start, double shown) {
    if (changed) {
        if (start - lastChange_ > kRest) milliseconds_.clear();
        if (milliseconds_.size() == kMostFrames) milliseconds_.erase(milliseconds_.begin());
        milliseconds_.push_back(1000 * (shown - start));
        lastChange_ = start;
        refinedMs_ = 0;
    }
    if (!refining && refinedMs_ == 0 && !milliseconds_.empty()) refinedMs_ = 1000 * (shown - lastChange_);
}

std::optional<FrameTimes> InteractionClock::times() const {
    if (milliseconds_.empty()) return std::nullopt;
    std::vector<double> sorted = milliseconds_;
    const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return FrameTimes{.frameMs = *middle, .refinedMs = refinedMs_};
}

}  // namespace voledit
