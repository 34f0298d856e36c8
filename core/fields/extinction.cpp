#include "core/fields/extinction.h"

#include <algorithm>
#include <cmath>

namespace voledit {

Interval tabulatedRange(const TransferFunction& look, const Interval& data, double beyond, double least) {
    double first = kInfinity, last = -kInfinity;
    const auto take = [&](double value) {
        first = std::min(first, value);
        last = std::max(last, value);
    };
    for (const Vec2& point : look.opacity.points) take(point.x);
    for (const ColorTable::Point& point : look.color.points) take(point.value);
    Interval range = data;
    if (first <= last && data.low <= data.high) {
        const double margin = std::max(beyond * (last - first), least * std::max(std::abs(first), std::abs(last)));
        range = {std::clamp(first - margin, data.low, data.high), std::clamp(last + margin, data.low, data.high)};
    }
    if (!(range.low < range.high)) {
        const double at = std::isfinite(range.low) ? range.low : std::isfinite(range.high) ? range.high : 0;
        range = {at, at + std::max(1.0, 1e-6 * std::abs(at))};
    }
    return range;
}

double extinctionOf(double opacity) {
    return opacity > 0 ? -std::log1p(-std::min(opacity, kLargestOpacity)) : 0;
}

}  // namespace voledit
