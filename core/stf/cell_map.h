#pragma once
// Forward maps as STFs: mapped cells, and what happens outside them.

#include "core/stf/mapped_cells.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ of mapped cells. Lattices derive from it; imported forward maps (`mapped`) and scaled ones are it.
class CellMap : public SpatialTransferFunction {
public:
    CellMap(MappedCells::Data cells, Outside outside) : cells_(std::move(cells)), outside_(outside) {}

    void map(std::span<const Vec3> p, std::span<Vec3> q) const final;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const final;
    /// Boxes of the cells whose source meets `rest`; `rest` too where the outside is kept.
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const final;
    const MappedCells* cells() const final { return &cells_; }
    Outside outside() const final { return outside_; }
    void accept(TransferVisitor& visitor) const final { visitor.visitCells(*this); }

private:
    MappedCells cells_;
    Outside outside_;
};

/// Ψ(p) = p + amount·(Ψ₀(p) − p) for a map Ψ₀ of mapped cells (definitions.md §3.1: Δ scaled). Ψ₀ is affine within a
/// tetrahedron, so Ψ is too: scaled cells are cells again, at the same deformed positions x with the source
/// coordinates x + amount·(s − x), exactly. Undefined (or kept) where Ψ₀ is. `map` must have cells.
TransferPtr scaledCells(const SpatialTransferFunction& map, double amount);

}  // namespace voledit
