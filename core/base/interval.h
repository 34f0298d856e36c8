#pragma once
// Closed intervals of numbers, for bounds of formulas and fields.

#include "core/base/box3.h"

namespace voledit {

/// All numbers from `low` to `high`; a value that may also be NaN keeps its finite bounds. Default: anything.
struct Interval {
    double low = -kInfinity;
    double high = kInfinity;

    bool operator==(const Interval&) const = default;
    bool contains(double x) const { return low <= x && x <= high; }
};

inline Interval join(const Interval& a, const Interval& b) {
    return {a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

}  // namespace voledit
