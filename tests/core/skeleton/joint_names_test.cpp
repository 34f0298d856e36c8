// matchingJoints and upOf (core/skeleton/motion.h).

#include <gtest/gtest.h>

#include "body_fixtures.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

using Pairs = std::map<std::string, std::string>;

/// A motion's hierarchy, without frames: { joint, parent }.
Motion hierarchy(const std::vector<std::pair<std::string, std::string>>& joints) {
    Motion motion;
    for (const auto& [name, parent] : joints) {
        int above = Joint::kNoParent;
        for (std::size_t j = 0; j < motion.joints.size(); ++j)
            if (motion.joints[j].name == parent) above = int(j);
        motion.joints.push_back({name, above, Vec3(double(motion.joints.size() % 3), 1, 0), {}, false});
    }
    return motion;
}

TEST(MatchingJoints, ASkeletonIsItself) {
    const Skeleton biped = standingBiped();
    EXPECT_EQ(matchingJoints(biped, motionOf(biped, {})), sameNames(biped));
    Random random(7);
    const Skeleton any = randomSkeleton(random, 30);
    EXPECT_EQ(matchingJoints(any, motionOf(any, {})), sameNames(any));
}

TEST(MatchingJoints, NothingInCommonIsNoPair) {
    EXPECT_TRUE(matchingJoints(standingBiped(), hierarchy({{"a", ""}, {"b", "a"}})).empty());
    EXPECT_TRUE(matchingJoints(standingBiped(), Motion()).empty());
    EXPECT_TRUE(matchingJoints(Skeleton(), hierarchy({{"Hips", ""}})).empty());
}

TEST(MatchingJoints, LegsOfDazAndMax) {
    const Pairs daz = matchingJoints(standingBiped(), hierarchy({{"hip", ""},
                                                                 {"pelvis", "hip"},
                                                                 {"lThigh", "pelvis"},
                                                                 {"lShin", "lThigh"},
                                                                 {"lFoot", "lShin"},
                                                                 {"lToe", "lFoot"},
                                                                 {"abdomen", "hip"},
                                                                 {"chest", "abdomen"},
                                                                 {"neck", "chest"},
                                                                 {"head", "neck"},
                                                                 {"lCollar", "chest"},
                                                                 {"lShldr", "lCollar"},
                                                                 {"lForeArm", "lShldr"},
                                                                 {"lHand", "lForeArm"}}));
    EXPECT_EQ(daz, (Pairs{{"Hips", "hip"},
                          {"LeftUpLeg", "lThigh"},
                          {"LeftLeg", "lShin"},
                          {"LeftFoot", "lFoot"},
                          {"LeftToeBase", "lToe"},
                          {"Spine", "abdomen"},
                          {"Spine2", "chest"},
                          {"Neck", "neck"},
                          {"Head", "head"},
                          {"LeftShoulder", "lCollar"},
                          {"LeftArm", "lShldr"},
                          {"LeftForeArm", "lForeArm"},
                          {"LeftHand", "lHand"}}));
    const Pairs max = matchingJoints(standingBiped(), hierarchy({{"Bip01", ""},
                                                                 {"Bip01 Pelvis", "Bip01"},
                                                                 {"Bip01 R Thigh", "Bip01 Pelvis"},
                                                                 {"Bip01 R Calf", "Bip01 R Thigh"},
                                                                 {"Bip01 R Foot", "Bip01 R Calf"},
                                                                 {"Bip01 R Clavicle", "Bip01 Pelvis"},
                                                                 {"Bip01 R UpperArm", "Bip01 R Clavicle"}}));
    EXPECT_EQ(max, (Pairs{{"Hips", "Bip01 Pelvis"},
                          {"RightUpLeg", "Bip01 R Thigh"},
                          {"RightLeg", "Bip01 R Calf"},
                          {"RightFoot", "Bip01 R Foot"},
                          {"RightShoulder", "Bip01 R Clavicle"},
                          {"RightArm", "Bip01 R UpperArm"}}));
}

TEST(MatchingJoints, NameSpacesDoNotMatter) {
    Motion motion = motionOf(standingBiped(), {});
    for (MotionJoint& joint : motion.joints) joint.name = "mixamorig:" + joint.name;
    for (const auto& [joint, from] : matchingJoints(standingBiped(), motion)) EXPECT_EQ(from, "mixamorig:" + joint);
    EXPECT_EQ(matchingJoints(standingBiped(), motion).size(), standingBiped().joints.size());
}

