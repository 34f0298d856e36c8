// Actors and `skeleton` STFs compiled: what stands where at a time.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/error.h"
#include "core/scene/actor_pose.h"
#include "core/scene/scene_at.h"
#include "tests/core/scene/compiled_json.h"

namespace voledit::test {
namespace {

using testing::HasSubstr;

/// A rod along x from 0 to 8, of two bones of length 4, seen through a volume-like field: opacity 1, colour by place.
const std::string kRod =
    R"({"type": "fields", "opacity": 1, "color": [{"expression": "x/8"}, {"expression": "y/2 + 0.5"},
        {"expression": "z/2 + 0.5"}], "bounds": {"min": [0, -1, -1], "max": [8, 1, 1]}})";
const std::string kBones = R"("joints": [{"name": "a", "parent": null, "at": [0, 0, 0]},
    {"name": "b", "parent": "a", "at": [4, 0, 0])";
const std::string kLimbs = R"(}, {"name": "c", "parent": "b", "at": [8, 0, 0]}],
    "limbs": [{"name": "upper", "from": "a", "to": "b", "size": [2, 2]},
              {"name": "lower", "from": "b", "to": "c", "size": [2, 2]}])";

/// `elbow`: further members of joint b.
std::string rodActor(const std::string& elbow = "", const std::string& members = "") {
    return R"({"type": "actor", "name": "rod", "of": )" + kRod + R"(, "skeleton": {)" + kBones + elbow + kLimbs + "}" +
           members + "}";
}
Vec3 sourceOf(const CompiledScene& scene, const Vec3& p) {
    return at(*transferOf(scene.root).by, p);
}

TEST(CompileActors, AtRestShowsTheBareObjectToTheBitWithinItsRegions) {
    const CompiledScene actor = compiled(rodActor()), bare = compiled(kRod);
    EXPECT_EQ(actor.root->bounds.min, bare.root->bounds.min);
    EXPECT_EQ(actor.root->bounds.max, bare.root->bounds.max);
    for (double x = 0.013; x < 8; x += 0.37)
        for (double y = -0.99; y < 1; y += 0.31) {
            const Vec3 p(x, y, y / 2);
            EXPECT_LT(glm::length(sourceOf(actor, p) - p), 1e-14);
            EXPECT_EQ(at(actor, p).opacity, 1);
        }
    EXPECT_EQ(at(actor, {-0.01, 0, 0}).opacity, 0) << "outside the regions nothing is shown";
}

