#pragma once
// Points of one cell of a locator's grid, located several at a time by vector instructions.

#include <span>

#include "core/stf/cell_locator.h"

namespace voledit {

/// What a locator knows of its cells.
struct PacketCells {
    const CellLocator::Inverse* tetrahedra;
    const Box3* boxes;
    std::uint32_t perCell;
};

/// The first tetrahedron that accepts a point, and the weights of its vertices 1, 2, 3 as they come out (not clamped).
struct PacketFound {
    static constexpr std::uint32_t kNowhere = ~0U;
    std::uint32_t tetrahedron;
    std::array<double, 3> weights;
};

/// found[n] of p[n] among the cells `candidates` (ascending): the same numbers, to the bit, as one point at a time.
void locatePackets(const PacketCells& cells, std::span<const std::uint32_t> candidates, std::span<const Vec3> p,
                   std::span<PacketFound> found);

}  // namespace voledit
