#include "core/fields/transfer_function.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {

double positionOf(const Vec2& point) {
    return point.x;
}
double positionOf(const ColorTable::Point& point) {
    return point.value;
}
double valueOf(const Vec2& point) {
    return point.y;
}
const Vec3& valueOf(const ColorTable::Point& point) {
    return point.color;
}

/// The table at x; needs at least one point. The last point at or below x decides, so that the second of two points
/// of one position holds from there on.
template <class Point>
auto interpolate(const std::vector<Point>& points, double x) {
    const auto above = std::upper_bound(points.begin(), points.end(), x,
                                        [](double value, const Point& point) { return value < positionOf(point); });
    if (above == points.begin()) return valueOf(points.front());
    const auto& below = *std::prev(above);
    if (above == points.end()) return valueOf(below);
    const double fraction = (x - positionOf(below)) / (positionOf(*above) - positionOf(below));
    return valueOf(below) + fraction * (valueOf(*above) - valueOf(below));
}

}  // namespace

double PiecewiseLinear::operator()(double x) const {
    return points.empty() ? 0.0 : interpolate(points, x);
}

double PiecewiseLinear::slope(double x) const {
    const auto above = std::upper_bound(points.begin(), points.end(), x,
                                        [](double value, const Vec2& point) { return value < point.x; });
    if (above == points.begin() || above == points.end()) return 0;
    const Vec2& below = *std::prev(above);
    return (above->y - below.y) / (above->x - below.x);
}

Interval rangeOf(const PiecewiseLinear& table, const Interval& x) {
    const double first = table(x.low), last = table(x.high);
    Interval range{std::min(first, last), std::max(first, last)};
    // A corner at `low` itself counts through table(low) only: what holds below it is not reached.
    for (const Vec2& point : table.points)
        if (point.x > x.low && point.x <= x.high) range = join(range, Interval{point.y, point.y});
    return range;
}

Vec3 ColorTable::operator()(double x) const {
    return points.empty() ? Vec3(0) : interpolate(points, x);
}

TransferFunction greyRamp(double min, double max) {
    TransferFunction ramp;
    ramp.color.points = {{min, Vec3(0)}, {max, Vec3(1)}};
    ramp.opacity.points = {{min, 0.0}, {max, 1.0}};
    return ramp;
}

double largestOpacity(const PiecewiseLinear& opacity, double low, double high) {
    if (!(low <= high)) return 0;
    return rangeOf(opacity, {low, high}).high;
}

}  // namespace voledit
