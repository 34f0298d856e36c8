#pragma once
// Angles within joint limits. Of use to inverse kinematics only.

#include "core/skeleton/skeleton.h"

namespace voledit {

/// The angle within [min, max] that is nearest to `angle`, degrees; angles are the same every 360.
double clampedAngle(double angle, double min, double max);

/// Degrees about x, y, z of the nearest rotation within the limits; y beyond ±90° where that is nearer.
Vec3 degreesWithin(const Quat& rotation, const JointLimits& limits);

}  // namespace voledit