TEST(MatchingJoints, SpinesOfOtherLengths) {
    const auto spineOf = [](int count) {
        std::vector<std::pair<std::string, std::string>> joints{{"Hips", ""}};
        for (int i = 0; i < count; ++i)
            joints.push_back({"back.spine" + std::string(1, char('a' + i)), i ? joints.back().first : "Hips"});
        Pairs pairs = matchingJoints(standingBiped(), hierarchy(joints));
        pairs.erase("Hips");
        for (auto& pair : pairs) pair.second = pair.second.back();
        return pairs;
    };
    EXPECT_EQ(spineOf(1), (Pairs{{"Spine", "a"}}));
    EXPECT_EQ(spineOf(2), (Pairs{{"Spine", "a"}, {"Spine2", "b"}}));
    EXPECT_EQ(spineOf(3), (Pairs{{"Spine", "a"}, {"Spine1", "b"}, {"Spine2", "c"}}));
    EXPECT_EQ(spineOf(5), (Pairs{{"Spine", "a"}, {"Spine1", "c"}, {"Spine2", "e"}}));
}

TEST(MatchingJoints, ASpineWhoseNamesAreShiftedIsMatchedInOrder) {
    const Pairs pairs = matchingJoints(
        standingBiped(), hierarchy({{"Hips", ""}, {"Spine1", "Hips"}, {"Spine2", "Spine1"}, {"Spine3", "Spine2"}}));
    EXPECT_EQ(pairs, (Pairs{{"Hips", "Hips"}, {"Spine", "Spine1"}, {"Spine1", "Spine2"}, {"Spine2", "Spine3"}}));
}

TEST(MatchingJoints, FingersPointWhereAHandEnds) {
    const Pairs pairs = matchingJoints(standingBiped(), hierarchy({{"LeftHand", ""},
                                                                   {"LeftHandThumb1", "LeftHand"},
                                                                   {"LeftHandIndex1", "LeftHand"},
                                                                   {"LeftHandMiddle1", "LeftHand"},
                                                                   {"LeftHandMiddle2", "LeftHandMiddle1"}}));
    EXPECT_EQ(pairs, (Pairs{{"LeftHand", "LeftHand"}, {"LeftHand_End", "LeftHandMiddle1"}}));
}

TEST(MatchingJoints, NoMotionJointIsUsedTwice) {
    Random random(11);
    const char* const words[] = {"Hips",    "Spine",    "Neck",     "Head",    "LeftArm",   "RightArm", "LeftShoulder",
                                 "LeftLeg", "LeftHand", "LeftFoot", "LeftToe", "LeftElbow", "RightHip", "chain"};
    for (int n = 0; n < 300; ++n) {
        const auto named = [&](Skeleton skeleton) {
            for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
                skeleton.joints[j].name = std::string(words[random() % std::size(words)]) + "_" + std::to_string(j);
            return skeleton;
        };
        const Skeleton own = named(randomSkeleton(random, 20));
        const Motion motion = motionOf(named(randomSkeleton(random, 20)), {});
        std::map<std::string, int> uses;
        for (const auto& [joint, from] : matchingJoints(own, motion)) {
            EXPECT_GE(own.find(joint), 0);
            EXPECT_EQ(++uses[from], 1) << from;
        }
        for (const auto& [from, count] : uses) EXPECT_GE(skeletonOf(motion).find(from), 0);
    }
}

Skeleton turned(Skeleton skeleton, const Mat3& turn) {
    for (Joint& joint : skeleton.joints) joint.at = turn * joint.at;
    return skeleton;
}

TEST(UpOf, AlongWhichABodyStands) {
    const Skeleton biped = standingBiped();
    EXPECT_EQ(upOf(biped), (UpAxis{1, 1}));
    const Mat3 yToZ(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
    EXPECT_EQ(upOf(turned(biped, yToZ)), (UpAxis{2, 1}));
    EXPECT_EQ(upOf(turned(biped, -Mat3(1))), (UpAxis{1, -1}));
    // Arms that reach wider than the body is high do not count.
    EXPECT_EQ(upOf(standingBiped({1, 0, 0})), (UpAxis{1, 1}));
}

TEST(UpOf, WithoutABodyTheLongerOfYAndZ) {
    Skeleton chain;
    for (int j = 0; j < 4; ++j) chain.joints.push_back({"c" + std::to_string(j), j - 1, Vec3(j, 2 * j, 0.5 * j), {}});
    EXPECT_EQ(upOf(chain), (UpAxis{1, 1}));
    EXPECT_EQ(upOf(Skeleton()), (UpAxis{2, 1}));
}

}  // namespace
}  // namespace voledit
