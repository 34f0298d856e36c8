#pragma once
// A transfer function integrated over the value: what a stretch of a ray between two values absorbs and glows.

#include <vector>

#include "core/base/interval.h"
#include "core/fields/transfer_function.h"

namespace voledit {

/// Antiderivatives of extinction and of colour times extinction over the value, tabulated at equal distances ("bins").
/// A stretch of length h, over which the value runs linearly from bin a to bin b, has the optical depth
/// (depth[b] − depth[a]) / (b − a) · h and the mean colour (color[b] − color[a]) / (depth[b] − depth[a])
/// [Engel, Kraus, Ertl 2001]; a value that does not change takes b = a + 1. Exact but for the values' rounding to bins.
struct OpticalTable {
    float low = 0, scale = 1;  // bin of a value: round((value − low) · scale), clamped to [0, last]
    int last = 1;
    std::vector<float> depth;  // last + 2 entries, not decreasing
    std::vector<float> color;  // four for each of them: red, green, blue, 0

    /// False only if no stretch between two values of [low, high], rounded as renderers may round them, absorbs
    /// anything.
    bool mayAbsorb(float lowest, float highest) const;
};

/// A factor on opacity over the gradient's magnitude, data units per world unit, tabulated at equal distances from 0
/// on: entry magnitude · scale, clamped to [0, last] and interpolated. Empty: 1 everywhere.
struct SteepnessTable {
    float scale = 1;
    int last = 1;
    std::vector<float> factor;  // last + 2 entries
};
SteepnessTable makeSteepnessTable(const PiecewiseLinear& gradientOpacity);

/// The table for values in `data`; `whole` says that they are whole numbers. `unit` is the length that h counts in,
/// in opacity distances.
OpticalTable makeOpticalTable(const TransferFunction& look, const Interval& data, bool whole, double unit);

}  // namespace voledit