TEST(CompileActors, ABentElbowEndsBothLimbsInTheMidPlane) {
    const CompiledScene scene = compiled(rodActor(R"(, "rotate": [0, 0, 90])", R"(, "smooth": false)"));
    // The forearm stands along y at x = 4; its own middle is moved rigidly.
    EXPECT_LT(glm::length(sourceOf(scene, {4, 4, 0}) - Vec3(8, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(sourceOf(scene, {4, 0, 0}) - Vec3(4, 0, 0)), 1e-12) << "the joint itself";
    EXPECT_LT(glm::length(sourceOf(scene, {0, 0.5, 0.5}) - Vec3(0, 0.5, 0.5)), 1e-12) << "the upper arm's start";
    // The shared quadrilateral: outside corner at (5, −1), inside corner at (3, 1), both at x = 4 at rest.
    for (const double z : {-0.9, 0.0, 0.7}) {
        EXPECT_LT(glm::length(sourceOf(scene, {4.9, -0.9, z}) - Vec3(4, -0.9, z)), 1e-9);
        EXPECT_LT(glm::length(sourceOf(scene, {3.1, 0.9, z}) - Vec3(4, 0.9, z)), 1e-9);
    }
    EXPECT_EQ(at(scene, {4.99, -0.99, 0}).opacity, 1);
    EXPECT_EQ(at(scene, {6, 0, 0}).opacity, 0) << "where the forearm was";
    const CompiledActor& actor = *scene.actors.at(0);
    EXPECT_LT(glm::length(actor.posed[2].position - Vec3(4, 4, 0)), 1e-12);
    EXPECT_EQ(actor.rest[2].position, Vec3(8, 0, 0));
}

TEST(CompileActors, ADisjointLimbMovesRigidly) {
    for (const char* how : {R"(, "mode": "disjoint")", R"(, "disjoint": ["b"])"}) {
        const CompiledScene scene = compiled(rodActor(R"(, "rotate": [0, 0, 60], "translate": [1, 2, 0])", how));
        const double c = 0.5, s = std::sqrt(3.0) / 2;
        for (const Vec3& q : {Vec3(4.1, 0.9, 0.3), Vec3(7.9, -0.9, -0.9), Vec3(6, 0.1, 0)}) {
            const Vec3 d = q - Vec3(4, 0, 0);
            const Vec3 p = Vec3(5, 2, 0) + Vec3(c * d.x - s * d.y, s * d.x + c * d.y, d.z);
            EXPECT_LT(glm::length(sourceOf(scene, p) - q), 1e-12) << how;
        }
    }
}

TEST(CompileActors, ALimbMayShowAnObjectOfItsOwn) {
    const std::string own = R"({"type": "solid", "shape": {"box": {"min": [4, -1, -1], "max": [8, 1, 1]}},
        "color": [0, 1, 0], "opacity": 1})";
    const CompiledScene scene =
        compiled(R"({"type": "actor", "name": "two", "of": )" + kRod + R"(, "skeleton": {)" + kBones +
                 R"(, "rotate": [0, 0, 90]}, {"name": "c", "parent": "b", "at": [8, 0, 0]}], "limbs": [
                    {"name": "upper", "from": "a", "to": "b", "size": [2, 2]},
                    {"name": "lower", "from": "b", "to": "c", "size": [2, 2], "of": )" +
                 own + "}]}}");
    const auto& both = std::get<CvgTerm>(scene.root->node);
    EXPECT_EQ(both.by, CvgOperator::Union);
    ASSERT_EQ(both.of.size(), 2u);
    EXPECT_EQ(transferOf(both.of[0]).name, "two");
    EXPECT_EQ(transferOf(both.of[1]).name, "lower");
    EXPECT_EQ(at(scene, {4, 3, 0}).color, Vec3(0, 1, 0));
    EXPECT_NEAR(at(scene, {1, 0, 0}).color.r, 1 / 8.0, 1e-6);
    const CompiledScene all = compiled(rodActor(R"(, "rotate": [0, 0, 90])"));
    for (const Vec3& p : {Vec3(4, 2, 0.2), Vec3(3.5, 0.2, 0), Vec3(4.6, -0.3, 0.4)})
        EXPECT_EQ(at(scene, p).opacity, at(all, p).opacity) << "the regions are the same";
}

