#pragma once
// Mapped cells as arrays in single precision: what a fragment needs to find its points in them.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/stf/mapped_cells.h"

namespace voledit {

/// Several maps as arrays, laid out as shaders/common/cell_search.glsl reads them. Each has a uniform grid over its
/// deformed positions, and points come in units of its cells ("grid coordinates"), so that single precision is
/// relative to them.
struct CellArrays {
    struct Map {
        Mat4f nextFromThis{1};                // what `outside: keep` does, in chains of maps
        std::array<std::int32_t, 4> grid{};   // cells along each axis; where its starts begin in `cells`
        std::array<std::int32_t, 4> keeps{};  // [0] is 1 for `outside: keep`, in chains of maps
    };
    /// Vertex 0, and rows that take p − vertex 0 to the weights of vertices 1, 2, 3. The fourth numbers are how far
    /// below 0 the weights of vertices 0, 1, 2, 3 may lie.
    struct Tetrahedron {
        Vec4f origin{0};
        std::array<Vec4f, 3> weight{};
    };
    /// Where a vertex leads, and the derivative of that: for chains of maps in the next one's grid coordinates by this
    /// one's, for term programs d q / d p. Of a mesh the first number is the value, the next three are its gradient.
    struct Vertex {
        Vec3f next{0};
        Mat3f jacobian{1};
    };

    std::vector<Map> maps;
    /// Starts of each grid cell's list, one more at the map's end; the lists: tetrahedra that may meet it, ascending.
    std::vector<std::uint32_t> cells;
    std::vector<Tetrahedron> tetrahedra;
    std::vector<std::array<std::uint32_t, 4>> corners;  // vertices of each
    std::vector<Vertex> vertices;
};

/// The grid of one map.
struct CellGrid {
    Index3 resolution{1};
    Mat4 gridFromDeformed{1};
    double tolerance = 0;  // how far beyond its faces a tetrahedron accepts points, in units of grid cells

    /// First and last cell that the box of `corners` (grid coordinates) meets.
    std::pair<Index3, Index3> range(std::span<const Vec3, 4> corners) const;
};
CellGrid gridOver(const MappedCells& cells);

/// Appends the tetrahedra, the grid's starts and lists. Throws Error where they are too many for 32 bits.
void appendCells(const MappedCells& cells, const CellGrid& grid, CellArrays& made);
/// Appends the vertices, one for each of `cells`, and the tetrahedra's corners. After `appendCells` of the same.
void appendVertices(const MappedCells& cells, std::span<const CellArrays::Vertex> vertices, CellArrays& made);

}  // namespace voledit
