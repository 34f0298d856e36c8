#pragma once
// Solids whose skeletons are known: capsules united into bodies, as opaque voxels.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/rigging/opaque_voxels.h"

namespace voledit::test {

/// All points nearer to a segment than a radius that goes linearly from `a`'s to `b`'s.
struct TaperedCapsule {
    Vec3 a{0}, b{0};
    double ra = 1, rb = 1;

    bool holds(const Vec3& p) const {
        const Vec3 d = b - a;
        const double l2 = glm::dot(d, d);
        const double t = l2 > 0 ? std::clamp(glm::dot(p - a, d) / l2, 0.0, 1.0) : 0;
        return glm::length(p - a - t * d) <= ra + t * (rb - ra);
    }
};

/// The union of capsules on a grid of cubes of edge `step` that leaves two cells free on every side.
inline OpaqueVoxels voxelsOf(const std::vector<TaperedCapsule>& capsules, double step) {
    Box3 box;
    for (const TaperedCapsule& c : capsules)
        for (const auto& [p, r] : {std::pair(c.a, c.ra), std::pair(c.b, c.rb)}) box = join(box, Box3{p - r, p + r});
    OpaqueVoxels voxels;
    voxels.spacing = Vec3(step);
    voxels.size = Index3(glm::ceil(box.size() / step)) + 5;
    voxels.origin = box.center() - 0.5 * step * Vec3(voxels.size - 1);
    for (Index3 c(0); c.z < voxels.size.z; ++c.z)
        for (c.y = 0; c.y < voxels.size.y; ++c.y)
            for (c.x = 0; c.x < voxels.size.x; ++c.x)
                voxels.opaque.push_back(std::any_of(capsules.begin(), capsules.end(), [&](const TaperedCapsule& k) {
                    return k.holds(voxels.centre(c));
                }));
    return voxels;
}

/// A grid of random cells, `share` of them opaque.
inline OpaqueVoxels randomVoxels(const Index3& size, const Vec3& spacing, double share, unsigned seed) {
    OpaqueVoxels voxels{size, Vec3(1, -2, 3), spacing, {}};
    std::mt19937 random(seed);
    std::bernoulli_distribution isOpaque(share);
    for (int i = 0; i < size.x * size.y * size.z; ++i) voxels.opaque.push_back(isOpaque(random));
    return voxels;
}

/// A person of capsules, 17 high, y up, facing +z, its left at +x; arms as far from the body as `armAngle` (radians
/// from hanging down), legs apart. Joints are where the capsules meet.
struct Person {
    Vec3 hip{1, 9, 0}, knee{1.4, 4.9, 0.2}, ankle{1.7, 0.8, 0}, toe{1.8, 0.5, 1.8};
    Vec3 shoulder{1.7, 13.6, 0}, elbow{0}, wrist{0}, finger{0};
    std::vector<TaperedCapsule> capsules;

    explicit Person(double armAngle = 0.75) {
        const Vec3 along(std::sin(armAngle), -std::cos(armAngle), 0);
        elbow = shoulder + 2.4 * along;
        // The elbow bends forward a little.
        const Vec3 fore = glm::normalize(along + Vec3(0, 0, 0.35));
        wrist = elbow + 2.2 * fore;
        finger = wrist + 1.7 * fore;
        capsules = {{{0, 9.3, 0}, {0, 13.2, 0}, 1.15, 1.25},        // trunk
                    {{0, 13.5, 0}, {0, 15, 0.1}, 0.55, 0.5},        // neck
                    {{0, 15.7, 0.2}, {0, 16.1, 0.2}, 0.85, 0.85}};  // head
        for (const double side : {1.0, -1.0}) {
            const auto m = [&](Vec3 p) { return p.x *= side, p; };
            capsules.push_back({m({0.5, 9.1, 0}), m({0.8, 9.1, 0}), 0.95, 0.95});
            capsules.push_back({m(hip), m(knee), 0.85, 0.55});
            capsules.push_back({m(knee), m(ankle), 0.55, 0.35});
            capsules.push_back({m(ankle - Vec3(0, 0.3, 0.25)), m(toe), 0.48, 0.38});
            capsules.push_back({m({0.4, 13.5, 0}), m(shoulder), 0.75, 0.5});
            capsules.push_back({m(shoulder), m(elbow), 0.48, 0.38});
            capsules.push_back({m(elbow), m(wrist), 0.38, 0.25});
            capsules.push_back({m(wrist), m(wrist + 0.8 * (finger - wrist)), 0.3, 0.34});
        }
    }
};

}  // namespace voledit::test
