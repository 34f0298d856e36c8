#pragma once
// The chain: one bone after another along the longest way through a body.

#include "core/rigging/body_shape.h"
#include "core/rigging/rig.h"

namespace voledit {

/// Joints Chain, Chain1 … Chain<count> at even distances along the body's longest medial path, drawn on at both ends to
/// the surface. It begins at the end that lies lower along the axis of the body's longest side. `count` ≥ 1 bones.
Skeleton chainIn(const BodyShape& body, int count);

/// A limb for each bone, named like the joint where it begins.
std::vector<Limb> chainLimbs(const Skeleton& skeleton);

}  // namespace voledit
