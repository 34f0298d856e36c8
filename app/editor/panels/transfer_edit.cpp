#include "app/editor/panels/transfer_edit.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {

/// Clamps `x` between what `key` gives for the neighbours of element `index`.
template <class Points, class Key>
double betweenNeighbours(const Points& points, std::size_t index, double x, Key key) {
    if (index > 0) x = std::max(x, key(points[index - 1]));
    if (index + 1 < points.size()) x = std::min(x, key(points[index + 1]));
    return x;
}

}  // namespace

std::size_t insertPoint(PiecewiseLinear& table, const Vec2& at) {
    const auto next = std::find_if(table.points.begin(), table.points.end(), [&](const Vec2& p) { return p.x > at.x; });
    const auto index = std::size_t(next - table.points.begin());
    table.points.insert(next, Vec2{at.x, std::clamp(at.y, 0.0, 1.0)});
    return index;
}

void movePoint(PiecewiseLinear& table, std::size_t index, const Vec2& to) {
    if (index >= table.points.size()) return;
    const double x = betweenNeighbours(table.points, index, to.x, [](const Vec2& p) { return p.x; });
    table.points[index] = {x, std::clamp(to.y, 0.0, 1.0)};
}

bool removePoint(PiecewiseLinear& table, std::size_t index) {
    if (table.points.size() <= 1 || index >= table.points.size()) return false;
    table.points.erase(table.points.begin() + std::ptrdiff_t(index));
    return true;
}

std::size_t insertStop(ColorTable& table, double value) {
    const ColorTable::Point stop{value, table(value)};
    const auto next = std::find_if(table.points.begin(), table.points.end(),
                                   [&](const ColorTable::Point& p) { return p.value > value; });
    const auto index = std::size_t(next - table.points.begin());
    table.points.insert(next, stop);
    return index;
}

void moveStop(ColorTable& table, std::size_t index, double value) {
    if (index >= table.points.size()) return;
    table.points[index].value =
        betweenNeighbours(table.points, index, value, [](const ColorTable::Point& p) { return p.value; });
}

bool removeStop(ColorTable& table, std::size_t index) {
    if (table.points.size() <= 1 || index >= table.points.size()) return false;
    table.points.erase(table.points.begin() + std::ptrdiff_t(index));
    return true;
}

TransferFunction shifted(TransferFunction function, double by) {
    for (auto& point : function.opacity.points) point.x += by;
    for (auto& stop : function.color.points) stop.value += by;
    return function;
}

ValueRange rangeOf(const TransferFunction& function) {
    ValueRange range;
    const auto include = [&](double value) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    };
    for (const auto& point : function.opacity.points) include(point.x);
    for (const auto& stop : function.color.points) include(stop.value);
    return range;
}

ValueRange zoomed(const ValueRange& range, double fixed, double factor, double smallest, double largest) {
    const double size = std::clamp(range.size() * factor, smallest, largest);
    const double share = (fixed - range.low) / range.size();
    return {fixed - share * size, fixed + (1 - share) * size};
}

double niceStep(double range, int least) {
    const double most = range / least;
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= most) return digit * power;
    return power;
}

}  // namespace voledit
