#pragma once
// The biped: its joints laid into a body.

#include "core/rigging/body_shape.h"
#include "core/rigging/rig.h"

namespace voledit {

/// The biped's skeleton laid into `body`. Where the body's curve skeleton and sections do not show a joint (no arms,
/// legs together), it stands where proportions of the body's height have it.
Skeleton bipedIn(const BodyShape& body);

/// The biped's 24 limbs: one for each joint that has one below, named like it, but for the clavicles, which begin in
/// the chest where no bone leads to them; and one from Hips to each leg, LeftHip and RightHip.
std::vector<Limb> bipedLimbs(const Skeleton& skeleton);

}  // namespace voledit
