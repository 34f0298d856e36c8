#pragma once
// Where a term has nothing to see: what lets a ray pass at a stride, with the same picture.

#include <vector>

#include "core/objects/term_bounds.h"

namespace voledit {

/// Where values of a volume between samples can be visible at all: bricks, and counts of visible ones.
class VisibleBricks {
public:
    explicit VisibleBricks(const VolumeTerm& volume);

    /// False only if every point of `box` (index space) has opacity 0. In constant time.
    bool mayBeVisible(const Box3& box) const;

private:
    Index3 count_;
    Box3 domain_;
    double reach_;                     // how far samples count beyond a box, voxels
    std::vector<std::uint32_t> sums_;  // (count + 1)³: visible bricks before each corner
};

/// Nested grids over a term's bounds, of cells that are certainly empty.
class EmptySpace {
public:
    explicit EmptySpace(const Term& term);

    /// How far the ray from p (within the bounds) along unit `direction` surely meets opacity 0 only; 0 where p itself
    /// may be visible.
    double emptyAhead(const Vec3& p, const Vec3& direction) const;

private:
    struct Level {
        Index3 size;
        std::vector<std::uint8_t> visible;
        std::size_t indexOf(Index3 c) const {
            return std::size_t(c.x) + std::size_t(size.x) * (std::size_t(c.y) + std::size_t(size.y) * std::size_t(c.z));
        }
    };
    void fill(const Term& term, int level, Index3 cell);

    Box3 bounds_;
    double cellSize_ = 1;
    std::vector<Level> levels_;  // finest first; a cell of each holds 4³ of the one before
};

/// The term's EmptySpace, made on first use and kept with it. Safe from many threads.
const EmptySpace& emptySpaceOf(const Term& term);

}  // namespace voledit
