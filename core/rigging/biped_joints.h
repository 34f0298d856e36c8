#pragma once
// Where a biped's joints are in a body. Of use to biped.cpp and its parts only.

#include <array>

#include "core/rigging/body_shape.h"
#include "core/rigging/tree_paths.h"

namespace voledit {

struct BipedJoints {
    std::array<Vec3, 7> trunk;               // Hips, Spine, Spine1, Spine2, Neck, Head, Head_End
    std::array<std::array<Vec3, 5>, 2> leg;  // left, right: UpLeg, Leg, Foot, ToeBase, ToeBase_End
    std::array<std::array<Vec3, 5>, 2> arm;  // Shoulder, Arm, ForeArm, Hand, Hand_End
};

/// Limbs' paths along the curve skeleton, from the tip inwards; empty where there is none. [0] left, [1] right.
struct BipedPaths {
    std::array<MedialPath, 2> leg;  // foot to the point in the pelvis where the legs meet
    std::array<MedialPath, 2> arm;  // hand to the trunk
};
BipedPaths bipedPaths(const BodyShape& body);

/// Joints by proportions of the height (those of an adult, after MakeHuman's base figure and Drillis, Contini 1966),
/// brought to the middle of the sections there.
BipedJoints bipedByProportions(const BodyShape& body);

/// Each moves joints to what the body shows, given where they are so far; the legs first, then the trunk (which the
/// legs carry), then the arms (which hang on it).
void placeLegs(const BodyShape& body, const BipedPaths& paths, BipedJoints& joints);
void placeTrunk(const BodyShape& body, BipedJoints& joints);
void placeArms(const BodyShape& body, const BipedPaths& paths, BipedJoints& joints);

/// Joints of both sides made each other's mirror images, if the body mirrors itself.
void makeSymmetric(const BodyShape& body, BipedJoints& joints);

}  // namespace voledit
