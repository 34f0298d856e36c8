#pragma once
// Boxes about bones: their extents in the bone's frame, and the turns at which they are tight.

#include "core/rigging/limb_parts.h"

namespace voledit {

/// Extents of points in a bone's frame at its start joint: x and y across the bone, z along it; empty where there are
/// none.
struct LimbExtents {
    Vec3 low{kInfinity}, high{-kInfinity};
    bool empty() const { return low.x > high.x; }
    void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// Unit vector from the limb's first joint to its last. Needs joints apart.
Vec3 directionOf(const Limb& limb, const std::vector<PosedJoint>& rest);
double lengthOf(const Limb& limb, const std::vector<PosedJoint>& rest);

/// The roll with which boneFrame(direction, roll) has the projection of `x` as its first column.
double rollTowards(const Vec3& direction, const Vec3& x);

/// Positions of the voxels of each limb that lie at the surface, or next to voxels of others: what extents follow from.
std::vector<std::vector<Vec3>> rimsOf(const OpaqueVoxels& voxels, const std::vector<std::int16_t>& parts,
                                      std::size_t limbs);

/// The limbs with rolls such that the frames of limbs that continue one another differ by the shortest arc between
/// their bones only, so that their boxes meet without a twist; each such chain as a whole is turned so that the boxes
/// about `rims` have the least volume, if that is worth it. With no rims, a chain's first frame is the plain one.
std::vector<Limb> alignedRolls(std::vector<Limb> limbs, const std::vector<PosedJoint>& rest,
                               const std::vector<std::vector<Vec3>>& rims);

/// Extents of `rim` in the limb's frame.
LimbExtents extentsOf(const Limb& limb, const std::vector<PosedJoint>& rest, const std::vector<Vec3>& rim);

/// The limb with a box that holds the extents, and `margin` (world units) more on every side.
Limb boxed(Limb limb, const std::vector<PosedJoint>& rest, const LimbExtents& extents, double margin);

}  // namespace voledit
