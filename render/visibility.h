#pragma once
// Which parts of a volume can be seen at all: ranges of values in small bricks, and bits over them.

#include <vector>

#include "core/base/box3.h"
#include "core/fields/volume.h"
#include "render/transfer_table.h"

namespace voledit {

/// Smallest and largest value in bricks of 4³ voxels and one voxel more on every side, so that whatever is interpolated
/// within one voxel of a brick lies in its range. Depends on the volume alone.
struct BrickRanges {
    static constexpr int kSide = 4;
    Index3 bricks{0};              // along each axis: ceil((n − 1) / kSide), at least 1
    std::vector<float> low, high;  // low > high where a brick holds no number
    double min = 0, max = 0;       // of all finite values; 0 where there is none
};

/// In parallel, at about the cost of reading the voxels. Values are rounded to float as the texture's are.
BrickRanges brickRanges(const Volume& volume, int channel);

/// Answers whether a box in index space may be visible, in constant time (a summed-area table over the bricks).
class Visibility {
public:
    /// Everything is visible.
    Visibility() = default;
    Visibility(const BrickRanges& ranges, const TransferTable& table);

    bool seesEverything() const { return sums_.empty(); }
    /// True unless every value interpolated within `box` and less than one voxel around it has opacity 0. `box` is in
    /// index space; what lies outside the volume is not visible.
    bool visible(const Box3& box) const;

private:
    Index3 bricks_{0};
    std::vector<int> sums_;  // (bricks + 1)³, of visible bricks before
};

}  // namespace voledit
