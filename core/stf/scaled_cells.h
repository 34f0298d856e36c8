#pragma once
// A forward map's displacement scaled: what `amount` makes of a lattice.

#include "core/stf/mapped_cells.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ(p) = p + amount·(Ψ₀(p) − p) for a map Ψ₀ of mapped cells (definitions.md §3.1: Δ scaled). Ψ₀ is affine within a
/// tetrahedron, so Ψ is too: scaled cells are cells again, at the same deformed positions x with the source
/// coordinates x + amount·(s − x), exactly. Undefined (or kept) where Ψ₀ is.
class ScaledCells final : public SpatialTransferFunction {
public:
    /// `map` must have cells.
    ScaledCells(const SpatialTransferFunction& map, double amount);

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    const MappedCells* cells() const override { return &cells_; }
    Outside outside() const override { return outside_; }

private:
    MappedCells cells_;
    Outside outside_;
};

}  // namespace voledit
