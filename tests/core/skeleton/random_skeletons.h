#pragma once
// Random skeletons, poses and limbs for property tests.

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/skeleton/limb_regions.h"
#include "core/skeleton/skeleton.h"

namespace voledit {

using Random = std::mt19937_64;

inline double randomNumber(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vec3 randomVector(Random& random, double size) {
    const double x = randomNumber(random, -size, size), y = randomNumber(random, -size, size);
    return {x, y, randomNumber(random, -size, size)};
}

/// Uniform on the unit quaternions.
inline Quat randomRotation(Random& random) {
    std::normal_distribution<double> normal;
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(Quat(w, x, y, z));
}

/// A tree of joints about a unit apart, named "j0", "j1" ….
inline Skeleton randomSkeleton(Random& random, int joints) {
    Skeleton skeleton;
    for (int j = 0; j < joints; ++j) {
        const int parent = j == 0 ? Joint::kNoParent : std::uniform_int_distribution<int>(0, j - 1)(random);
        const Vec3 from = j == 0 ? randomVector(random, 3) : skeleton.joints[std::size_t(parent)].at;
        const Vec3 bone = randomRotation(random) * Vec3(0, 0, randomNumber(random, 0.5, 2));
        skeleton.joints.push_back({"j" + std::to_string(j), parent, from + bone, {}});
    }
    return skeleton;
}

inline Pose randomPose(Random& random, const Skeleton& skeleton, double travel = 0) {
    Pose pose = restPose(skeleton);
    for (Quat& rotation : pose.rotate) rotation = randomRotation(random);
    for (Vec3& translation : pose.translate) translation = randomVector(random, travel);
    return pose;
}

/// One limb for each joint that has a parent.
inline std::vector<Limb> randomLimbs(Random& random, const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        if (skeleton.joints[j].parent == Joint::kNoParent) continue;
        Limb limb;
        limb.name = "to " + skeleton.joints[j].name;
        limb.from = skeleton.joints[j].parent;
        limb.to = int(j);
        limb.size = {randomNumber(random, 0.2, 0.6), randomNumber(random, 0.2, 0.6)};
        limb.offset = {randomNumber(random, -0.1, 0.1), randomNumber(random, -0.1, 0.1)};
        limb.roll = randomNumber(random, -4, 4);
        limb.pad = {randomNumber(random, 0, 0.2), randomNumber(random, 0, 0.2)};
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace voledit