TEST(CompileActors, FitLaysTheSkeletonIntoTheObject) {
    // The same rod, its bones along z from 0 to 80 in their own space.
    const std::string fitted = R"({"type": "actor", "of": )" + kRod + R"(, "skeleton": {"joints": [
        {"name": "a", "parent": null, "at": [0, 0, 0]}, {"name": "b", "parent": "a", "at": [0, 0, 40],
         "rotate": [0, -90, 0]}, {"name": "c", "parent": "b", "at": [0, 0, 80]}],
        "fit": {"scale": 0.1, "rotate": [0, 90, 0]},
        "limbs": [{"name": "u", "from": "a", "to": "b", "size": [2, 2]},
                  {"name": "l", "from": "b", "to": "c", "size": [2, 2]}]}})";
    const CompiledScene scene = compiled(fitted);
    const CompiledActor& actor = *scene.actors.at(0);
    EXPECT_LT(glm::length(actor.rest[1].position - Vec3(4, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(actor.posed[2].position - Vec3(4, 0, 4)), 1e-12);
    EXPECT_LT(glm::length(sourceOf(scene, {4, 0, 3.9}) - Vec3(7.9, 0, 0)), 1e-12);
}

// ---- Motions --------------------------------------------------------------------------------------------------------

/// Joints a, b, c of the rod; b turns about z by 0, 40, 90 degrees at 0, 1, 2 s; the root moves along y.
std::shared_ptr<const Motion> rodMotion(const std::string& prefix = "") {
    Motion motion;
    motion.joints = {{prefix + "a",
                      Joint::kNoParent,
                      {0, 0, 0},
                      {MotionChannel::Xposition, MotionChannel::Yposition, MotionChannel::Zposition}},
                     {prefix + "b", 0, {4, 0, 0}, {MotionChannel::Zrotation}},
                     {prefix + "c", 1, {4, 0, 0}, {}}};
    motion.frameTime = 1;
    motion.frames = 3;
    motion.values = {0, 0, 0, 0, 0, 1, 0, 40, 0, 2, 0, 90};
    return std::make_shared<const Motion>(motion);
}
const std::string kMotionAsset = R"("assets": {"m": {"kind": "motion", "path": "m.bvh"}}, )";

LoadedAssets motionAssets(const std::string& prefix = "") {
    LoadedAssets assets;
    assets.motions["m"] = rodMotion(prefix);
    return assets;
}
std::string motionActor(const std::string& skeleton = "", const std::string& members = "") {
    return R"({"type": "actor", "of": )" + kRod + R"(, "motion": "m", "skeleton": {"motion": "m", "limbs": [
        {"name": "upper", "from": "a", "to": "b", "size": [2, 2]},
        {"name": "lower", "from": "b", "to": "c", "size": [2, 2]}])" +
           skeleton + "}" + members + "}";
}
Vec3 handAt(const CompiledScene& scene) {
    return scene.actors.at(0)->posed.at(2).position;
}
Vec3 expectedHand(double y, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {4 + 4 * std::cos(angle), y + 4 * std::sin(angle), 0};
}

TEST(CompileActors, AMotionRunsOnTheScenesClockAndIsHeldAtItsEnds) {
    const Scene scene = sceneOf(motionActor(), kMotionAsset);
    const LoadedAssets assets = motionAssets();
    EXPECT_TRUE(animated(scene));
    EXPECT_FALSE(hasTracks(scene));
    const std::vector<std::pair<double, Vec3>> expected{
        {-5, expectedHand(0, 0)},     {0, expectedHand(0, 0)},  {0.5, expectedHand(0.5, 20)}, {1, expectedHand(1, 40)},
        {1.5, expectedHand(1.5, 65)}, {2, expectedHand(2, 90)}, {99, expectedHand(2, 90)}};
    for (const auto& [t, hand] : expected) {
        const CompiledScene now = compile(scene, assets, t, nullptr);
        EXPECT_LT(glm::length(handAt(now) - hand), 1e-9) << t;
        EXPECT_LT(glm::length(sourceOf(now, hand) - Vec3(8, 0, 0)), 1e-9) << t;
    }
}

TEST(CompileActors, OwnRotationsComeOnTopOfTheMotion) {
    // local = motion's local · own: the own rotation is about the joint's turned axes.
    const Scene scene = sceneOf(
        motionActor(R"(, "pose": [{"name": "b", "rotate": [0, -90, 0]}, {"name": "a", "translate": [0, 0, 3]}])"),
        kMotionAsset);
    const CompiledScene now = compile(scene, motionAssets(), 2, nullptr);
    EXPECT_LT(glm::length(handAt(now) - Vec3(4, 2, 7)), 1e-9) << "bent up, wherever the motion turned it";
    const CompiledActor& actor = *now.actors.at(0);
    EXPECT_EQ(actor.motionPose, poseAt(*rodMotion(), 2));
    EXPECT_EQ(actor.pose.translate[0], Vec3(0, 2, 3));
}

