#pragma once
// What limbs and options must be like. Of use to limb_regions.cpp only.

#include "core/skeleton/limb_joints.h"

namespace voledit {

/// Cells of all limbs together: at about half a kilobyte each, 2 GiB.
inline constexpr std::size_t kMostRegionCells = 4'000'000;

/// Throws Error as `limbRegions` documents.
void requireValid(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                  const std::vector<PosedJoint>& posed, const RegionOptions& options);

/// Throws Error, naming a limb, where limbs continue each other in a circle.
void requireNoCircle(const std::vector<Limb>& limbs, const LimbLinks& links);

}  // namespace voledit
