#pragma once
// Which joints of a skeleton are its hips, arms, legs: by their names and by where they stand in the tree.

#include <vector>

#include "core/skeleton/joint_words.h"
#include "core/skeleton/skeleton.h"

namespace voledit {

/// Named by the joint at which the bone begins: the thigh's joint is at the hip.
enum class BodyPart : std::uint8_t {
    None,
    Hips,
    Spine,
    Neck,
    Head,
    HeadEnd,
    Collar,
    UpperArm,
    Forearm,
    Hand,
    HandEnd,
    Fingers,
    Thumb,
    Index,
    MiddleFinger,
    Ring,
    Little,
    Thigh,
    Shin,
    Foot,
    Toe,
    ToeEnd,
};

struct BodyRole {
    BodyPart part = BodyPart::None;
    BodySide side = BodySide::Middle;
    bool operator==(const BodyRole&) const = default;
    auto operator<=>(const BodyRole&) const = default;
};

/// The role of each joint. Words that mean two things are decided by the chain they stand in: "LeftShoulder" is the
/// collar where an upper arm is below it, else the upper arm itself (above "LeftElbow"); "LeftLeg" the shin below a
/// thigh, else the thigh; "LeftHip" the thigh where nothing else is. Without a joint named hips, it is the one from
/// which both thighs come. Helpers (twist, roll, IK) have no role.
std::vector<BodyRole> bodyRoles(const Skeleton& skeleton);

/// Joints of that role, parents first.
std::vector<int> jointsOf(const std::vector<BodyRole>& roles, const BodyRole& role);

}  // namespace voledit
