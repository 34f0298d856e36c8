#pragma once
// Boxes made smaller where they hold what is others'. Of use to fitted_limbs.cpp only.

#include "core/rigging/limb_boxes.h"

namespace voledit {

/// What boxes are fitted to.
struct FitProblem {
    const std::vector<PosedJoint>& rest;
    std::vector<bool> fit;                   // of each limb
    std::vector<int> next, previous;         // connected limbs; −1 for none
    std::vector<std::vector<int>> attached;  // limbs that touch, but are not connected
    std::vector<std::vector<Vec3>> rims;     // of each limb: voxels that its region is to hold
    double step = 1;                         // of the voxels, world units

    /// The limbs whose regions a voxel of limb l may lie in: its own, those connected and those attached.
    std::vector<int> keepersOf(std::size_t l) const;
};

/// Moves sides of boxes inwards, step by step, as long as that takes more of other limbs' voxels out of the region than
/// of the limb's own, and every voxel of a rim that lies in a region of its keepers still does.
std::vector<Limb> trimmed(std::vector<Limb> limbs, const FitProblem& problem);

}  // namespace voledit
