#pragma once
// The biped: its joints laid into a body that stands along the grid's axes.

#include "core/rigging/curve_skeleton.h"
#include "core/rigging/rig.h"

namespace voledit {

/// The biped's skeleton laid into `body`, which stands with its left along x, up along y and front along z.
Skeleton bipedIn(const OpaqueVoxels& body, const RigOptions& options);

/// The biped's 24 limbs: one for each joint that has one below, named like it, but for the clavicles, which begin in
/// the chest where no bone leads to them; and one from Hips to each leg, LeftHip and RightHip.
std::vector<Limb> bipedLimbs(const Skeleton& skeleton);

}  // namespace voledit
