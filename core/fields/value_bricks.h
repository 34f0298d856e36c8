#pragma once
// Ranges of a volume's values in small bricks: what tells where there is nothing to see.

#include <vector>

#include "core/base/interval.h"
#include "core/fields/volume.h"

namespace voledit {

/// Smallest and largest finite or infinite value of one channel in bricks of 4³ voxels: brick b of an axis holds the
/// samples 4b … 4b + 4, so that every value interpolated between these lies in its range; with a margin of m voxels
/// those from 4b − m to 4b + 4 + m. Rounded outwards to float.
struct ValueBricks {
    static constexpr int kSide = 4;
    Index3 count{0};               // bricks along each axis: ceil((n − 1) / 4), at least 1
    std::vector<float> low, high;  // i fastest; low > high where a brick holds nothing but NaN

    std::size_t indexOf(Index3 b) const {
        return std::size_t(b.x) + std::size_t(count.x) * (std::size_t(b.y) + std::size_t(count.y) * std::size_t(b.z));
    }
};

/// Goes through the voxels about once, in parallel. Volume::bricks keeps the result without a margin (≥ 0, voxels).
ValueBricks makeValueBricks(const Volume& volume, int channel, int margin = 0);

/// Bounds of what a volume's channel takes in `box` (index space), by whichever interpolation; low > high where it has
/// no value there. From Volume::bricks.
Interval rangeWithin(const Volume& volume, int channel, Interpolation interpolation, const Box3& box);

}  // namespace voledit
