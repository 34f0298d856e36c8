#pragma once
// Which limb each opaque voxel belongs to.

#include "core/rigging/opaque_voxels.h"
#include "core/skeleton/limb_regions.h"

namespace voledit {

inline constexpr std::int16_t kNoLimb = -1;

/// For each voxel its limb; kNoLimb where it is not opaque. Limbs spread from their bones through the object, each as
/// fast as its bone lies deep; a voxel climbs the distance field, as steeply as it rises, to the middle of the part
/// that it lies in (so that a flank follows the chest and not an arm that hangs beside it) and takes the limb that came
/// there first. `distance`: `distanceField(voxels)`; `rest`: the joints in the object's space.
std::vector<std::int16_t> limbParts(const OpaqueVoxels& voxels, const std::vector<float>& distance,
                                    const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest);

}  // namespace voledit
