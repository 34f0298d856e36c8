#pragma once
// How far the next visible brick of a volume is: what lets a ray pass empty space at a stride.

#include <cstdint>
#include <vector>

#include "core/base/box3.h"
#include "core/fields/value_bricks.h"
#include "core/rays/optical_table.h"

namespace voledit {

/// Bricks of side³ voxels; in `distance` the Chebyshev distance, in bricks, to the nearest brick that may be visible:
/// all bricks nearer than that to a brick are empty. 0: may be visible itself. At most kFarthest.
struct SkipGrid {
    static constexpr int kFarthest = 24;
    int shift = 2;  // side = 1 << shift
    Index3 count{0};
    std::vector<std::uint8_t> distance;  // i fastest; three more bytes at the end, for reads of four at once
    Index3 first{0}, end{0};             // bricks that may be visible lie in [first, end); empty if none is
    std::vector<std::uint32_t> before;   // (count + 1)³: of those, the ones before each corner

    /// False only if nothing in `box` (index space, within the domain) can be seen. In constant time.
    bool mayBeVisible(const Box3& box) const;
};

/// Exact for whatever `table` makes of values between samples.
SkipGrid makeSkipGrid(const ValueBricks& bricks, const OpticalTable& table);

}  // namespace voledit
