#pragma once
// Laying a skeleton into an object and fitting regions to it.

#include <string>
#include <vector>

#include "core/rigging/opaque_voxels.h"
#include "core/skeleton/limb_regions.h"

namespace voledit {

enum class RigTemplate : std::uint8_t { Biped, Quadruped, Chain };
/// "biped", "quadruped", "chain"; throws Error for other words.
RigTemplate rigTemplateOf(const std::string& word);
const char* nameOf(RigTemplate rig);

/// A skeleton in the object's own space, with its limbs.
struct Rig {
    Skeleton skeleton;
    std::vector<Limb> limbs;
};

struct RigOptions {
    double thinness = 0.6;  // of the curve skeleton (curve_skeleton.h)
    int chain = 8;          // limbs of a chain
    double margin = 1;      // cells that regions reach beyond the opaque ones
};

/// The template that the shape suits: a biped where two legs and two arms are found on both sides of a trunk, a
/// quadruped where it stands on four legs, else a chain.
RigTemplate suitedTemplate(const OpaqueVoxels& voxels, const RigOptions& options = {});

/// The template laid in: first by bounds (which axis is up, which is front are found from the shape), then joints moved
/// to the curve skeleton: branch points (neck, shoulders, hips), extremities (head, hands, feet) and bends between.
/// Biped has 24 limbs (Hips, Spine, Spine1, Spine2, Neck, Head, Left/Right UpLeg, Leg, Foot, ToeBase, Shoulder, Arm,
/// ForeArm, Hand, with ends named …_End). Then regions are fitted (`fittedLimbs`). Throws Error where nothing is
/// opaque.
Rig fittedRig(const OpaqueVoxels& voxels, RigTemplate rig, const RigOptions& options = {});

/// Sizes, offsets and pads of the limbs for which `fit[l]` is true (empty: of all), such that the regions at rest hold
/// the opaque voxels nearest to each limb, and little else. `rest`: the joints in the object's space.
std::vector<Limb> fittedLimbs(const OpaqueVoxels& voxels, const std::vector<PosedJoint>& rest, std::vector<Limb> limbs,
                              const std::vector<bool>& fit, const RigOptions& options = {});

/// How the regions at rest cover the opaque voxels.
struct Coverage {
    std::size_t opaque = 0;             // voxels
    std::size_t uncovered = 0;          // in no region
    std::size_t doubly = 0;             // in two regions or more
    std::vector<std::uint8_t> regions;  // of each voxel of the grid: how many hold it (255 at most); 0 where not opaque
    std::vector<std::size_t> ofLimb;    // opaque voxels in each limb's region
    double covered() const { return opaque ? 1 - double(uncovered) / double(opaque) : 1; }
};
Coverage coverageOf(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                    const RegionOptions& options);

}  // namespace voledit
