#include "core/skeleton/joint_limits.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/skeleton/ik.h"

namespace voledit {
namespace {

Vec3 clampedAngles(const Vec3& degrees, const JointLimits& limits) {
    return {clampedAngle(degrees.x, limits.min.x, limits.max.x), clampedAngle(degrees.y, limits.min.y, limits.max.y),
            clampedAngle(degrees.z, limits.min.z, limits.max.z)};
}

bool sameAngles(const Vec3& a, const Vec3& b) {
    return std::remainder(a.x - b.x, 360) == 0 && std::remainder(a.y - b.y, 360) == 0 &&
           std::remainder(a.z - b.z, 360) == 0;
}

/// Both sets of angles that a rotation has, clamped.
struct Choices {
    Vec3 degrees, other;
    Vec3 near, far;
    Choices(const Quat& rotation, const JointLimits& limits)
        : degrees(degreesOf(rotation)),
          other(degrees.x + 180, 180 - degrees.y, degrees.z + 180),
          near(clampedAngles(degrees, limits)),
          far(clampedAngles(other, limits)) {}
    bool nearIsWithin() const { return sameAngles(near, degrees); }
    bool farIsWithin() const { return sameAngles(far, other); }
};

}  // namespace

double clampedAngle(double angle, double min, double max) {
    if (max - min >= 360) return angle;
    const double above = angle + 360 * std::ceil((min - angle) / 360);  // the first that is not below min
    if (above <= max) return above;
    return above - max < min - (above - 360) ? max : min;
}

Vec3 degreesWithin(const Quat& rotation, const JointLimits& limits) {
    const Choices choices(rotation, limits);
    if (choices.nearIsWithin()) return choices.near;
    if (choices.farIsWithin()) return choices.far;
    const double near = std::abs(glm::dot(quatOfDegrees(choices.near), rotation));
    return near >= std::abs(glm::dot(quatOfDegrees(choices.far), rotation)) ? choices.near : choices.far;
}

Quat limited(const Quat& rotation, const JointLimits& limits) {
    const Choices choices(rotation, limits);
    if (choices.nearIsWithin() || choices.farIsWithin()) return rotation;
    return quatOfDegrees(degreesWithin(rotation, limits));
}

}  // namespace voledit
