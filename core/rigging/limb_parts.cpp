#include "core/rigging/limb_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

/// A bone with how deep it lies in the object along its length.
struct Bone {
    static constexpr int kPieces = 8;
    Vec3 from, along;
    double length2;
    std::array<double, kPieces + 1> depth;

    /// Distance of p over the depth of the bone where it is nearest. Beyond the ends a bone reaches less far than
    /// across: there its neighbours in the chain are.
    double relativeDistance(const Vec3& p) const {
        constexpr double kBeyondEnds = 2.5;
        const double whole = glm::dot(p - from, along) / length2;
        const double t = std::clamp(whole, 0.0, 1.0);
        const double s = t * kPieces;
        const int i = std::min(kPieces - 1, static_cast<int>(s));
        const double d = depth[std::size_t(i)] + (s - i) * (depth[std::size_t(i) + 1] - depth[std::size_t(i)]);
        return (glm::length(p - from - whole * along) + kBeyondEnds * std::abs(whole - t) * std::sqrt(length2)) / d;
    }
};

Bone boneOf(const OpaqueVoxels& voxels, const std::vector<float>& distance, const Limb& limb,
            const std::vector<PosedJoint>& rest) {
    Bone bone;
    bone.from = rest[std::size_t(limb.from)].position;
    bone.along = rest[std::size_t(limb.to)].position - bone.from;
    bone.length2 = std::max(glm::dot(bone.along, bone.along), 1e-300);
    // A bone that grazes the surface, or leaves the object, still has a say.
    const double least = 1.5 * std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z});
    for (int i = 0; i <= Bone::kPieces; ++i) {
        const Vec3 p = bone.from + (double(i) / Bone::kPieces) * bone.along;
        bone.depth[std::size_t(i)] = std::max(least, distanceAt(voxels, distance, p));
    }
    return bone;
}

/// For each opaque voxel the index of the one where its climb ends.
std::vector<std::uint32_t> middles(const OpaqueVoxels& voxels, const std::vector<float>& distance) {
    // Off the middle the distance rises by nearly as much as one steps; on it, by less than half.
    constexpr double kSteep = 0.5;
    std::vector<std::uint32_t> next(distance.size());
    const auto steps = neighbourSteps(voxels);
    parallelFor(std::size_t(voxels.size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (Index3 c(0, 0, int(begin)); c.z < int(end); ++c.z)
            for (c.y = 0; c.y < voxels.size.y; ++c.y)
                for (c.x = 0; c.x < voxels.size.x; ++c.x) {
                    const std::size_t i = voxels.indexOf(c);
                    next[i] = static_cast<std::uint32_t>(i);
                    if (!voxels.opaque[i]) continue;
                    double steepest = kSteep;
                    for (const NeighbourStep& s : steps) {
                        if (!isInside(voxels, c + s.by)) continue;
                        const std::size_t j = std::size_t(std::ptrdiff_t(i) + s.offset);
                        const double slope = (double(distance[j]) - distance[i]) / s.length;
                        if (slope > steepest) {
                            steepest = slope;
                            next[i] = static_cast<std::uint32_t>(j);
                        }
                    }
                }
    });
    std::vector<std::uint32_t> path;
    for (std::uint32_t i = 0; i < next.size(); ++i) {
        std::uint32_t at = i;
        path.clear();
        while (next[at] != at) {
            path.push_back(at);
            at = next[at];
        }
        for (const std::uint32_t p : path) next[p] = at;
    }
    return next;
}

}  // namespace

std::vector<std::int16_t> limbParts(const OpaqueVoxels& voxels, const std::vector<float>& distance,
                                    const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest) {
    std::vector<Bone> bones;
    for (const Limb& limb : limbs) bones.push_back(boneOf(voxels, distance, limb, rest));
    const auto middle = middles(voxels, distance);
    std::vector<std::int16_t> parts(voxels.opaque.size(), kNoLimb);
    const std::size_t slice = std::size_t(voxels.size.x) * std::size_t(voxels.size.y);
    parallelFor(std::size_t(voxels.size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * slice; i < end * slice; ++i) {
            if (!voxels.opaque[i]) continue;
            const Vec3 p = voxels.centre(cellOf(voxels, middle[i]));
            double best = kInfinity;
            for (std::size_t l = 0; l < bones.size(); ++l)
                if (const double d = bones[l].relativeDistance(p); d < best) {
                    best = d;
                    parts[i] = static_cast<std::int16_t>(l);
                }
        }
    });
    return parts;
}

}  // namespace voledit
