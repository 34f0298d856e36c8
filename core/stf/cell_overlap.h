#pragma once
// Whether mapped cells can lie over each other.

#include "core/stf/mapped_cells.h"

namespace voledit {

/// False only if no point lies inside several cells. Where all tetrahedra that share a face lie on its two sides and
/// the outer faces of a connected set of cells do not touch each other, those faces wind once about every point within,
/// and the number of tetrahedra about a point is that winding number: one. So the cells may overlap if
/// - tetrahedra of one hexahedron or on a shared face are inverted relative to each other (a fold), or degenerate,
/// - a face belongs to more than two tetrahedra, or outer faces touch (more than in the vertices that they share), or
/// - the box of one connected set of cells lies within that of another, or
/// - outer faces lie about each other so densely that trying their pairs would take too long.
/// Costs a few milliseconds for 16³ cells.
bool cellsMayOverlap(const MappedCells& cells);

}  // namespace voledit
