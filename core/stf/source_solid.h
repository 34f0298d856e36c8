#pragma once
// The solid that the sources of mapped cells fill, where it is a simple one: its faces cut what is mapped.

#include <vector>

#include "core/stf/mapped_cells.h"

namespace voledit {

/// Box of the source coordinates.
Box3 sourceBox(const MappedCells& cells);
/// True if the sources fill this box, each point of it once.
bool fillSourceBox(const MappedCells& cells);

/// Faces of a solid at most.
constexpr std::size_t kMostSourceFaces = 8;
/// The faces of the convex solid that the sources fill, each point of it once: planes with unit normals in source
/// space, plane.xyz · q + plane.w ≥ 0 within. Empty where they fill none, or one with more faces than kMostSourceFaces.
/// Some 0.3 ms for 16³ cells that fill their box, 10 ms for others; `MappedCells::sourceFaces` keeps it.
std::vector<Vec4> findSourceFaces(const MappedCells& cells);
/// `cells.sourceFaces()` in a space where places are spaceFromSource · source, with unit normals.
std::vector<Vec4> sourceFacesIn(const MappedCells& cells, const Mat4& spaceFromSource);
/// Those of `faces` that leave out something of `box`.
std::vector<Vec4> facesThrough(std::vector<Vec4> faces, const Box3& box);

}  // namespace voledit