TEST(CompileActors, AMotionDrivesAnotherSkeletonByNamesOrATable) {
    const std::string members = R"(, "motion": "m")";
    const Scene byNames = sceneOf(rodActor("", members), kMotionAsset);
    EXPECT_LT(glm::length(handAt(compile(byNames, motionAssets(), 2, nullptr)) - expectedHand(2, 90)), 1e-9);
    const Scene byTable = sceneOf(
        rodActor(
            "",
            members + R"(, "motionMap": {"a": "q_a", "b": "q_b", "c": null}, "motionFit": {"translate": [0, 0, 5]})"),
        kMotionAsset);
    const Vec3 hand = handAt(compile(byTable, motionAssets("q_"), 2, nullptr));
    EXPECT_LT(glm::length(hand - expectedHand(2, 90) - Vec3(0, 0, 5)), 1e-9);
    const Scene held = sceneOf(rodActor("", members + R"(, "motionMap": {"b": null})"), kMotionAsset);
    EXPECT_LT(glm::length(handAt(compile(held, motionAssets(), 2, nullptr)) - expectedHand(2, 0)), 1e-9)
        << "null keeps the joint at rest, the others are matched by names";
}

TEST(CompileActors, ErrorsNameThePlaceAndWhatToDo) {
    const auto message = [](const std::string& root, const LoadedAssets& assets) -> std::string {
        try {
            compile(sceneOf(root, kMotionAsset), assets, 1, nullptr);
        } catch (const Error& error) {
            return error.what();
        }
        return "compiled";
    };
    LoadedAssets strange;
    Motion other = *rodMotion();
    other.joints[0].name = "xx1", other.joints[1].name = "xx2", other.joints[2].name = "xx3";
    strange.motions["m"] = std::make_shared<const Motion>(other);
    const std::string nothing = message(rodActor("", R"(, "motion": "m")"), strange);
    EXPECT_THAT(nothing, testing::StartsWith("/root: "));
    EXPECT_THAT(nothing, HasSubstr("xx1, xx2, xx3"));
    EXPECT_THAT(nothing, HasSubstr("a, b, c"));
    EXPECT_THAT(nothing, HasSubstr("`motionMap`"));
    EXPECT_THAT(message(rodActor("", R"(, "motion": "m")"), {}), HasSubstr("not loaded"));
    EXPECT_THAT(message(rodActor("", R"(, "motion": "m", "motionMap": {"a": "aa"})"), motionAssets()),
                HasSubstr("no joint \"aa\""));
    EXPECT_THAT(message(motionActor(R"(, "pose": [{"name": "bb"}])"), motionAssets()), HasSubstr("no joint \"bb\""));
    EXPECT_THAT(message(motionActor("", R"(, "disjoint": ["bb"])"), motionAssets()), HasSubstr("no joint \"bb\""));
    const std::string zero = R"({"type": "actor", "of": )" + kRod + R"(, "skeleton": {"joints": [
        {"name": "a", "parent": null, "at": [1, 0, 0]}, {"name": "b", "parent": "a", "at": [1, 0, 0]}])";
    EXPECT_THAT(message(zero + "}}", {}), HasSubstr("no bone with a length"));
    EXPECT_THAT(message(zero + R"(, "limbs": [{"name": "nil", "from": "a", "to": "b", "size": [1, 1]}]}})", {}),
                HasSubstr("nil"));
    EXPECT_THAT(message(R"({"type": "actor", "of": )" + kRod + R"(, "skeleton": {)" + kBones + kLimbs +
                            R"(, "fit": {"scale": {"keys": [[0, 1], [2, -1]]}}}})",
                        {}),
                HasSubstr("fit.scale is 0"));
}

// ---- Reuse, bounds, other nodes -------------------------------------------------------------------------------------

TEST(CompileActors, WhatDoesNotMoveIsShared) {
    const Scene scene = sceneOf(motionActor(), kMotionAsset);
    const LoadedAssets assets = motionAssets();
    const CompiledScene first = compile(scene, assets, 3, nullptr);
    const CompiledScene held = compile(scene, assets, 4, &first);
    EXPECT_EQ(held.root.get(), first.root.get()) << "held at its end, the pose is the same";
    EXPECT_EQ(held.actors.at(0)->regions.get(), first.actors.at(0)->regions.get());
    const CompiledScene moved = compile(scene, assets, 1, &held);
    EXPECT_NE(moved.root.get(), held.root.get());
    EXPECT_EQ(transferOf(moved.root).of.get(), transferOf(held.root).of.get()) << "what is moved is as it was";
}

