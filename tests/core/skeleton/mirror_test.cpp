#include <gtest/gtest.h>

#include "random_skeletons.h"

namespace voledit {
namespace {

Skeleton withNames(const std::vector<std::string>& names) {
    Skeleton skeleton;
    for (const std::string& name : names) skeleton.joints.push_back({name, Joint::kNoParent, Vec3(0), {}});
    return skeleton;
}

std::string partnerOf(const Skeleton& skeleton, const std::string& name) {
    return skeleton.joints[std::size_t(mirrorPartner(skeleton, skeleton.find(name)))].name;
}

TEST(Mirror, PartnersByName) {
    const std::vector<std::pair<std::string, std::string>> pairs{{"LeftArm", "RightArm"},
                                                                 {"leftleg", "rightleg"},
                                                                 {"LEFT_HAND", "RIGHT_HAND"},
                                                                 {"mixamorig:LeftFoot", "mixamorig:RightFoot"},
                                                                 {"lThigh", "rThigh"},
                                                                 {"LHipJoint", "RHipJoint"},
                                                                 {"upperleg01.L", "upperleg01.R"},
                                                                 {"UpLeg_L", "UpLeg_R"},
                                                                 {"l_shoulder", "r_shoulder"},
                                                                 {"hand-l", "hand-r"},
                                                                 {"FingerL1", "FingerR1"},
                                                                 {"HandL", "HandR"},
                                                                 {"toe.l.001", "toe.r.001"},
                                                                 {"Bip01 L Calf", "Bip01 R Calf"},
                                                                 {"LeftFinger.L", "RightFinger.L"}};
    std::vector<std::string> names{"Hips", "Chest", "Collar", "Tail", "Skull"};
    for (const auto& [left, right] : pairs) {
        names.push_back(left);
        names.push_back(right);
    }
    const Skeleton skeleton = withNames(names);
    for (const auto& [left, right] : pairs) {
        EXPECT_EQ(partnerOf(skeleton, left), right);
        EXPECT_EQ(partnerOf(skeleton, right), left);
    }
    for (const std::string middle : {"Hips", "Chest", "Collar", "Tail", "Skull"})
        EXPECT_EQ(partnerOf(skeleton, middle), middle);
}

TEST(Mirror, WithoutTheOtherSideAJointIsItsOwnPartner) {
    const Skeleton skeleton = withNames({"LeftArm", "upright", "rib", "Lip", "R"});
    for (const Joint& joint : skeleton.joints) EXPECT_EQ(partnerOf(skeleton, joint.name), joint.name);
}

TEST(Mirror, PartnersAreEachOthers) {
    // Both "a.l" and "A.L" are mirrored by name to "a.r", which has one partner only.
    const Skeleton skeleton = withNames({"a.l", "a.r", "A.L", "left.l", "right.l", "left.r", "LeftLeft", "RightLeft"});
    for (int j = 0; j < int(skeleton.joints.size()); ++j)
        EXPECT_EQ(mirrorPartner(skeleton, mirrorPartner(skeleton, j)), j);
    EXPECT_EQ(partnerOf(skeleton, "a.r"), "a.l");
    EXPECT_EQ(partnerOf(skeleton, "A.L"), "A.L");
}

/// A random tree about a random middle: joints in pairs, mirrored across `axis`, and some on the plane itself.
Skeleton symmetricSkeleton(Random& random, int axis, double middle) {
    Skeleton skeleton;
    const auto onPlane = [&] {
        Vec3 at = randomVector(random, 2);
        at[axis] = middle;
        return at;
    };
    skeleton.joints.push_back({"root", Joint::kNoParent, onPlane(), {}});
    skeleton.joints.push_back({"spine", 0, onPlane(), {}});
    for (int n = 0; n < 6; ++n) {
        const std::string name = "joint" + std::to_string(n);
        const int before = int(skeleton.joints.size());
        const int parent = n == 0 || n == 3 ? 1 : before - 2;
        Vec3 at = randomVector(random, 2);
        at[axis] += middle;
        skeleton.joints.push_back({name + ".l", parent, at, {}});
        at[axis] = 2 * middle - at[axis];
        skeleton.joints.push_back({name + ".r", parent == 1 ? 1 : parent + 1, at, {}});
    }
    return skeleton;
}

TEST(Mirror, JointsAreWhereTheMirrorShowsThem) {
    Random random(1);
    for (int n = 0; n < 60; ++n) {
        const int axis = n % 3;
        const double middle = randomNumber(random, -3, 3);
        const Skeleton skeleton = symmetricSkeleton(random, axis, middle);
        const Pose pose = randomPose(random, skeleton, 1);
        const auto before = posedJoints(skeleton, pose), after = posedJoints(skeleton, mirrored(skeleton, pose, axis));
        for (int j = 0; j < int(skeleton.joints.size()); ++j) {
            const auto& seen = before[std::size_t(mirrorPartner(skeleton, j))];
            Vec3 expected = seen.position;
            expected[axis] = 2 * middle - expected[axis];
            EXPECT_LT(glm::length(after[std::size_t(j)].position - expected), 1e-13);
            Mat3 reflection(1.0);
            reflection[axis][axis] = -1;
            const Mat3 turned = reflection * seen.linear * reflection;
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(after[std::size_t(j)].linear[c] - turned[c]), 1e-14);
        }
    }
}

TEST(Mirror, TwiceIsTheIdentity) {
    Random random(2);
    for (int n = 0; n < 30; ++n) {
        const Skeleton skeleton = symmetricSkeleton(random, n % 3, 1);
        const Pose pose = randomPose(random, skeleton, 1);
        EXPECT_EQ(mirrored(skeleton, mirrored(skeleton, pose, n % 3), n % 3), pose);
        EXPECT_NE(mirrored(skeleton, pose, n % 3), pose);
    }
}

}  // namespace
}  // namespace voledit
