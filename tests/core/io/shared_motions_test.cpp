// The shared motions on a biped: which joints mean the same, where the fit puts them, and how they then stand.

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "core/io/bvh.h"
#include "tests/core/skeleton/body_fixtures.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

struct SharedMotion {
    friend void PrintTo(const SharedMotion& motion, std::ostream* out) { *out << motion.name; }

    const char* name;
    // Of the motion, for: Hips, Spine, Spine1, Spine2, Neck, Head, Head_End; then of the left side UpLeg, Leg, Foot,
    // ToeBase, ToeBase_End, Shoulder, Arm, ForeArm, Hand, Hand_End; "" for none. The right side is named alike.
    std::array<const char*, 17> joints;
    UpAxis up;
};

const SharedMotion kMotions[] = {
    {"av_8walk",
     {"Hips", "Spine", "", "", "", "Head", "Head_End", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase",
      "LeftToeBase_End", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand", "LeftHand_End"},
     {1, 1}},
    {"cmu_jumping_jacks",
     {"Hips", "lowerback", "Chest", "Chest2", "Neck", "Head", "Head_End", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe",
      "LeftToe_End", "LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist", "LFingers"},
     {1, 1}},
    {"fair_dab",
     {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End", "LeftUpLeg", "LeftLeg", "LeftFoot",
      "LeftToeBase", "LeftToeBase_End", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand", "LeftHandEnd"},
     {2, 1}},
    {"mocapbank_crlf",
     {"Hips", "Chest", "", "Chest2", "Neck", "Head", "Head_End", "LeftHip", "LeftKnee", "LeftAnkle", "LeftAnkle_End",
      "", "LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist", "LeftWrist_End"},
     {1, 1}},
    {"makehuman_zombie_walk",
     {"Hips", "Spine1", "Spine2", "Spine3", "Neck", "Head", "", "UpLeg_L", "LoLeg_L", "Foot_L", "Toe_L", "Toe_L_End",
      "Clavicle_L", "UpArm_L", "LoArm_L", "Hand_L", "Middle1_L"},
     {2, 1}},
    {"makehuman_tpose_allpos",
     {"root", "spine05", "spine03", "spine01", "neck01", "head", "", "upperleg01.L", "lowerleg01.L", "foot.L",
      "toe3-1.L", "toe3-3.L_End", "clavicle.L", "upperarm01.L", "lowerarm01.L", "wrist.L", "finger3-1.L"},
     {2, 1}},
    {"rokoko_jesse_dance",
     {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End", "LeftUpLeg", "LeftLeg", "LeftFoot",
      "LeftToeBase", "LeftToeBase_End", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand", "LeftInHandMiddle"},
     {1, 1}},
};

std::string onTheRight(std::string name) {
    for (const auto& [left, right] : {std::pair{"Left", "Right"}, {"_L", "_R"}, {".L", ".R"}, {"LF", "RF"}})
        if (const auto at = name.find(left); at != std::string::npos)
            return name.replace(at, std::string(left).size(), right);
    return name;
}

std::map<std::string, std::string> expectedPairs(const SharedMotion& shared) {
    const std::array<const char*, 7> middle{"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End"};
    const std::array<const char*, 10> side{"UpLeg",    "Leg", "Foot",    "ToeBase", "ToeBase_End",
                                           "Shoulder", "Arm", "ForeArm", "Hand",    "Hand_End"};
    std::map<std::string, std::string> pairs;
    for (std::size_t i = 0; i < 17; ++i) {
        const std::string from = shared.joints[i];
        if (from.empty()) continue;
        if (i < 7) {
            pairs[middle[i]] = from;
        } else {
            pairs[std::string("Left") + side[i - 7]] = from;
            pairs[std::string("Right") + side[i - 7]] = onTheRight(from);
        }
    }
    return pairs;
}

class SharedMotions : public testing::TestWithParam<SharedMotion> {};

TEST_P(SharedMotions, JointsOfTheBipedAreFound) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam().name + ".bvh");
    const Motion motion = readBvh(path);
    EXPECT_EQ(matchingJoints(standingBiped(), motion), expectedPairs(GetParam()));
    EXPECT_EQ(upOf(skeletonOf(motion)), GetParam().up);
}

TEST_P(SharedMotions, OfThemselvesTheyAreThemselves) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam().name + ".bvh");
    const Motion motion = readBvh(path);
    const Skeleton own = skeletonOf(motion);
    MotionMap map;
    map.joints = matchingJoints(own, motion);
    EXPECT_EQ(map.joints, sameNames(own));
    for (const double t : {0.0, 0.37 * motion.duration()}) {
        const auto expected = posedJoints(own, poseAt(motion, t)),
                   found = posedJoints(own, retargeted(own, motion, map, t));
        for (std::size_t j = 0; j < expected.size(); ++j)
            EXPECT_LT(glm::length(expected[j].position - found[j].position), 1e-6) << own.joints[j].name;
    }
}