TEST(CompileActors, SizesLeftOutAreFittedOnceToWhatCanBeSeen) {
    const std::string of = R"({"type": "solid", "shape": {"box": {"min": [0, -1, -0.5], "max": [8, 1, 0.5]}},
        "color": [1, 1, 1], "opacity": 1})";
    const Scene scene = sceneOf(R"({"type": "actor", "of": )" + of + R"(, "skeleton": {)" + kBones +
                                R"(, "rotate": {"keys": [[0, [0, 0, 0]], [1, [0, 0, 45]]]}},
                                   {"name": "c", "parent": "b", "at": [8, 0, 0]}]}})");
    const CompiledScene start = compile(scene, {}, 0, nullptr);
    const CompiledActor& actor = *start.actors.at(0);
    ASSERT_EQ(actor.limbs.size(), 2u);
    EXPECT_EQ(actor.limbs[0].name, "a");
    EXPECT_EQ(actor.limbs[1].name, "b");
    for (const Vec3& p : {Vec3(0.02, 0.98, 0.48), Vec3(7.98, -0.98, -0.48), Vec3(4, 0.98, -0.48)})
        EXPECT_EQ(at(start, p).opacity, 1) << "regions hold all of it";
    const CompiledScene later = compile(scene, {}, 1, &start);
    EXPECT_EQ(later.actors.at(0)->limbs, actor.limbs) << "the sizes of the timeline's start";
    EXPECT_EQ(compile(scene, {}, 1, nullptr).actors.at(0)->limbs, actor.limbs);
}

TEST(CompileActors, AWrittenSizeChangesNoFittedOne) {
    const auto scene = [](const std::string& size) {
        return sceneOf(R"({"type": "actor", "of": )" + kRod + R"(, "skeleton": {)" + kBones +
                       R"(}, {"name": "c", "parent": "b", "at": [8, 0, 0]}], "limbs": [
                          {"name": "u", "from": "a", "to": "b")" +
                       size + R"(}, {"name": "l", "from": "b", "to": "c"}]}})");
    };
    const CompiledScene left = compile(scene(""), {}, 0, nullptr);
    const CompiledScene written = compile(scene(R"(, "size": [0.5, 3], "pad": [1, 1])"), {}, 0, &left);
    EXPECT_EQ(written.actors.at(0)->limbs.at(1), left.actors.at(0)->limbs.at(1));
    EXPECT_EQ(written.actors.at(0)->limbs.at(0).size, Vec2(0.5, 3));
    EXPECT_EQ(written.actors.at(0)->limbs.at(0).pad, Vec2(1, 1));
}

TEST(CompileActors, TransfersAroundTakeTheBoxOfTheTimelinesStart) {
    const std::string root = transfer(R"({"type": "twist", "axis": "x", "angle": 0})", motionActor());
    const Scene scene = sceneOf(root, kMotionAsset);
    const CompiledScene start = compile(scene, motionAssets(), 0, nullptr);
    const CompiledScene later = compile(scene, motionAssets(), 2, nullptr);
    EXPECT_EQ(defaultFrames(later).at("/root/by/0"), defaultFrames(start).at("/root/by/0"));
    EXPECT_EQ(defaultFrames(later).at("/root/by/0"), frameOf(transferOf(start.root).of->bounds));
    EXPECT_GT(later.root->bounds.max.y, start.root->bounds.max.y + 2) << "bounds follow the pose";
}

TEST(CompileActors, ActorsComeInTheTreesOrderWithThePlacesAround) {
    const std::string inner = rodActor();
    const std::string outer = R"({"type": "actor", "name": "outer", "of": {"type": "place", "translate": [0, 5, 0],
        "of": )" + inner + R"(}, "skeleton": {"joints": [{"name": "a", "parent": null, "at": [0, 5, 0]},
        {"name": "b", "parent": "a", "at": [8, 5, 0]}], "limbs": [{"name": "l", "from": "a", "to": "b", "size": [4, 4]}]}})";
    const CompiledScene scene =
        compiled(R"({"type": "place", "translate": [100, 0, 0], "scale": 2, "of": )" + outer + "}");
    ASSERT_EQ(scene.actors.size(), 2u);
    EXPECT_EQ(scene.actors[0]->name, "outer");
    EXPECT_EQ(scene.actors[0]->path, "/root/of");
    EXPECT_EQ(scene.actors[1]->path, "/root/of/of/of");
    EXPECT_EQ(transformPoint(scene.actors[0]->worldFromObject, {1, 0, 0}), Vec3(102, 0, 0));
    EXPECT_EQ(transformPoint(scene.actors[1]->worldFromObject, {1, 0, 0}), Vec3(102, 10, 0));
    EXPECT_EQ(at(scene, {102, 10, 0}).opacity, 1);
}

