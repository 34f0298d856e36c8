#pragma once
// Rays through an undeformed volume, set up a packet at a time.

#include "core/rays/packet_caster.h"

namespace voledit {

/// Rays about a pixel: pixel (x, y), counted from it, passes eye + t · (index[0] + x · index[1] + y · index[2]) in
/// index space; `world` is the same direction in world space, one unit of t long.
struct StraightRays {
    using Numbers = std::array<float, 3>;
    Numbers eye{};
    std::array<Numbers, 3> index{}, world{};
    Numbers domainMin{}, domainMax{};    // index space
    Numbers visibleMin{}, visibleMax{};  // of them, what can be seen
    float step = 1;                      // world units
};

/// Sets up the rays of the packet at (x, y): u = 0 lies where they enter the domain. hits[lane] is what lies within it
/// from the first visible thing on; packet.hits of lanes that meet nothing visible are empty. False where all are.
bool setUpStraight(const StraightRays& rays, Index2 at, RayPacket& packet, std::span<CellHit, RayPacket::kMost> hits);

}  // namespace voledit
