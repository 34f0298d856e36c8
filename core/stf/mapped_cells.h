#pragma once
// Mapped cells: the one meeting place of all forward maps (definitions.md §6).

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

class CellLocator;

/// A point found in a tetrahedron.
struct CellLocation {
    std::uint32_t tetrahedron;          // index into MappedCells::tetrahedra()
    std::array<double, 4> barycentric;  // weights of its vertices, each ≥ 0, sum 1
};

/// Cells with deformed positions and source coordinates at their vertices: hexahedra, each split into six tetrahedra
/// along the diagonal 0–7 (vertices numbered i + 2j + 4k), the same way in every cell, so that neighbours share their
/// face diagonals and leave no crack; or tetrahedra by themselves, oriented either way. Within a tetrahedron the map is
/// affine, so barycentric interpolation gives q from p exactly. Knows nothing of where it came from. Immutable after
/// construction.
class MappedCells {
public:
    struct Data {
        std::vector<Vec3> deformed;  // p of each vertex, world units
        std::vector<Vec3> source;    // q of each vertex, world units of the rest space
        std::vector<Mat3> jacobian;  // dq/dp at each vertex; empty: taken from the tetrahedra around the vertex
        std::vector<std::array<std::uint32_t, 8>> hexahedra;
        /// Tetrahedra by themselves, in place of hexahedra: meshes. At most one of the two lists may hold anything.
        /// They are handed over to `MappedCells::tetrahedra()`.
        std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    };

    /// Throws Error if an index is out of range, a size differs, a position is not finite, or there are both hexahedra
    /// and tetrahedra. Cheap; what only point
    /// location needs is built on its first use (safely from many threads).
    explicit MappedCells(Data data);
    ~MappedCells();
    MappedCells(const MappedCells&) = delete;
    MappedCells& operator=(const MappedCells&) = delete;

    std::span<const Vec3> deformed() const { return data_.deformed; }
    std::span<const Vec3> source() const { return data_.source; }
    std::span<const Mat3> jacobians() const { return data_.jacobian; }
    /// Empty where the cells are tetrahedra.
    std::span<const std::array<std::uint32_t, 8>> hexahedra() const { return data_.hexahedra; }
    /// Those of the cells, in their order: tetrahedron t belongs to cell t / tetrahedraPerCell(). Degenerate ones (zero
    /// deformed volume) stay in the list, so that indices hold, but are never found nor drawn.
    std::span<const std::array<std::uint32_t, 4>> tetrahedra() const { return tetrahedra_; }
    /// 6 where the cells are hexahedra, 1 where they are tetrahedra.
    std::uint32_t tetrahedraPerCell() const { return data_.hexahedra.empty() ? 1 : 6; }
    /// Hexahedra, or tetrahedra that stand by themselves.
    std::size_t cellCount() const { return tetrahedra_.size() / tetrahedraPerCell(); }
    /// The eight or four vertices of a cell.
    std::span<const std::uint32_t> cellVertices(std::size_t cell) const {
        if (data_.hexahedra.empty()) return tetrahedra_[cell];
        return data_.hexahedra[cell];
    }
    /// Signed deformed volume × 6 over source volume × 6 (the determinant of dp/dq); negative where the map folds, 0
    /// where degenerate, ±infinity where only the source is flat. One for each tetrahedron.
    std::span<const double> determinants() const { return determinants_; }

    /// Box of the deformed positions.
    const Box3& bounds() const { return bounds_; }
    /// A thickness, world units, below which a deformed tetrahedron counts as degenerate and within which a point
    /// counts as touching one: a few rounding errors of the largest coordinate.
    double thickness() const { return thickness_; }
    /// False only if no point has several pre-images; true where cells fold or overlap, and where they touch or are
    /// degenerate so that they might: then renderers must combine the pre-images. Found out on first use (README.md).
    bool mayOverlap() const;
    /// One for each cell: 0 only if no point inside it lies in another cell, too (overlapping_cells.h). All 0 where
    /// !mayOverlap(). Found out on first use.
    std::span<const char> overlapping() const;

    /// Faces of the convex solid that the sources fill, empty where they fill none (source_solid.h). Found out on first
    /// use.
    std::span<const Vec4> sourceFaces() const;

    /// Appends every tetrahedron that contains p, in the order of tetrahedra(). A point on a shared face, edge or
    /// vertex is reported once for each pre-image, not once for each tetrahedron that touches it: locations of one
    /// source point (within rounding) count once, as the first of them. On the crease of a fold, where two sheets meet
    /// in one source point, that is one pre-image.
    void locateAll(const Vec3& p, std::vector<CellLocation>& found) const;
    /// The first of `locateAll`; false where there is none.
    bool locate(const Vec3& p, CellLocation& found) const;
    /// The same, trying tetrahedron `hint` and its neighbours in the cell first; several times as fast for points that
    /// follow one another closely. `hint` becomes the tetrahedron found. Where !mayOverlap(), a point well inside a
    /// tetrahedron is found in it, and any other as `locate` finds it; where mayOverlap() the hint is not used.
    bool locateNear(const Vec3& p, std::uint32_t& hint, CellLocation& found) const;

    /// True, with the location, where p lies well inside tetrahedron `hint`, or another of its cell, and that cell
    /// overlaps no other: then this is p's only pre-image. False says nothing: ask `locateAll`.
    bool locateAlone(const Vec3& p, std::uint32_t& hint, CellLocation& found) const;

    /// q at a location, exact within the tetrahedron.
    Vec3 sourceAt(const CellLocation& at) const;
    /// dq/dp at a location, interpolated from the vertices.
    Mat3 jacobianAt(const CellLocation& at) const;

    /// Calls found(source) with boxes in source space, one for each tetrahedron that may hold points of `box`, until it
    /// gives true; gives whether it did. Every source point of a point in `box` lies in one of them.
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const;
    /// Calls found(t) for each tetrahedron that may hold points of `box`, until it gives true; gives whether it did.
    bool anyTetrahedron(const Box3& box, const std::function<bool(std::uint32_t)>& found) const;

    /// q[i] of each p[i] in parallel (`locate`, `sourceAt`); kUndefined outside. Needs equal sizes; may alias.
    void map(std::span<const Vec3> p, std::span<Vec3> q) const;

private:
    struct Lazy;
    const CellLocator& locator() const;
    void setThickness();
    void splitHexahedra();

    Data data_;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra_;
    std::vector<double> determinants_;
    Box3 bounds_;
    double thickness_ = 0;
    std::unique_ptr<Lazy> lazy_;
};

/// Vertex numbers (i + 2j + 4k) of the six tetrahedra of a hexahedron, all along the diagonal 0–7, positively oriented
/// in an undeformed cell.
extern const std::array<std::array<int, 4>, 6> kHexahedronTetrahedra;

/// A rest-space grid of `count` cells an axis over `frame`: vertices i fastest, (count+1) each, and their hexahedra.
/// `deformed` and `source` are both the rest positions: the undeformed box as mapped cells.
MappedCells::Data gridCells(const Frame& frame, Index3 count);

}  // namespace voledit
