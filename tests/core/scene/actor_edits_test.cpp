#include "core/scene/actor_edits.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/scene/actor_pose.h"
#include "core/scene/node_edits.h"
#include "core/scene/scene_walk.h"
#include "tests/core/scene/compiled_json.h"

namespace voledit::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kPath = "/root";

Rig smallRig() {
    Rig rig;
    rig.skeleton = makeSkeleton({{"Hips", Joint::kNoParent, {4, 2, 1}, {}},
                                 {"LeftArm", Joint::kNoParent, {6, 2, 1}, JointLimits{Vec3(-90), Vec3(90)}},
                                 {"LeftHand", Joint::kNoParent, {8, 2, 1}, {}},
                                 {"RightArm", Joint::kNoParent, {2, 2, 1}, {}}},
                                {"", "Hips", "LeftArm", "Hips"});
    Limb upper, lower;
    upper.name = "LeftArm";
    upper.from = 1;
    upper.to = 2;
    upper.size = {2, 3};
    upper.offset = {0.5, 0};
    upper.roll = std::acos(-1.0) / 2;
    upper.pad = {1, 0};
    lower = upper;
    lower.name = "Shoulder";
    lower.from = 0;
    lower.to = 1;
    rig.limbs = {upper, lower};
    return rig;
}
Scene withActor() {
    Scene scene = sceneOf(kBox);
    addActor(scene, kPath, "walker", smallRig());
    return scene;
}

/// Two seconds at 120 frames a second of the rig's joints, twice as large and lying elsewhere.
Motion waving() {
    Motion motion;
    const auto turn = std::vector{MotionChannel::Zrotation, MotionChannel::Xrotation, MotionChannel::Yrotation};
    motion.joints = {{"Hips", Joint::kNoParent, {0, 100, 0}, turn},
                     {"LeftArm", 0, {4, 0, 0}, turn},
                     {"LeftHand", 1, {4, 0, 0}, turn},
                     {"RightArm", 0, {-4, 0, 0}, turn}};
    motion.frameTime = 0.0083333;
    motion.frames = 241;
    motion.values.assign(motion.frames * motion.channelCount(), 0);
    return motion;
}

TEST(ActorEdits, AddingOneWrapsTheObject) {
    Scene scene = withActor();
    const ActorObject* actor = findActorAt(scene, kPath);
    ASSERT_TRUE(actor);
    EXPECT_EQ(actor->name, "walker");
    EXPECT_TRUE(std::holds_alternative<SolidObject>(actor->of->kind));
    EXPECT_EQ(actor->rig.skeleton.joints.at(2).parent, "LeftArm");
    EXPECT_EQ(actor->rig.skeleton.joints.at(1).limits, (JointLimits{Vec3(-90), Vec3(90)}));
    const SceneLimb& limb = actor->rig.skeleton.limbs.at(0);
    EXPECT_EQ(limb.from + ">" + limb.to, "LeftArm>LeftHand");
    EXPECT_NEAR(*limb.roll, 90, 1e-12);
    EXPECT_EQ(**limb.pad, Vec2(1, 0));
    EXPECT_EQ(addActor(scene, "/root/of", "walker", smallRig()), "/root/of");
    EXPECT_EQ(findActorAt(scene, "/root/of")->name, "walker 2");
    EXPECT_THAT(actorPaths(scene), ElementsAre("/root", "/root/of"));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
}

TEST(ActorEdits, AnActorIsFoundThroughItsUse) {
    Scene scene = withActor();
    scene.objects["w"] = scene.root;
    scene.root = Object{ObjectUse{"w"}};
    ASSERT_TRUE(findActorAt(scene, kPath));
    editRig(scene, kPath, [](ActorRig& rig) { rig.miterLimit = 3; });
    EXPECT_EQ(findActorAt(scene, "/objects/w")->rig.miterLimit, 3);
    EXPECT_TRUE(std::holds_alternative<ObjectUse>(scene.root->kind));
    EXPECT_FALSE(findActorAt(scene, "/root/of"));
    EXPECT_THROW(clearMotion(scene, "/objects/none"), Error);
}

