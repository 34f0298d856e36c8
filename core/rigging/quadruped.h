#pragma once
// The quadruped: its joints laid into a body on four legs.

#include "core/rigging/body_shape.h"
#include "core/rigging/rig.h"

namespace voledit {

/// The feet of a body that stands on four legs: where the legs come through the level a little above the ground. [0]
/// hind left, [1] hind right, [2] fore left, [3] fore right; nullopt where there are not four in two pairs.
std::optional<std::array<Vec3, 4>> fourFeet(const BodyShape& body);

/// The quadruped's skeleton laid into `body`: Hips, Spine, Spine1, Spine2 (above the fore legs), Neck, Head, Head_End;
/// Left/Right UpLeg, Leg, Foot, Foot_End under Hips; Left/Right Arm, ForeArm, Hand, Hand_End under Spine2; Tail, Tail1,
/// Tail_End under Hips where there is a tail. Throws Error where the body does not stand on four legs.
Skeleton quadrupedIn(const BodyShape& body);

/// Its limbs: one for each bone, named like the joint where it begins; those that lead to legs and tail LeftHip,
/// RightHip, LeftShoulder, RightShoulder and TailRoot.
std::vector<Limb> quadrupedLimbs(const Skeleton& skeleton);

}  // namespace voledit
