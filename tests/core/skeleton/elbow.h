#pragma once
// Two limbs in a chain, for tests of what happens between them.

#include <glm/gtc/quaternion.hpp>

#include "core/skeleton/limb_regions.h"
#include "random_skeletons.h"

namespace voledit {

inline Limb limbBetween(int from, int to, const Vec2& size = Vec2(1)) {
    Limb limb;
    limb.name = "limb " + std::to_string(from);
    limb.from = from;
    limb.to = to;
    limb.size = size;
    return limb;
}

/// A chain of two bones along z, three units each.
struct Elbow {
    Skeleton skeleton{{{"a", Joint::kNoParent, Vec3(0.3, 0.2, 0.1), {}},
                       {"b", 0, Vec3(0.3, 0.2, 3.1), {}},
                       {"c", 1, Vec3(0.3, 0.2, 6.1), {}}}};
    std::vector<Limb> limbs{limbBetween(0, 1), limbBetween(1, 2)};
    RegionOptions options = {.cells = {4, 4, 10}, .disjoint = {}};

    std::vector<PosedJoint> rest() const { return posedJoints(skeleton, restPose(skeleton)); }
    LimbRegions bent(const Quat& elbow) const {
        Pose pose = restPose(skeleton);
        pose.rotate[1] = elbow;
        return limbRegions(limbs, rest(), posedJoints(skeleton, pose), options);
    }
    LimbRegions bent(const Vec3& degrees) const { return bent(quatOfDegrees(degrees)); }
};

/// Volume of all cells by their tetrahedra, deformed or at rest.
inline double volumeOf(const LimbRegions& regions, const std::vector<Vec3>& positions) {
    double sum = 0;
    for (const auto& h : regions.cells.hexahedra)
        for (const auto& t : kHexahedronTetrahedra) {
            const auto at = [&](std::size_t n) { return positions[h[std::size_t(t[n])]]; };
            sum += glm::dot(at(1) - at(0), glm::cross(at(2) - at(0), at(3) - at(0))) / 6;
        }
    return sum;
}
inline double volumeOf(const LimbRegions& regions) {
    return volumeOf(regions, regions.cells.deformed);
}

/// Vertex (i, j, k) of a limb's grid.
inline std::uint32_t gridVertex(const LimbRegions& regions, std::size_t limb, Index3 cells, Index3 at) {
    const Index3 cell(std::min(at.x, cells.x - 1), std::min(at.y, cells.y - 1), std::min(at.z, cells.z - 1));
    const Index3 corner = at - cell;
    const std::size_t index = std::size_t(cell.x + cells.x * (cell.y + cells.y * cell.z));
    return regions.cells
        .hexahedra[regions.firstCell[limb] + index][std::size_t(corner.x + 2 * corner.y + 4 * corner.z)];
}

inline double largest(const Mat3& m) {
    return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
}

}  // namespace voledit
