#pragma once
// Cells that slices cut: bricks of an affinely placed volume, or the tetrahedra of mapped cells.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/fields/volume.h"
#include "core/stf/mapped_cells.h"
#include "render/visibility.h"

namespace voledit {

/// Visible cells of one kind with shared vertices and edges. A plane cuts an edge in one point for all cells around
/// it, so that neighbours share it to the bit and leave no crack; no vertex lies within another cell's edge.
struct CellMesh {
    enum class Kind : std::uint8_t { Brick, Tetrahedron };
    /// Index coordinates and their derivative along the world's axes (columns), for tetrahedra; bricks have none, as
    /// one matrix holds for all of them. Where other maps are located, their first's grid coordinates instead.
    struct Source {
        Vec3f index;
        Mat3f jacobian;
    };

    Kind kind = Kind::Brick;
    std::vector<Vec3> position;                       // world, one for each vertex
    std::vector<Source> source;                       // the same, or empty
    std::vector<std::array<std::uint32_t, 2>> edges;  // vertices
    std::vector<std::uint32_t> cellVertices;          // 8 or 4 for each cell, as in cell_cut.h
    std::vector<std::uint32_t> cellEdges;             // 12 or 6 for each cell
    /// For tetrahedra that were culled by visibility: how far beyond a polygon, in index units and more than Visibility
    /// answers for, its slab may reach; one for each cell, else empty.
    std::vector<Vec3f> margin;
    std::size_t culled = 0;  // cells left out as nothing in them can be seen

    int verticesPerCell() const { return kind == Kind::Brick ? 8 : 4; }
    int edgesPerCell() const { return kind == Kind::Brick ? 12 : 6; }
    std::size_t cellCount() const { return cellVertices.size() / std::size_t(verticesPerCell()); }
};

/// Whether anything of `box` (index space) and `margin` around it can be seen; `domain` is the volume's.
bool canBeSeen(Box3 box, const Vec3& margin, const Box3& domain, const Visibility& visibility);

/// `count` bricks an axis (i fastest), without those whose `seen` is 0; `positionOf` gives the world position of the
/// corners, counted from 0 to `count`.
CellMesh brickMesh(const Index3& count, const std::vector<char>& seen,
                   const std::function<Vec3(const Index3&)>& positionOf);

/// Bricks of 8³ voxels over the volume's domain, moved to the world by `worldFromIndex`.
/// @param slab  extent of a slab along a ray at most, world units; what is seen there counts too
CellMesh brickMesh(const VolumeGrid& grid, const Mat4& worldFromIndex, const Visibility& visibility, double slab);

/// Tetrahedra of `cells`, in their order, without degenerate ones.
/// @param worldFromDeformed,indexFromSource  affine maps outside and inside the cells
/// @param wanted  one for each cell: whether its tetrahedra are taken; empty: all are
CellMesh tetrahedronMesh(const MappedCells& cells, const Mat4& worldFromDeformed, const Mat4& indexFromSource,
                         const VolumeGrid& grid, const Visibility& visibility, double slab,
                         const std::vector<char>& wanted = {});

/// The same where source coordinates go on to maps that fragments locate (located_maps.h).
/// @param seen  one for each hexahedron: its tetrahedra are left out where it is 0
CellMesh tetrahedronMesh(const MappedCells& cells, const Mat4& worldFromDeformed, const Mat4& entryFromSource,
                         const std::vector<char>& seen);

/// For each cell 1 unless mayBeSeen(box) says of the boxes of source space that its slabs show that nothing can be seen
/// there. Calls it from many threads.
/// @param slab  extent of a slab along a ray at most, world units; what is seen there counts too
std::vector<char> cellsSeen(const MappedCells& cells, const Mat4& worldFromDeformed, double slab,
                            const std::function<bool(const Box3&)>& mayBeSeen);

/// One brick: `box` moved to the world by `worldFromBox`.
CellMesh boxMesh(const Box3& box, const Mat4& worldFromBox);

}  // namespace voledit
