#include <algorithm>

#include "core/rigging/curve_skeleton.h"
#include "core/rigging/limb_boxes.h"
#include "core/rigging/rig.h"

namespace voledit {

std::vector<Limb> fittedLimbs(const OpaqueVoxels& voxels, const std::vector<PosedJoint>& rest, std::vector<Limb> limbs,
                              const std::vector<bool>& fit, const RigOptions& options) {
    const auto distance = distanceField(voxels);
    const auto rims = rimsOf(voxels, limbParts(voxels, distance, limbs, rest), limbs.size());
    const double margin = options.margin * std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z});
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!fit.empty() && !fit[l]) continue;
        LimbExtents extents = extentsOf(limbs[l], rest, rims[l]);
        if (extents.empty()) extents = {Vec3(0), Vec3(0)};
        limbs[l] = boxed(limbs[l], rest, extents, std::max(margin, 1e-3 * lengthOf(limbs[l], rest)));
    }
    return limbs;
}

}  // namespace voledit
