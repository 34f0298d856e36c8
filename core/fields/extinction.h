#pragma once
// Opacity as extinction, and the values over which tables of it have something to tell.

#include "core/base/interval.h"
#include "core/fields/transfer_function.h"

namespace voledit {

/// Opacity counts as no more than that, which keeps extinction finite (definitions.md §2).
inline constexpr double kLargestOpacity = 0.9999;

/// The extinction where opacity is `opacity`, a share of 1 for each opacity distance: −ln(1 − opacity), 0 below 0.
double extinctionOf(double opacity);

/// The values in `data` over which a table of `look` has something to tell: not far beyond its corners, where nothing
/// changes any more. `beyond` is how far, as a share of the distance between the first and the last corner; but at
/// least `least` of their magnitude, so that single precision tells the table's entries apart. Never empty or endless.
Interval tabulatedRange(const TransferFunction& look, const Interval& data, double beyond, double least);

}  // namespace voledit