TEST(ActorEdits, RemovingTheActorLeavesItsObject) {
    Scene scene = withActor();
    removeNode(scene, kPath);
    EXPECT_EQ(scene, sceneOf(kBox));
}

TEST(ActorEdits, AnActorWithoutItsObjectGoesAndALimbWithoutItsOwnShowsTheActors) {
    Scene scene = sceneOf(R"({"type": "union", "of": [)" + kBox + ", " + kBox + "]}");
    addActor(scene, "/root/of/1", "walker", smallRig());
    editRig(scene, "/root/of/1", [](ActorRig& rig) { rig.skeleton.limbs[1].of = ObjectRef(Object{SolidObject{}}); });
    Scene withoutLimbs = scene;
    removeNode(withoutLimbs, "/root/of/1/skeleton/limbs/1/of");
    EXPECT_FALSE(findActorAt(withoutLimbs, "/root/of/1")->rig.skeleton.limbs[1].of);
    EXPECT_TRUE(findActorAt(withoutLimbs, "/root/of/1"));
    removeNode(scene, "/root/of/1/of");
    EXPECT_EQ(scene, sceneOf(kBox));
}

TEST(ActorEdits, WrappingInAnActorTakesTheObject) {
    Scene scene = sceneOf(kBox);
    wrapObject(scene, kPath, Object{ActorObject{"w", {}, {}}});
    EXPECT_EQ(*findActorAt(scene, kPath)->of, *sceneOf(kBox).root);
}

TEST(ActorEdits, AMotionIsMatchedFittedAndHeldByTheTimeline) {
    Scene scene = withActor();
    const Motion motion = waving();
    const std::string asset = addMotionAsset(scene, "wave", "wave.bvh");
    EXPECT_EQ(addMotionAsset(scene, "wave", "other.bvh"), "wave 2");
    setMotion(scene, kPath, asset, motion);
    const ActorRig& rig = findActorAt(scene, kPath)->rig;
    EXPECT_EQ(rig.motion, "wave");
    EXPECT_TRUE(rig.motionMap.empty()) << "matched by names";
    ASSERT_TRUE(rig.motionFit);
    EXPECT_FALSE(rig.motionFit->matrix) << "a similarity, in the members that people edit";
    const Mat4 fit = worldFromRest(*rig.motionFit);
    const Mat4 proposed = proposedMotionFit(smallRig().skeleton, motion, matchingJoints(smallRig().skeleton, motion));
    for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(fit[c] - proposed[c]), 1e-6) << c;
    EXPECT_EQ(scene.timeline, (Timeline{60, 0, 121})) << "120 a second is more than is shown; 2 s and the last frame";
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);

    scene.timeline = {10, 0, 5};
    setMotion(scene, kPath, asset, motion);
    EXPECT_EQ(scene.timeline, (Timeline{10, 0, 21})) << "the rate of a scene that moves is kept";
    scene.timeline = {10, 0, 500};
    setMotion(scene, kPath, asset, motion);
    EXPECT_EQ(scene.timeline.end, 500) << "never shortened";
    clearMotion(scene, kPath);
    EXPECT_EQ(findActorAt(scene, kPath)->rig, findActorAt(withActor(), kPath)->rig);
}

