#pragma once
// A set of the cells of a regular grid: whether a box meets it, and how far it is.

#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// Cells of `count` an axis, i fastest, some of which are in the set. Bricks of a volume that can be seen, for one.
class BrickSet {
public:
    BrickSet() = default;
    /// `member` holds count.x · y · z flags.
    BrickSet(Index3 count, std::vector<std::uint8_t> member);

    Index3 count() const { return count_; }
    bool contains(Index3 cell) const { return member_[indexOf(cell)] != 0; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    /// The least box of cells that holds the set: from first to without end; first ≥ end where it is empty.
    Index3 first() const { return first_; }
    Index3 end() const { return end_; }

    /// Whether a cell from `first` to without `end` is in the set; in constant time. They are clamped to the grid, an
    /// empty box to none.
    bool any(Index3 first, Index3 end) const;

    /// For each cell the Chebyshev distance to the nearest one of the set: 0 in it; all cells nearer than that are not
    /// in it. At most `farthest` (≤ 254). In parallel.
    std::vector<std::uint8_t> distances(int farthest) const;

private:
    std::size_t indexOf(Index3 c) const {
        return std::size_t(c.x) + std::size_t(count_.x) * (std::size_t(c.y) + std::size_t(count_.y) * std::size_t(c.z));
    }
    void findBounds();
    void sumUp();

    Index3 count_{0}, first_{0}, end_{0};
    std::size_t size_ = 0;
    std::vector<std::uint8_t> member_;
    std::vector<int> sums_;  // (count + 1)³: members before
};

}  // namespace voledit
