#pragma once
// Inverse kinematics: poses that bring a joint to a place.

#include <optional>

#include "core/skeleton/skeleton.h"

namespace voledit {

struct IkGoal {
    int joint = 0;             // that is to be brought…
    Vec3 target{0};            // … here, skeleton space
    int chain = 2;             // how many bones above it may turn: 2 is an arm or a leg, solved in closed form
    std::optional<Vec3> pole;  // skeleton space: the middle joint bends towards it; else as it bends now
};

/// The pose with the chain's joints turned so that `goal.joint` comes as near to the target as bones and joint limits
/// allow; all others keep their local rotations. Two bones without limits: the law of cosines, exact to rounding; else
/// cyclic coordinate descent, angle by angle where there are limits, at most 200 rounds, and then damped least squares
/// [Wang, Chen 1991], to 1e-6 of the chain's length where reachable. A target out of reach: the chain stretches towards
/// it. Chains shorter than asked for (at the root) are solved as they are; a joint without a parent stays. Throws Error
/// if the joint does not exist or the target is not finite.
Pose solved(const Skeleton& skeleton, const Pose& pose, const IkGoal& goal);

/// The nearest rotation within the limits (each of the three angles clamped).
Quat limited(const Quat& rotation, const JointLimits& limits);

}  // namespace voledit
