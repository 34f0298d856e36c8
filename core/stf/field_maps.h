#pragma once
// An ST object of three scalar fields (definitions.md §3), also of deformation fields that registration tools write.

#include <array>

#include "core/fields/scalar_field.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ(p) = (Fx(p), Fy(p), Fz(p)), or p + that for a displacement. Where a field is undefined, so is Ψ, or it is the
/// identity (`outside`).
class FieldsMap final : public SpatialTransferFunction {
public:
    FieldsMap(std::array<FieldPtr, 3> fields, bool displacement, Outside outside);
    const std::array<FieldPtr, 3>& fields() const { return fields_; }
    bool displacement() const { return displacement_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    /// Displacements: `rest` grown by the largest |Δ|; maps: the fields' domain, or else `rest` (definitions.md §3.2).
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    Outside outside() const override { return outside_; }
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::array<FieldPtr, 3> fields_;
    bool displacement_;
    Outside outside_;
};

}  // namespace voledit
