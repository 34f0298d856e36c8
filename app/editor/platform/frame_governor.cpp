#include "app/editor/platform/frame_governor.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {

// Steps are kGrowth of the way from 1 to the divisor: long steps show as bands, few pixels as blur, which hurts less.
constexpr double kGrowth = 1.0 / 3;
// The picture is made for a little less than there is time for, so that frames that tremble keep to it.
constexpr double kAim = 0.85;
// What else is done in a frame cannot starve the picture.
constexpr double kLeastShare = 0.35;
// Quality rises where the aim is missed by so much, and falls above the budget itself.
constexpr double kRoom = 0.7;
// A single frame that is so much too slow is believed.
constexpr double kFarTooSlow = 2;

double stepOf(double divisor) {
    return 1 + kGrowth * (divisor - 1);
}

}  // namespace

double shareOfWork(const PictureQuality& quality) {
    return 1 / (quality.divisor * quality.divisor * quality.step);
}

PictureQuality qualityOfShare(double share) {
    constexpr double coarsest = FrameGovernor::kCoarsestDivisor;
    const double wanted = 1 / std::clamp(share, 1e-9, 1.0);
    // d²·(1 + g(d − 1)) grows steadily with d: Newton from above comes down to the root.
    double d = coarsest;
    if (d * d * stepOf(d) <= wanted) return {d, stepOf(d)};
    for (int n = 0; n < 8; ++n) d -= (d * d * stepOf(d) - wanted) / (2 * d * stepOf(d) + kGrowth * d * d);
    d = std::clamp(d, 1.0, coarsest);
    return {d, stepOf(d)};
}

void FrameGovernor::note(double work, const Cost& cost) {
    const std::size_t at = count_++ % kFrames;
    rates_[at] = cost.drawing / std::max(work, 1e-9);
    setups_[at] = cost.setup;
    rests_[at] = cost.rest;
}

// The value so far up the last frames' sorted ones, 0 … 1.
double FrameGovernor::sorted(const std::array<double, kFrames>& values, double place) const {
    std::array<double, kFrames> last = values;
    const std::size_t n = std::min(count_, kFrames);
    if (n == 0) return 0;
    std::sort(last.begin(), last.begin() + std::ptrdiff_t(n));
    return last[std::size_t(std::lround(place * double(n - 1)))];
}

double FrameGovernor::drawingBudget(double budgetMs) const {
    const double left = budgetMs - sorted(setups_, 0.5) - sorted(rests_, 0.5);
    return std::max(left, kLeastShare * budgetMs);
}

PictureQuality FrameGovernor::choose(double budgetMs, double fullWork) {
    if (!known()) return qualityOfShare(0);
    const double most = drawingBudget(budgetMs), coarsest = shareOfWork(qualityOfShare(0));
    const double last = rates_[(count_ - 1) % kFrames] * fullWork;
    const double usual = sorted(rates_, 0.5) * fullWork, highest = sorted(rates_, 1) * fullWork;
    const auto choose = [&](double full) { share_ = full > 0 ? std::clamp(kAim * most / full, coarsest, 1.0) : 1.0; };
    if (share_ == 0)
        choose(highest);
    else if (last * share_ > kFarTooSlow * most)
        choose(last);
    else if (usual * share_ > most)
        choose(usual);
    else if (highest * share_ < kRoom * kAim * most)
        choose(highest);
    return qualityOfShare(share_);
}

}  // namespace voledit
