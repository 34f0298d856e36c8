// Edits of joints and poses.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/base/error.h"
#include "core/scene/actor_edits.h"
#include "tests/core/scene/compiled_json.h"

namespace voledit::test {
namespace {

const NodePath kPath = "/root";
const std::string kArms = R"("joints": [{"name": "chest", "parent": null, "at": [4, 2, 0]},
    {"name": "LeftArm", "parent": "chest", "at": [6, 2, 0]}, {"name": "LeftHand", "parent": "LeftArm", "at": [8, 2, 0]},
    {"name": "RightArm", "parent": "chest", "at": [2, 2, 0]}, {"name": "RightHand", "parent": "RightArm", "at": [0, 2, 0]}],
    "limbs": [{"name": "l", "from": "LeftArm", "to": "LeftHand", "size": [4, 4]},
              {"name": "r", "from": "RightArm", "to": "RightHand", "size": [4, 4]}])";

Scene arms() {
    return sceneOf(R"({"type": "actor", "of": )" + kBox + R"(, "skeleton": {)" + kArms + "}}");
}
Scene ofMotion() {
    return sceneOf(R"({"type": "actor", "of": )" + kBox + R"(, "skeleton": {"motion": "m"}})",
                   R"("assets": {"m": {"kind": "motion", "path": "m.bvh"}}, )");
}
const SceneJoint& joint(const Scene& scene, const std::string& name) {
    for (const SceneJoint& one : findActorAt(scene, kPath)->rig.skeleton.joints)
        if (one.name == name) return one;
    throw std::runtime_error("no joint " + name);
}
Quat degrees(double x, double y, double z) {
    return quatOfDegrees({x, y, z});
}

TEST(PoseEdits, AJointTurnsForGoodOrAtAKey) {
    Scene scene = arms();
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 30), {});
    EXPECT_NEAR(joint(scene, "LeftArm").rotate->degrees.z, 30, 1e-12);
    EXPECT_FALSE(joint(scene, "LeftArm").rotate.animated());
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 40), {1.0, false});
    EXPECT_FALSE(joint(scene, "LeftArm").rotate.animated()) << "a value without keys gets none";
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 50), {1.0, true});
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 70), {2.0, false});
    EXPECT_NEAR(joint(scene, "LeftArm").rotate.at(1.5).degrees.z, 60, 1e-9);
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 5), {});
    EXPECT_FALSE(joint(scene, "LeftArm").rotate.animated()) << "at all times";
    setJointTranslation(scene, kPath, "LeftHand", {0, 0, 1}, {0.0, true});
    EXPECT_TRUE(joint(scene, "LeftHand").translate.animated());
    EXPECT_THROW(setJointRotation(scene, kPath, "LeftArn", degrees(0, 0, 0), {}), Error);
}

TEST(PoseEdits, AMotionsSkeletonListsOnlyJointsWithSomethingOfTheirOwn) {
    Scene scene = ofMotion();
    const Scene before = scene;
    setJointRotation(scene, kPath, "Hips", degrees(10, 0, 0), {});
    EXPECT_EQ(findActorAt(scene, kPath)->rig.skeleton.joints.size(), 1u);
    setJointLimits(scene, kPath, "Neck", JointLimits{Vec3(-1), Vec3(1)});
    EXPECT_EQ(findActorAt(scene, kPath)->rig.skeleton.joints.size(), 2u);
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
    setJointRotation(scene, kPath, "Hips", degrees(0, 0, 0), {});
    setJointLimits(scene, kPath, "Neck", std::nullopt);
    EXPECT_EQ(scene, before);
    EXPECT_THROW(setJointAt(scene, kPath, "Hips", {0, 0, 0}), Error);
}

TEST(PoseEdits, JointsMoveAndAreLimited) {
    Scene scene = arms();
    setJointAt(scene, kPath, "LeftArm", {5, 2, 0});
    EXPECT_EQ(*joint(scene, "LeftArm").at, Vec3(5, 2, 0));
    EXPECT_EQ(*joint(scene, "LeftHand").at, Vec3(8, 2, 0)) << "children stay";
    setJointLimits(scene, kPath, "LeftArm", JointLimits{Vec3(-10), Vec3(10)});
    EXPECT_EQ(joint(scene, "LeftArm").limits->max, Vec3(10));
    EXPECT_THROW(setJointLimits(scene, kPath, "LeftArm", JointLimits{Vec3(10), Vec3(-10)}), Error);
}

