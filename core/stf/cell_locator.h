#pragma once
// Point location in mapped cells: a uniform grid over the cells, exact tests of their tetrahedra.

#include <span>
#include <vector>

#include "core/stf/mapped_cells.h"

namespace voledit {

/// Finds the tetrahedra that contain a point. A tetrahedron accepts points up to `MappedCells::thickness` beyond each
/// face, so that rounding never loses a point between two that share a face; weights are then clamped to it. Immutable.
class CellLocator {
public:
    /// Keeps what it needs of `cells`, which need not live on.
    explicit CellLocator(const MappedCells& cells);

    /// The first tetrahedron, in list order, that accepts p.
    bool first(const Vec3& p, CellLocation& found) const;
    /// Every tetrahedron that accepts p, in list order, appended.
    void all(const Vec3& p, std::vector<CellLocation>& found) const;
    /// Calls found(t) for each tetrahedron that may accept points of `box`, until it gives true; gives whether it did.
    bool anyMeeting(const Box3& box, const std::function<bool(std::uint32_t)>& found) const;
    /// Takes p − (vertex 0) to the weights of vertices 1, 2, 3.
    const Mat3& weightsFromEdge(std::uint32_t tetrahedron) const { return inverses_[tetrahedron].weightsFromEdge; }
    /// Whether p lies in tetrahedron `hint` or another of its cell, farther from its faces than tolerance.
    bool wellInside(const Vec3& p, std::uint32_t& hint, CellLocation& found) const;

    /// q[i] = the source point of p[i] in the first tetrahedron that accepts it, kUndefined where none does: what
    /// `first` finds, several times as fast for many points in any order. Runs in the calling thread; q may be p.
    void firstOfMany(std::span<const Vec3> p, const MappedCells& cells, std::span<Vec3> q) const;
    /// Whether `p` are so many, of so few grid cells, that this is so.
    bool sortingPays(std::span<const Vec3> p) const;
    /// Whether points mostly share the grid cell of the one before (a guess by some of them).
    bool followClosely(std::span<const Vec3> p) const;

    /// A tetrahedron as location needs it.
    struct Inverse {
        Vec3 origin;                      // its vertex 0
        Mat3 weightsFromEdge;             // p − origin to the weights of vertices 1, 2, 3
        std::array<double, 4> tolerance;  // how far below 0 each weight may be; negative: never accepts
    };

private:
    /// Weights of the nearby point that is in the tetrahedron; as they are where the point is.
    static void clampWeights(std::array<double, 4>& weights);
    static std::array<double, 4> weights(const Inverse& tetrahedron, const Vec3& p);
    void buildInverses(const MappedCells& cells);
    void buildGrid(const MappedCells& cells);
    void fillGrid(const Index3& resolution);
    /// Grid cells that `box` meets: from first to last, inclusive.
    std::pair<Index3, Index3> range(const Box3& box) const;
    /// Cells whose boxes meet the grid cell of p, ascending; empty outside.
    std::span<const std::uint32_t> candidates(const Vec3& p) const;
    std::span<const std::uint32_t> entriesOf(const Index3& gridCell) const;
    /// Number of the grid cell of p, which lies in the bounds.
    std::uint32_t gridCellOf(const Vec3& p) const;
    template <class Visit>
    void visit(const Vec3& p, const Visit& accepted) const;

    std::uint32_t perCell_;  // tetrahedra of each cell
    std::vector<Inverse> inverses_;
    std::vector<Box3> boxes_;  // of the cells, grown by the tolerance
    Box3 bounds_;
    Index3 resolution_{1};
    Vec3 cellsPerUnit_{0};
    std::vector<std::uint32_t> starts_;  // of each grid cell's list in entries_; one more at the end
    std::vector<std::uint32_t> entries_;
};

}  // namespace voledit
