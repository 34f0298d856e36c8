#pragma once
// Bounds of one operation from bounds of its operands. Internal to core/expression.

#include "core/expression/formula_graph.h"

namespace voledit {

/// All values that a node may take, rounding included, low ≤ high; and whether it may be NaN as well, since a
/// comparison with NaN is false whatever the numbers.
struct Range {
    double low = -kInfinity, high = kInfinity;
    bool mayBeNaN = true;

    static Range of(double value) { return value == value ? Range{value, value, false} : Range{}; }
    bool contains(double x) const { return low <= x && x <= high; }
    bool finite() const { return low > -kInfinity && high < kInfinity; }
};

/// `node` is no constant, variable or parameter; `in` as many as it has operands.
Range rangeOf(const FormulaNode& node, const std::array<Range, 3>& in);

}  // namespace voledit