TEST(PoseEdits, APoseIsTakenAndPutBack) {
    Scene scene = arms();
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 20, 0), {});
    const NamedPose pose = poseOf(scene, kPath, 0);
    ASSERT_EQ(pose.size(), 1u);
    EXPECT_NEAR(pose.at("LeftArm").y, 20, 1e-12);
    setJointRotation(scene, kPath, "LeftArm", degrees(0, 0, 0), {});
    setJointRotation(scene, kPath, "chest", degrees(5, 0, 0), {});
    applyPose(scene, kPath, pose, {});
    EXPECT_EQ(poseOf(scene, kPath, 0), pose) << "the chest is straight again";
    EXPECT_THROW(applyPose(scene, kPath, {{"Tail", Vec3(0)}}, {}), Error);
}

TEST(PoseEdits, PosesAtSeveralTimesDoNotRunIntoEachOther) {
    Scene scene = arms();
    applyPose(scene, kPath, {{"LeftArm", {0, 20, 0}}}, {0.0, true});
    applyPose(scene, kPath, {{"RightArm", {0, 40, 0}}}, {1.0, true});
    EXPECT_EQ(poseOf(scene, kPath, 0), (NamedPose{{"LeftArm", {0, 20, 0}}}));
    EXPECT_EQ(poseOf(scene, kPath, 1), (NamedPose{{"RightArm", {0, 40, 0}}}));
    const NamedPose between = poseOf(scene, kPath, 0.5);
    EXPECT_NEAR(between.at("LeftArm").y, 10, 1e-9);
    EXPECT_NEAR(between.at("RightArm").y, 20, 1e-9);
}

TEST(PoseEdits, AMirroredPoseIsTheOtherSides) {
    const Scene scene = arms();
    const CompiledScene compiled = compile(scene, {}, 0, nullptr);
    const CompiledActor& actor = *compiled.actors.at(0);
    const NamedPose pose{{"LeftArm", {10, 20, 30}}};
    const NamedPose mirrored = mirroredPose(actor, pose);
    ASSERT_EQ(mirrored.size(), 1u);
    // Across x: turns about x stay, those about y and z go the other way.
    const Quat left = degrees(10, 20, 30), right = quatOfDegrees(mirrored.at("RightArm"));
    EXPECT_LT(glm::length(right - Quat(left.w, left.x, -left.y, -left.z)), 1e-12);
    const NamedPose twice = mirroredPose(actor, mirrored);
    EXPECT_LT(glm::length(twice.at("LeftArm") - pose.at("LeftArm")), 1e-9);
}

TEST(PoseEdits, AMirrorStandsBetweenTheSidesWhereverTheyAre) {
    const Scene scene = sceneOf(R"({"type": "actor", "of": )" + kBox + R"(, "skeleton": {"joints": [
        {"name": "chest", "parent": null, "at": [4, 2, 0]}, {"name": "LeftArm", "parent": "chest", "at": [4, 4, 0]},
        {"name": "RightArm", "parent": "chest", "at": [4, 0, 0]}],
        "limbs": [{"name": "l", "from": "chest", "to": "LeftArm", "size": [4, 4]}]}})");
    const CompiledScene compiled = compile(scene, {}, 0, nullptr);
    const NamedPose mirrored = mirroredPose(*compiled.actors.at(0), {{"LeftArm", {0, 25, 0}}});
    EXPECT_NEAR(mirrored.at("RightArm").y, 25, 1e-9) << "sides lie along y";
}

TEST(PoseEdits, TheLibraryKeepsPosesByName) {
    Scene scene = arms();
    const Scene before = scene;
    savePose(scene, kPath, "wave", {{"LeftArm", {0, 20, 0}}});
    EXPECT_EQ(findActorAt(scene, kPath)->rig.poses.at("wave").at("LeftArm"), Vec3(0, 20, 0));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
    removePose(scene, kPath, "wave");
    EXPECT_EQ(scene, before);
    EXPECT_THROW(removePose(scene, kPath, "wave"), Error);
    EXPECT_THROW(savePose(scene, kPath, "", {}), Error);
}

}  // namespace
}  // namespace voledit::test
