#pragma once
// Free-form deformation lattices: Bézier volumes and uniform cubic B-splines (definitions.md §6.1).

#include <memory>
#include <vector>

#include "core/base/box3.h"
#include "core/stf/cell_map.h"

namespace voledit {

enum class LatticeBasis : std::uint8_t { Bezier, BSpline };

/// An FFD lattice: P(u,v,w) = Σ C_ijk B_i(u) B_j(v) B_k(w) over its rest frame. Bernstein of degree points−1 per axis,
/// or uniform cubic B-splines with clamped knots [Sederberg, Parry 1986; Chen et al. 2003, §4.3].
struct Lattice {
    LatticeBasis basis = LatticeBasis::Bezier;
    Index3 points{4, 4, 4};     // control points an axis: ≥ 2 (Bézier), ≥ 4 (B-spline)
    Frame frame;                // rest frame, world units
    std::vector<Vec3> control;  // points.x·y·z, i fastest, world units

    bool operator==(const Lattice&) const = default;
    std::size_t indexOf(Index3 p) const {
        return std::size_t(p.x) + std::size_t(points.x) * (std::size_t(p.y) + std::size_t(points.y) * std::size_t(p.z));
    }
};

/// Control points at rest: the frame's regular grid (Bézier) or the Greville grid (B-spline); P is then the identity.
std::vector<Vec3> restControlPoints(LatticeBasis basis, Index3 points, const Frame& frame);

/// P(u), world units, for normalised u in [0,1]³ (clamped).
Vec3 evaluate(const Lattice& lattice, const Vec3& u);
/// P and dP/du (columns: along u, v, w).
Vec3 evaluate(const Lattice& lattice, const Vec3& u, Mat3& dPdu);

/// The lattice sampled on a grid of `cells` cells an axis, as a backward map.
class LatticeMap final : public CellMap {
public:
    LatticeMap(Lattice lattice, Index3 cells, Outside outside);

    Box3 imageOf(const Box3& rest) const override;

    const Lattice& lattice() const { return lattice_; }
    /// Control points whose movement folds the map: the ones with the largest influence in each inverted tetrahedron,
    /// as indices into `control`, sorted.
    std::vector<std::size_t> foldingPoints() const;

private:
    Lattice lattice_;
    Index3 count_;  // of cells
};

}  // namespace voledit
