#pragma once
// Cells of unstructured grids as tetrahedra.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace voledit {

/// Vertices of a cell of VTK's type `type`: 10 tetrahedron, 11 voxel, 12 hexahedron, 13 wedge, 14 pyramid; 0 for
/// others, which fill no volume or are curved.
std::size_t verticesOfCell(std::uint32_t type);

/// Appends the tetrahedra of a cell of one of those types: a tetrahedron itself, the others the cone from their vertex
/// of lowest number over the faces that do not hold it, quadrilaterals being halved from their vertex of lowest number
/// [Dompierre, Labbé, Vallet, Camarero: How to Subdivide Pyramids, Prisms and Hexahedra into Tetrahedra, 1999]. So
/// neighbours of any types share their face diagonals, however their vertices are ordered; a hexahedron numbered like a
/// grid's cell is split along 0–7, as mapped cells split theirs. Tetrahedra with a vertex twice are left out (collapsed
/// cells). `vertices`: verticesOfCell(type) of them, in VTK's order.
void appendTetrahedra(std::uint32_t type, std::span<const std::uint32_t> vertices,
                      std::vector<std::array<std::uint32_t, 4>>& tetrahedra);

/// "triangle", "quadratic tetrahedron", … or "type 99", for messages.
std::string nameOfCell(std::uint32_t type);

}  // namespace voledit
