#pragma once
// How a plane cuts a tetrahedron or a brick: which edges, in which order round the polygon.

#include <array>
#include <cstdint>
#include <span>

namespace voledit {

/// Edges as pairs of vertex numbers. A brick's vertices are numbered i + 2j + 4k.
extern const std::array<std::array<int, 2>, 6> kTetrahedronEdges;
extern const std::array<std::array<int, 2>, 12> kBrickEdges;

/// A polygon: edges that the plane cuts, in order round it; none where it misses the cell.
struct CutPolygon {
    std::uint8_t count = 0;
    std::array<std::uint8_t, 6> edge{};
};

/// By the mask of vertices that lie in front of the plane (bit v for vertex v): 16 entries.
std::span<const CutPolygon> tetrahedronCuts();
/// 256 entries; masks that no plane makes are empty.
std::span<const CutPolygon> brickCuts();

}  // namespace voledit
