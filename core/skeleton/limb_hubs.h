#pragma once
// Limbs that overlap about a hub, drawn along by each other. Of use to limb_regions.cpp only.

#include <span>
#include <vector>

#include "core/skeleton/limb_interior.h"

namespace voledit {

/// What blending needs of all limbs: as many of each.
struct HubLimbs {
    const std::vector<Limb>& limbs;
    const LimbLinks& links;
    const std::vector<PosedJoint>& rest;
    const std::vector<LimbMotion>& motions;
    const std::vector<bool>& disjoint;  // of the joints; empty: none
};

/// A limb that continues none, and one that it is rooted in: whose rest region holds its first joint, or that begins or
/// ends there. None for limbs whose first joint is disjoint.
struct HubRoot {
    int limb = 0, in = 0;
};
std::vector<HubRoot> hubRoots(const HubLimbs& limbs);

/// For each limb the others that meet it about a branch, in an order by their joints: a rooted limb and the one that
/// continues it meet the chains of those that it is rooted in. Chains without branches meet nobody.
std::vector<std::vector<int>> hubNeighbours(const HubLimbs& limbs);

/// Makes limbs that overlap at rest, about a branch, agree where they do, so that what two of them hold moves as one
/// and their faces show no step: a vertex of limb j moves by the mean of what j and its neighbours do there, weighted
/// by how deep it lies in each (1 within, falling to 0 on the faces; faces shared with a continuation do not
/// count). So a partition of unity over the overlapping maps; on a face of j that lies within k, j moves as k does.
/// Only overlaps change, and nothing to the bit where rest and pose are equal.
/// @param sources,deformed  of each limb's whole grid; the second is changed
/// @return for each limb and each of its cells (x fastest) 1 where a neighbour's region holds all eight corners at
/// rest, and those of all cells around it, of neighbours that stand before it: those nearer the trunk, then by their
/// joints
std::vector<std::vector<char>> blendHubs(const HubLimbs& limbs, const LimbGrid& grid,
                                         const std::vector<std::vector<Vec3>>& sources,
                                         std::vector<std::vector<Vec3>>& deformed);

}  // namespace voledit
