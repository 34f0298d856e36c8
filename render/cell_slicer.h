#pragma once
// Cuts cells by view-aligned planes into polygons for the GPU. Done on the CPU, as that is faster than any way of doing
// it in llvmpipe's vertex stage (performance.md); a GPU's way would replace this class alone.

#include <cstdint>
#include <span>
#include <vector>

#include "render/cell_mesh.h"
#include "render/view.h"

namespace voledit {

/// Triangles of several slices, front to back, for one upload. Reused, it keeps its memory.
struct SliceBatch {
    std::vector<float> vertices;          // CellSlicer::floatsPerVertex() each
    std::vector<std::uint32_t> indices;   // three a triangle
    std::vector<std::size_t> firstIndex;  // of each slice, and the end: slices + 1
    std::size_t polygons = 0;

private:
    friend class CellSlicer;
    std::vector<std::uint32_t> cells_;                   // that the batch's slices may cut
    std::vector<std::uint32_t> vertexOfEdge_, madeFor_;  // an edge's vertex holds if madeFor_ is the current slice
    std::uint32_t generation_ = 0;
};

/// A mesh seen from one camera. Cutting is const and may be called from many threads, each with its own batch.
class CellSlicer {
public:
    /// `mesh` and `visibility` must outlive it. Cells outside the view are left out, and polygons of tetrahedra that
    /// cannot be seen where the mesh was made with margins; `domain` is the volume's, in index space.
    CellSlicer(const CellMesh& mesh, const View& view, const Box3& domain, const Visibility& visibility);

    /// Depth of the nearest vertex of the whole mesh, those of cells that were left out too: where slices start
    /// counting, so that they do not move with what is visible. Negative behind the eye.
    double start() const { return start_; }
    /// Depth halfway to the farthest such vertex: numbers relative to it are small.
    double middle() const { return middle_; }
    /// Depths of the nearest (≥ 0) and farthest point of the cells in view; nearest ≥ farthest if there are none.
    double nearest() const { return nearest_; }
    double farthest() const { return farthest_; }
    /// Pixels that the cells may cover: x, y, width, height, y up.
    std::array<int, 4> window() const { return window_; }
    std::size_t cellsInView() const { return cellsInView_; }

    /// Position (3), for tetrahedra index (3) and Jacobian (9) too, as slice.vert takes them.
    int floatsPerVertex() const { return mesh_.kind == CellMesh::Kind::Brick ? 3 : 15; }

    /// Slices at `depth`, `depth` + `distance`, …, `count` of them, into `batch`. Vertices hold depth −
    /// `referenceDepth`.
    void cut(double depth, double distance, int count, double referenceDepth, SliceBatch& batch) const;

private:
    void place(const View& view);
    void cover(const View& view);
    void gather(double from, double to, SliceBatch& batch) const;
    void cutSlice(double depth, float relativeDepth, SliceBatch& batch) const;
    bool polygonSeen(std::uint32_t cell, std::span<const std::uint32_t> corners, const SliceBatch& batch) const;
    std::uint32_t vertexOn(std::uint32_t edge, double depth, float relativeDepth, SliceBatch& batch) const;

    const CellMesh& mesh_;
    Box3 domain_;
    const Visibility& visibility_;
    std::vector<Vec3> position_;             // view space (view.h)
    std::vector<float> cellNear_, cellFar_;  // depths, rounded outwards; near > far: out of view
    double start_ = 0, middle_ = 0, nearest_ = 0, farthest_ = 0;
    std::array<int, 4> window_{};
    std::size_t cellsInView_ = 0;
};

}  // namespace voledit
