#pragma once
// The limbs' regions at rest as one hexahedron each, for fitting: where in it a point lies.

#include <array>

#include "core/skeleton/limb_regions.h"

namespace voledit {

/// A hexahedron, corners i + 2j + 4k, k along the bone.
class RestHexahedron {
public:
    explicit RestHexahedron(const std::array<Vec3, 8>& corners);

    /// Coordinates (u, v, w) of p, each in [0, 1] within, by Newton's method on the trilinear map, at most 8 steps from
    /// the middle. kUndefined where it does not converge, far outside.
    Vec3 local(const Vec3& p) const;
    bool holds(const Vec3& p) const {
        const Vec3 c = local(p);
        return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x <= 1 && c.y <= 1 && c.z <= 1;
    }
    /// Change of the point with u, v and w at the middle, as columns.
    const Mat3& middleEdges() const { return edges_; }

private:
    std::array<Vec3, 8> coefficients_;  // of 1, u, v, w, uv, uw, vw, uvw
    Mat3 edges_, inverse_;
};

/// One for each limb. Throws Error as limbRegions does.
std::vector<RestHexahedron> restHexahedra(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest);

}  // namespace voledit
