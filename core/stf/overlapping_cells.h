#pragma once
// Which mapped cells may lie over others.

#include <vector>

#include "core/stf/mapped_cells.h"

namespace voledit {

/// One for each cell: 0 only if no point inside it lies in another cell, too. Errs towards 1: cells are compared by
/// planes along their faces and across the line of their middles, and all count as overlapping where so many boxes meet
/// that trying their pairs would take too long. Cells that share a vertex lie beside each other unless one of them is
/// inverted relative to most others (a fold) or has degenerate tetrahedra.
std::vector<char> overlappingCells(const MappedCells& cells);

}  // namespace voledit
