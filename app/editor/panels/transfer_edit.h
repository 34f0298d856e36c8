#pragma once
// Edits of opacity and colour tables, free of any interface.

#include <cstddef>

#include "core/fields/transfer_function.h"

namespace voledit {

/// Inserts (x, y) with y clamped to [0, 1]; gives its index. After points of the same x.
std::size_t insertPoint(PiecewiseLinear& table, const Vec2& at);
/// Moves point `index`: x stays between its neighbours, so that the order holds, y within [0, 1].
void movePoint(PiecewiseLinear& table, std::size_t index, const Vec2& to);
/// Takes point `index` away; the last one stays. False where it stays.
bool removePoint(PiecewiseLinear& table, std::size_t index);

/// Inserts a stop of the colour that the table has at `value`; gives its index.
std::size_t insertStop(ColorTable& table, double value);
/// Moves stop `index`, between its neighbours.
void moveStop(ColorTable& table, std::size_t index, double value);
/// Takes stop `index` away; the last one stays. False where it stays.
bool removeStop(ColorTable& table, std::size_t index);

/// Opacity and colours moved along the value axis together; the gradient's table stays.
TransferFunction shifted(TransferFunction function, double by);

/// Smallest and largest value of the opacity and colour points; low > high where there is none.
struct ValueRange {
    double low = kInfinity, high = -kInfinity;
    double size() const { return high - low; }
    bool operator==(const ValueRange&) const = default;
};
ValueRange rangeOf(const TransferFunction& function);

/// `range` scaled about `fixed` by `factor`, kept from `smallest` to `largest` wide.
ValueRange zoomed(const ValueRange& range, double fixed, double factor, double smallest, double largest);

/// The largest of 1, 2, 5 · 10ⁿ that divides `range` into at least `least` steps, for labels along an axis.
double niceStep(double range, int least);

}  // namespace voledit