TEST_P(SharedMotions, TheBipedStandsAsTheyDo) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam().name + ".bvh");
    const Motion motion = readBvh(path);
    const Skeleton biped = standingBiped(), own = skeletonOf(motion);
    MotionMap map;
    map.joints = matchingJoints(biped, motion);
    map.skeletonFromMotion = proposedMotionFit(biped, motion, map.joints);
    const Mat3 turn(map.skeletonFromMotion);
    const double scale = std::cbrt(glm::determinant(turn));
    for (const double t : {0.0, 0.5 * motion.duration(), motion.duration()}) {
        const auto ours = posedJoints(biped, retargeted(biped, motion, map, t));
        const auto theirs = posedJoints(own, poseAt(motion, t));
        const auto place = [&](const char* name) { return ours[std::size_t(biped.find(name))].position; };
        const auto theirPlace = [&](const char* name) {
            return theirs[std::size_t(own.find(map.joints.at(name)))].position;
        };
        // Joints that follow each other in all files.
        for (const std::string side : {"Left", "Right"})
            for (const auto& [from, to] : {std::pair{"UpLeg", "Leg"}, {"Arm", "ForeArm"}, {"ForeArm", "Hand"}}) {
                // MakeHuman's thighs, arms and forearms are two bones each: the first is what the joint carries.
                if (std::string(GetParam().name) == "makehuman_tpose_allpos") continue;
                const Vec3 wanted = turn * (theirPlace((side + to).c_str()) - theirPlace((side + from).c_str()));
                const Vec3 found = place((side + to).c_str()) - place((side + from).c_str());
                EXPECT_LT(glm::length(glm::normalize(wanted) - glm::normalize(found)), 1e-6)
                    << side << from << " at " << t;
            }
        // Wherever the body has gone: hips to head as in the motion, within a spine's bend.
        const Vec3 wanted = turn * (theirPlace("Head") - theirPlace("Hips")), found = place("Head") - place("Hips");
        EXPECT_GT(glm::dot(glm::normalize(wanted), glm::normalize(found)), 0.95) << "at " << t;
        EXPECT_NEAR(glm::length(place("LeftHand") - place("LeftForeArm")), 2, 1e-9);
    }
    const auto first = posedJoints(biped, retargeted(biped, motion, map, 0));
    double low = kInfinity;
    for (const auto& [joint, from] : map.joints) low = std::min(low, first[std::size_t(biped.find(joint))].position.y);
    double lowAtRest = kInfinity;
    for (const auto& [joint, from] : map.joints)
        lowAtRest = std::min(lowAtRest, biped.joints[std::size_t(biped.find(joint))].at.y);
    EXPECT_NEAR(low, lowAtRest, 1e-6) << "feet on the ground";
    EXPECT_NEAR(first[0].position.x, 0, 1e-6);
    EXPECT_NEAR(first[0].position.z, 0, 1e-6);
    EXPECT_GT(first[std::size_t(biped.find("Head"))].position.y, 13);
    EXPECT_GT(scale, 0);
}

TEST_P(SharedMotions, NoLimbIsTwisted) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam().name + ".bvh");
    const Motion motion = readBvh(path);
    const Skeleton biped = standingBiped();
    MotionMap map;
    map.joints = matchingJoints(biped, motion);
    map.skeletonFromMotion = proposedMotionFit(biped, motion, map.joints);
    // In all files the body stands in the first frame: joints of the trunk, legs and head are turned by little.
    const Pose pose = retargeted(biped, motion, map, 0);
    for (const char* name :
         {"Spine", "Spine1", "Spine2", "Neck", "Head", "LeftUpLeg", "RightUpLeg", "LeftLeg", "RightLeg", "LeftFoot",
          "RightFoot", "LeftToeBase", "RightToeBase", "LeftShoulder", "RightShoulder"}) {
        const Quat& q = pose.rotate[std::size_t(biped.find(name))];
        EXPECT_LT(2 * std::acos(std::min(1.0, std::abs(q.w))), 60 * kPi / 180) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(, SharedMotions, testing::ValuesIn(kMotions),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace voledit
