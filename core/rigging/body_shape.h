#pragma once
// A body to be rigged: its voxels along its own axes, with what the templates ask of them.

#include "core/rigging/curve_skeleton.h"

namespace voledit {

/// A plane section of the body: what of it is connected to the point asked for.
struct Section {
    std::size_t cells = 0;  // 0: nothing is there
    Vec3 mean{0};
    Box3 box;  // of the cells' centres
};

/// x left, y up, z front. Cavities that nothing from outside reaches (air in a skull) count as flesh.
struct BodyShape {
    OpaqueVoxels voxels;
    std::vector<float> distance;  // of `voxels`
    CurveSkeleton tree;
    Box3 box;         // of the opaque cells' centres
    Vec3 mean{0};     // of them
    double step = 1;  // the largest spacing, world units

    BodyShape(OpaqueVoxels body, double thinness);

    /// The section across `normal` (unit) through p: cells within half a step of the plane, connected to the one
    /// nearest to p (26 neighbours), not farther than `reach` from p.
    Section sectionAt(const Vec3& p, const Vec3& normal, double reach) const;
    /// The level section at height y of the part nearest to (x, z) of `near`.
    Section levelAt(double y, const Vec3& near) const;
};

/// The voxels with closed cavities filled.
OpaqueVoxels withoutCavities(OpaqueVoxels voxels);

}  // namespace voledit
