#include "core/skeleton/body_parts.h"

#include <gtest/gtest.h>

#include "body_fixtures.h"

namespace voledit {
namespace {

using enum BodyPart;

/// Joints one below the other, from a root on; names that begin with "<" go back up so many.
Skeleton chains(const std::vector<std::vector<std::string>>& chains) {
    std::vector<Joint> joints;
    std::vector<std::string> parents;
    for (const auto& chain : chains)
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const auto known = [&](const Joint& joint) { return joint.name == chain[i]; };
            if (std::any_of(joints.begin(), joints.end(), known)) continue;
            joints.push_back({chain[i], Joint::kNoParent, Vec3(double(joints.size())), {}});
            parents.push_back(i ? chain[i - 1] : "");
        }
    return makeSkeleton(joints, parents);
}

BodyPart partOf(const Skeleton& skeleton, const std::string& name) {
    return bodyRoles(skeleton)[std::size_t(skeleton.find(name))].part;
}

TEST(BodyParts, TheTemplatesOwnNames) {
    const Skeleton s = standingBiped();
    const auto roles = bodyRoles(s);
    const std::map<std::string, BodyRole> expected{{"Hips", {Hips, BodySide::Middle}},
                                                   {"Spine2", {Spine, BodySide::Middle}},
                                                   {"Neck", {Neck, BodySide::Middle}},
                                                   {"Head_End", {HeadEnd, BodySide::Middle}},
                                                   {"LeftUpLeg", {Thigh, BodySide::Left}},
                                                   {"LeftLeg", {Shin, BodySide::Left}},
                                                   {"RightFoot", {Foot, BodySide::Right}},
                                                   {"RightToeBase", {Toe, BodySide::Right}},
                                                   {"LeftToeBase_End", {ToeEnd, BodySide::Left}},
                                                   {"LeftShoulder", {Collar, BodySide::Left}},
                                                   {"RightArm", {UpperArm, BodySide::Right}},
                                                   {"LeftForeArm", {Forearm, BodySide::Left}},
                                                   {"LeftHand", {Hand, BodySide::Left}},
                                                   {"RightHand_End", {HandEnd, BodySide::Right}}};
    for (const auto& [name, role] : expected) EXPECT_EQ(roles[std::size_t(s.find(name))], role) << name;
}

TEST(BodyParts, AShoulderIsACollarOnlyAboveAnUpperArm) {
    const Skeleton cmu = chains({{"Hips", "Chest", "LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"}});
    EXPECT_EQ(partOf(cmu, "LeftCollar"), Collar);
    EXPECT_EQ(partOf(cmu, "LeftShoulder"), UpperArm);
    EXPECT_EQ(partOf(cmu, "LeftElbow"), Forearm);
    const Skeleton makehuman = chains({{"root", "spine01", "clavicle.L", "shoulder01.L", "upperarm01.L", "wrist.L"}});
    EXPECT_EQ(partOf(makehuman, "shoulder01.L"), Collar);
    EXPECT_EQ(partOf(makehuman, "upperarm01.L"), UpperArm);
    const Skeleton two =
        chains({{"Hips", "LeftShoulder", "LeftArm", "LeftElbow"}, {"Hips", "RightShoulder", "RightElbow"}});
    EXPECT_EQ(partOf(two, "LeftShoulder"), Collar);
    EXPECT_EQ(partOf(two, "RightShoulder"), UpperArm);
}

TEST(BodyParts, ALegIsAShinOnlyBelowAThigh) {
    const Skeleton legs =
        chains({{"Hips", "LeftUpLeg", "LeftLeg", "LeftFoot"}, {"Hips", "RightLeg", "RightKnee", "RightAnkle"}});
    EXPECT_EQ(partOf(legs, "LeftLeg"), Shin);
    EXPECT_EQ(partOf(legs, "RightLeg"), Thigh);
    const Skeleton hips =
        chains({{"Hips", "LHipJoint", "LeftHip", "LeftKnee"}, {"Hips", "RightHip", "RightLeg", "RightFoot"}});
    EXPECT_EQ(partOf(hips, "LHipJoint"), None);
    EXPECT_EQ(partOf(hips, "LeftHip"), Thigh);
    EXPECT_EQ(partOf(hips, "RightHip"), Thigh);
    EXPECT_EQ(partOf(hips, "RightLeg"), Shin);
}

TEST(BodyParts, HipsByNameElseWhereTheLegsMeet) {
    EXPECT_EQ(partOf(chains({{"Root", "Hips", "LeftUpLeg"}}), "Hips"), Hips);
    EXPECT_EQ(partOf(chains({{"Root", "Hips", "LeftUpLeg"}}), "Root"), None);
    const Skeleton rigify =
        chains({{"spine", "spine.001", "neck"}, {"spine", "thigh.L", "shin.L"}, {"spine", "thigh.R"}});
    EXPECT_EQ(partOf(rigify, "spine"), Hips);
    EXPECT_EQ(partOf(rigify, "spine.001"), Spine);
    EXPECT_EQ(partOf(chains({{"root", "tail"}}), "root"), Hips);
}

TEST(BodyParts, HelpersHaveNoPart) {
    const Skeleton s = chains({{"Hips", "__UpLeg_L", "UpLeg_L", "UpLegTwist_L"}});
    EXPECT_EQ(partOf(s, "__UpLeg_L"), None);
    EXPECT_EQ(partOf(s, "UpLeg_L"), Thigh);
    EXPECT_EQ(partOf(s, "UpLegTwist_L"), None);
}

TEST(BodyParts, AnAnklesEndIsTheToes) {
    EXPECT_EQ(partOf(chains({{"Hips", "LeftKnee", "LeftAnkle", "LeftAnkle_End"}}), "LeftAnkle_End"), Toe);
    EXPECT_EQ(partOf(chains({{"Hips", "LeftAnkle", "LeftAnkle_End"}, {"LeftAnkle", "LeftToe"}}), "LeftAnkle_End"),
              None);
}

TEST(BodyParts, TenThousandArms) {
    std::vector<Joint> joints;
    std::vector<std::string> parents;
    for (std::size_t j = 0; j < kMostJoints; ++j) {
        joints.push_back({"LeftArm" + std::to_string(j), Joint::kNoParent, Vec3(double(j)), {}});
        parents.push_back(j ? joints[j - 1].name : "");
    }
    EXPECT_EQ(bodyRoles(makeSkeleton(joints, parents)).front().part, UpperArm);
}

}  // namespace
}  // namespace voledit
