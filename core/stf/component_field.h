#pragma once
// A component of an ST or SD object as a scalar field: a deformation seen as a volume.

#include "core/fields/scalar_field.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ_a(p), or Δ_a(p) = Ψ_a(p) − p_a; NaN where Ψ is undefined. The gradient is the row of the Jacobian.
class ComponentField final : public ScalarField {
public:
    /// `axis` 0, 1, 2.
    ComponentField(TransferPtr of, int axis, bool displacement)
        : of_(std::move(of)), axis_(axis), displacement_(displacement) {}
    const TransferPtr& of() const { return of_; }
    int axis() const { return axis_; }
    bool displacement() const { return displacement_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    TransferPtr of_;
    int axis_;
    bool displacement_;
};

}  // namespace voledit
