#pragma once
// What a ray passes, put in order.

#include <span>

#include "core/rays/packet_cells.h"

namespace voledit {

/// Sorts `hits` of cells that do not overlap by where they begin and takes away what rounding left: overlaps, and gaps
/// too short to hold a sample. Gives those that are left, in the same memory.
std::span<CellHit> orderedPieces(std::span<CellHit> hits);

}  // namespace voledit