TEST(ActorEdits, AMotionThatMatchesNothingSaysSoAndChangesNothing) {
    Scene scene = withActor();
    addMotionAsset(scene, "m", "m.bvh");
    const Scene before = scene;
    Motion motion = waving();
    for (std::size_t j = 0; j < motion.joints.size(); ++j) motion.joints[j].name = "qq" + std::to_string(j);
    try {
        setMotion(scene, kPath, "m", motion);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("qq0"));
        EXPECT_THAT(error.what(), HasSubstr("Hips"));
        EXPECT_THAT(error.what(), HasSubstr("motionMap"));
    }
    EXPECT_EQ(scene, before);
    // The table is how it is played all the same.
    editRig(scene, kPath, [](ActorRig& rig) { rig.motion = "m"; });
    setMotionJoint(scene, kPath, "Hips", "qq0", motion);
    setMotionJoint(scene, kPath, "LeftArm", "qq1", motion);
    const ActorRig& rig = findActorAt(scene, kPath)->rig;
    EXPECT_EQ(rig.motionMap.at("Hips"), "qq0");
    EXPECT_EQ(rig.motionMap.at("RightArm"), "");
    EXPECT_TRUE(rig.motionFit) << "two joints are enough for a fit";
}

TEST(ActorEdits, TheTableOfJointsIsWrittenOutOnce) {
    Scene scene = withActor();
    addMotionAsset(scene, "m", "m.bvh");
    setMotion(scene, kPath, "m", waving());
    setMotionJoint(scene, kPath, "LeftHand", "", waving());
    const auto& map = findActorAt(scene, kPath)->rig.motionMap;
    EXPECT_EQ(map, (std::map<std::string, std::string>{
                       {"Hips", "Hips"}, {"LeftArm", "LeftArm"}, {"LeftHand", ""}, {"RightArm", "RightArm"}}));
    EXPECT_THROW(setMotionJoint(scene, kPath, "LeftHand", "Tail", waving()), Error);
    EXPECT_THROW(setMotionJoint(scene, kPath, "Tail", "Hips", waving()), Error);
    EXPECT_EQ(findActorAt(scene, kPath)->rig.motionMap.at("LeftHand"), "");
}

TEST(ActorEdits, LimbsLeftOutAreWrittenOutBeforeTheyAreEdited) {
    Scene scene = sceneOf(R"({"type": "solid", "shape": {"box": {"min": [0, 1.75, 0.75], "max": [8, 2.25, 1.25]}},
        "color": [1, 1, 1], "opacity": 1})");
    addActor(scene, kPath, "walker", smallRig());
    editRig(scene, kPath, [](ActorRig& rig) { rig.skeleton.limbs.clear(); });
    const CompiledScene compiled = compile(scene, {}, 0, nullptr);
    ASSERT_EQ(compiled.actors.size(), 1u);
    const CompiledActor& actor = *compiled.actors[0];
    ASSERT_EQ(actor.limbs.size(), 3u);
    editLimb(
        scene, kPath, "LeftArm", [](SceneLimb& limb) { limb.size = Vec2(7, 8); }, actor);
    const auto& limbs = findActorAt(scene, kPath)->rig.skeleton.limbs;
    ASSERT_EQ(limbs.size(), 3u);
    for (const SceneLimb& limb : limbs) {
        EXPECT_EQ(limb.size.has_value(), limb.name == "LeftArm") << "the others stay fitted";
        if (limb.size) {
            EXPECT_EQ(**limb.size, Vec2(7, 8));
            EXPECT_TRUE(limb.pad) << "as fitted";
        }
    }
    EXPECT_THROW(editLimb(
                     scene, kPath, "Tail", [](SceneLimb&) {}, actor),
                 Error);
}

TEST(ActorEdits, FittedLimbsReplaceSizes) {
    Scene scene = withActor();
    std::vector<Limb> limbs = smallRig().limbs;
    limbs[0].size = {9, 9};
    setFittedLimbs(scene, kPath, limbs);
    EXPECT_EQ(**findActorAt(scene, kPath)->rig.skeleton.limbs[0].size, Vec2(9, 9));
    EXPECT_EQ(**findActorAt(scene, kPath)->rig.skeleton.limbs[1].size, Vec2(2, 3));
}

}  // namespace
}  // namespace voledit::test
