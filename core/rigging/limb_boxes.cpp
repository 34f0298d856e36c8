#include "core/rigging/limb_boxes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

/// Chains of limbs, each continuing the one before.
std::vector<std::vector<int>> chainsOf(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest) {
    const int n = static_cast<int>(limbs.size());
    std::vector<int> next;
    std::vector<bool> isFirst(limbs.size(), true);
    for (int l = 0; l < n; ++l) {
        next.push_back(continuationOf(limbs, rest, l, {}));
        if (next.back() >= 0) isFirst[std::size_t(next.back())] = false;
    }
    std::vector<std::vector<int>> chains;
    for (int l = 0; l < n; ++l) {
        if (!isFirst[std::size_t(l)]) continue;
        chains.emplace_back();
        for (int k = l; k >= 0; k = next[std::size_t(k)]) chains.back().push_back(k);
    }
    return chains;
}

/// Turns the first limb of the chain by `turn` from its plain frame; the others follow.
void rollChain(std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, const std::vector<int>& chain,
               double turn) {
    Mat3 frame(1.0);
    for (const int l : chain) {
        Limb& limb = limbs[std::size_t(l)];
        const Vec3 d = directionOf(limb, rest);
        limb.roll = l == chain.front() ? turn : rollTowards(d, glm::mat3_cast(shortestArc(frame[2], d)) * frame[0]);
        frame = boneFrame(d, limb.roll);
    }
}

double volumeOf(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, const std::vector<int>& chain,
                const std::vector<std::vector<Vec3>>& rims) {
    double sum = 0;
    for (const int l : chain) {
        const LimbExtents e = extentsOf(limbs[std::size_t(l)], rest, rims[std::size_t(l)]);
        if (e.empty()) continue;
        const Vec3 size = e.high - e.low;
        sum += size.x * size.y * lengthOf(limbs[std::size_t(l)], rest);
    }
    return sum;
}

}  // namespace

Vec3 directionOf(const Limb& limb, const std::vector<PosedJoint>& rest) {
    return glm::normalize(rest[std::size_t(limb.to)].position - rest[std::size_t(limb.from)].position);
}

double lengthOf(const Limb& limb, const std::vector<PosedJoint>& rest) {
    return glm::length(rest[std::size_t(limb.to)].position - rest[std::size_t(limb.from)].position);
}

double rollTowards(const Vec3& direction, const Vec3& x) {
    const Mat3 plain = boneFrame(direction, 0);
    return std::atan2(glm::dot(x, plain[1]), glm::dot(x, plain[0]));
}

std::vector<std::vector<Vec3>> rimsOf(const OpaqueVoxels& voxels, const std::vector<std::int16_t>& parts,
                                      std::size_t limbs) {
    std::vector<std::vector<Vec3>> rims(limbs);
    const auto steps = neighbourSteps(voxels);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] == kNoLimb) continue;
        const Index3 c = cellOf(voxels, i);
        const bool isRim = std::any_of(steps.begin(), steps.begin() + 6, [&](const NeighbourStep& s) {
            return !isInside(voxels, c + s.by) || parts[std::size_t(std::ptrdiff_t(i) + s.offset)] != parts[i];
        });
        if (isRim) rims[std::size_t(parts[i])].push_back(voxels.centre(c));
    }
    return rims;
}

std::vector<Limb> alignedRolls(std::vector<Limb> limbs, const std::vector<PosedJoint>& rest,
                               const std::vector<std::vector<Vec3>>& rims) {
    constexpr int kTurns = 45;  // 2° apart; a box turned by 90° is the same box
    for (const auto& chain : chainsOf(limbs, rest)) {
        rollChain(limbs, rest, chain, 0);
        if (rims.empty()) continue;
        // The plain frame is easier to read: another must save a twentieth.
        double best = 0, least = 0.95 * volumeOf(limbs, rest, chain, rims);
        for (int i = 1; i < kTurns; ++i) {
            const double turn = (i < kTurns / 2 ? i : i - kTurns) * kPi / 2 / kTurns;
            rollChain(limbs, rest, chain, turn);
            if (const double v = volumeOf(limbs, rest, chain, rims); v < least)
                std::tie(best, least) = std::pair(turn, v);
        }
        rollChain(limbs, rest, chain, best);
    }
    return limbs;
}

LimbExtents extentsOf(const Limb& limb, const std::vector<PosedJoint>& rest, const std::vector<Vec3>& rim) {
    const Mat3 boneFromWorld = glm::transpose(boneFrame(directionOf(limb, rest), limb.roll));
    const Vec3 start = rest[std::size_t(limb.from)].position;
    LimbExtents extents;
    for (const Vec3& p : rim) extents.add(boneFromWorld * (p - start));
    return extents;
}

Limb boxed(Limb limb, const std::vector<PosedJoint>& rest, const LimbExtents& extents, double margin) {
    limb.size = Vec2(extents.high - extents.low) + 2 * margin;
    limb.offset = 0.5 * Vec2(extents.high + extents.low);
    limb.pad = glm::max(Vec2(0), Vec2(-extents.low.z, extents.high.z - lengthOf(limb, rest)) + margin);
    return limb;
}

}  // namespace voledit
