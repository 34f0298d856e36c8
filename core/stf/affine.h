#pragma once
// The affine STF, and the placement that `place` shares with it.

#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// p = T · R_z · R_y · R_x · S · q about the world's origin; angles in radians, right-handed about the positive axis.
Mat4 placementMatrix(const Vec3& translate, const Vec3& rotate, const Vec3& scale);

/// Ψ(p) = worldFromRest⁻¹ · p.
class AffineMap final : public SpatialTransferFunction {
public:
    /// @param worldFromRest  affine matrix q → p. Throws Error if it is singular or not finite.
    explicit AffineMap(const Mat4& worldFromRest);

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    std::optional<Mat4> affine() const override { return restFromWorld_; }
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

    const Mat4& worldFromRest() const { return worldFromRest_; }

private:
    Mat4 worldFromRest_;
    Mat4 restFromWorld_;
};

}  // namespace voledit