TEST(CompileActors, ASkeletonTransferIsTheRegionOfOneLimb) {
    const std::string rig =
        R"("skeleton": {)" + kBones + R"(, "rotate": [0, 0, 90])" + kLimbs + R"(}, "limb": "lower")";
    const CompiledScene scene = compiled(transfer(R"({"type": "skeleton", "name": "forearm", )" + rig + "}", kRod));
    const CompiledScene all = compiled(rodActor(R"(, "rotate": [0, 0, 90])"));
    for (const Vec3& p : {Vec3(4, 3, 0), Vec3(4.5, 1, 0.5), Vec3(3.6, 2.2, -0.4)})
        EXPECT_EQ(sourceOf(scene, p), sourceOf(all, p));
    EXPECT_EQ(at(scene, {1, 0, 0}).opacity, 0) << "the other limb is not shown";
    const CompiledScene kept = compiled(transfer(R"({"type": "skeleton", "outside": "keep", )" + rig + "}", kRod));
    EXPECT_EQ(sourceOf(kept, {1, 0, 0}), Vec3(1, 0, 0));
    const CompiledScene half = compiled(transfer(R"({"type": "skeleton", "amount": 0.5, )" + rig + "}", kRod));
    const Vec3 p(4, 3, 0);
    EXPECT_LT(glm::length(sourceOf(half, p) - 0.5 * (p + sourceOf(scene, p))), 1e-12);
    EXPECT_EQ(transferOf(scene.root).name, "forearm");
}

TEST(CompileActors, ASkeletonTransferWithoutSizesFitsItsObjectAndNeedsOne) {
    const std::string bones = R"("skeleton": {)" + kBones + R"(}, {"name": "c", "parent": "b", "at": [8, 0, 0]}]})";
    const CompiledScene scene = compiled(transfer(R"({"type": "skeleton", "limb": "b", )" + bones + "}", kRod));
    EXPECT_EQ(at(scene, {6, 0.9, 0.9}).opacity, 1);
    EXPECT_EQ(at(scene, {1, 0, 0}).opacity, 0);
    try {
        compiled(R"({"type": "fields", "opacity": {"component": "x", "of": {"type": "skeleton", "limb": "b", )" +
                 bones + R"(}}, "color": [1, 1, 1]})");
        ADD_FAILURE() << "compiled";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no size"));
        EXPECT_THAT(error.what(), testing::StartsWith("/root/opacity/of: "));
    }
}

// ---- What a rig says (core/scene/actor_pose.h)
// -----------------------------------------------------------------------

TEST(ActorPose, LimbsLeftOutAreTheBonesThatHaveALength) {
    Skeleton tree = makeSkeleton({{"hip", Joint::kNoParent, {0, 0, 0}, {}},
                                  {"copy", Joint::kNoParent, {0, 0, 0}, {}},
                                  {"l", Joint::kNoParent, {1, 0, 0}, {}},
                                  {"r", Joint::kNoParent, {-1, 0, 0}, {}},
                                  {"l_End", Joint::kNoParent, {2, 0, 0}, {}}},
                                 {"", "hip", "hip", "copy", "l"});
    std::vector<std::string> names;
    for (const SceneLimb& limb : limbsOf(SceneSkeleton{}, tree))
        names.push_back(limb.name + "=" + limb.from + ">" + limb.to);
    EXPECT_THAT(names, testing::UnorderedElementsAre("hip=hip>l", "copy=copy>r", "l=l>l_End"));
}

}  // namespace
}  // namespace voledit::test
