#pragma once
// Which cells rays have to look into: bricks of a volume, or cells of a baked map's grid.

#include "core/base/quad.h"
#include "core/eval/baked_map.h"
#include "core/fields/brick_set.h"
#include "core/fields/value_bricks.h"
#include "render/march_table.h"

namespace voledit {

/// More cells are merged by twos along each axis: finding their distances would cost more than it saves.
constexpr std::size_t kMostCells = 300'000;

/// Smallest and largest finite value; 0, 0 where there is none.
Interval finiteRangeOf(const ValueBricks& bricks);

/// Bricks of ValueBricks::kSide << shift voxels that hold something that absorbs.
struct VisibleBricks {
    BrickSet set;
    int shift = 0;

    double side() const { return double(ValueBricks::kSide << shift); }
    /// False only if nothing can be seen in `box` (index space); in constant time.
    bool any(const Box3& box) const { return any(quadOf(box.min), quadOf(box.max)); }
    bool any(Quad min, Quad max) const;
};
/// As fine as kMostCells allows.
VisibleBricks visibleBricks(const ValueBricks& values, const MarchTable& table);

/// For each cell of a baked map's grid (i fastest) whether anything can be seen in it, places being index coordinates,
/// `clip` what bounds them.
struct SeenCells {
    std::vector<std::uint8_t> seen;
    bool known = true;  // false: some that may show something have a corner that is not known
};
SeenCells seenCells(const BakedMap& map, const VisibleBricks& bricks, const Box3& clip);

/// Those cells as a set, 1 << shift of them along each axis merged.
BrickSet mergedCells(Index3 count, const std::vector<std::uint8_t>& seen, int shift);

}  // namespace voledit
