#pragma once
// Which parts of a volume can be seen at all: bits over the ranges of values in small bricks.

#include <utility>
#include <vector>

#include "core/base/box3.h"
#include "core/fields/value_bricks.h"
#include "render/transfer_table.h"

namespace voledit {

/// Voxels round a brick whose values count too (ValueBricks), so that whatever is interpolated within one voxel of a
/// brick lies in its range.
constexpr int kVisibilityMargin = 1;

/// Smallest and largest of all finite values; 0, 0 where there is none.
std::pair<double, double> finiteRange(const ValueBricks& bricks);

/// Answers whether a box in index space may be visible, in constant time (a summed-area table over the bricks).
class Visibility {
public:
    /// Everything is visible.
    Visibility() = default;
    /// @param bricks  with kVisibilityMargin
    Visibility(const ValueBricks& bricks, const TransferTable& table);

    bool seesEverything() const { return sums_.empty(); }
    /// True unless every value interpolated within `box` and less than one voxel around it has opacity 0. `box` is in
    /// index space; what lies outside the volume is not visible.
    bool visible(const Box3& box) const;

private:
    Index3 count_{0};        // of bricks
    std::vector<int> sums_;  // (count + 1)³, of visible bricks before
};

}  // namespace voledit
