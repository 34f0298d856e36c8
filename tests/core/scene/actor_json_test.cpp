// Actors in scene files.

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_walk.h"
#include "tests/core/scene/compiled_json.h"

namespace voledit::test {
namespace {

const std::string kAssets = R"("assets": {"v": {"kind": "volume", "path": "v.nrrd"},
    "m": {"kind": "motion", "path": "m.bvh"}}, )";
const std::string kVolume = R"({"type": "volume", "asset": "v"})";
const std::string kJoints = R"("joints": [{"name": "hip", "parent": null, "at": [0, 0, 0]},
    {"name": "knee", "parent": "hip", "at": [0, 0, -1]}, {"name": "foot", "parent": "knee", "at": [0, 0, -2]},
    {"name": "hand", "parent": "hip", "at": [1, 0, 0]}])";

std::string actor(const std::string& skeleton, const std::string& members = "") {
    return R"({"type": "actor", "of": )" + kVolume + R"(, "skeleton": {)" + skeleton + "}" + members + "}";
}
const ActorObject& actorOf(const Scene& scene) {
    return std::get<ActorObject>(scene.root->kind);
}

TEST(ActorJson, ReadsEveryMember) {
    const Scene scene = sceneOf(actor(R"("joints": [{"name": "hip", "parent": null, "at": [1, 2, 3],
                   "rotate": {"keys": [[0, [0, 0, 0], "step"], [1, [90, 0, 0]]], "interpolation": "smooth"},
                   "translate": [0, 1, 0], "limits": {"min": [-10, -20, -30], "max": [10, 20, 30]}},
                  {"name": "knee", "parent": "hip", "at": [0, 0, -1]}],
                 "fit": {"scale": 0.1}, "limbs": [{"name": "thigh", "from": "hip", "to": "knee", "size": [2, 3],
                   "offset": [0.5, 0], "roll": 45, "pad": [1, 2], "of": )" +
                                          kVolume + "}]",
                                      R"(, "name": "z", "motion": "m", "motionMap": {"hip": "Hips", "knee": null},
                 "motionFit": {"scale": 2}, "inPlace": true, "mode": "disjoint", "disjoint": ["knee"],
                 "cells": [2, 3, 5], "miterLimit": 1.5, "smooth": false, "preserveVolume": true,
                 "poses": {"sit": {"knee": [90, 0, 0]}})"),
                                kAssets);
    const ActorObject& actor = actorOf(scene);
    EXPECT_EQ(actor.name, "z");
    const ActorRig& rig = actor.rig;
    const SceneJoint& hip = rig.skeleton.joints.at(0);
    EXPECT_EQ(hip.parent, "");
    EXPECT_EQ(*hip.at, Vec3(1, 2, 3));
    EXPECT_EQ(hip.rotate.at(0.5).degrees, Vec3(0)) << "the first key steps";
    EXPECT_EQ(hip.rotate.tracks().at(0).track.interpolation, Track::Interpolation::Smooth);
    EXPECT_EQ(hip.limits, (JointLimits{Vec3(-10, -20, -30), Vec3(10, 20, 30)}));
    EXPECT_EQ(rig.skeleton.fit.scale, Vec3(0.1));
    const SceneLimb& limb = rig.skeleton.limbs.at(0);
    EXPECT_EQ(**limb.size, Vec2(2, 3));
    EXPECT_EQ(*limb.offset, Vec2(0.5, 0));
    EXPECT_EQ(limb.roll, 45.0);
    EXPECT_EQ(**limb.pad, Vec2(1, 2));
    EXPECT_TRUE(limb.of);
    EXPECT_EQ(rig.motion, "m");
    EXPECT_EQ(rig.motionMap, (std::map<std::string, std::string>{{"hip", "Hips"}, {"knee", ""}}));
    EXPECT_EQ(rig.motionFit->scale, Vec3(2));
    EXPECT_TRUE(rig.inPlace && rig.allDisjoint && !rig.smooth && rig.preserveVolume);
    EXPECT_EQ(rig.disjoint, std::vector<std::string>{"knee"});
    EXPECT_EQ(rig.cells, Index3(2, 3, 5));
    EXPECT_EQ(rig.miterLimit, 1.5);
    EXPECT_EQ(rig.poses.at("sit").at("knee"), Vec3(90, 0, 0));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
}

TEST(ActorJson, TheRestOfAMotionMayHaveRotationsOfItsOwn) {
    const Scene scene = sceneOf(actor(R"("motion": "m", "pose": [{"name": "Hips", "rotate": [0, 0, 90]}])"), kAssets);
    EXPECT_EQ(actorOf(scene).rig.skeleton.motion, "m");
    EXPECT_EQ(actorOf(scene).rig.skeleton.joints.at(0).rotate->degrees, Vec3(0, 0, 90));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
}

TEST(ActorJson, LimbsObjectsAreNodesOfTheirOwn) {
    const Scene scene = sceneOf(actor(kJoints + R"(, "limbs": [{"name": "a", "from": "hip", "to": "knee"},
        {"name": "b", "from": "knee", "to": "foot", "of": )" +
                                      kBox + "}]"),
                                kAssets);
    const NodePath path = "/root/skeleton/limbs/1/of";
    ASSERT_TRUE(findObjectAt(scene, path));
    EXPECT_TRUE(std::holds_alternative<SolidObject>(findObjectAt(scene, path)->kind));
    EXPECT_EQ(parentOf(scene, path), "/root");
    std::vector<NodePath> paths;
    forEachNode(scene, [&](const NodePath& at, const NodePointer&) { paths.push_back(at); });
    EXPECT_EQ(paths, (std::vector<NodePath>{"/root", "/root/of", path}));
}

struct BadActor {
    std::string root, pointer, cause, remedy;
};
TEST(ActorJson, MistakesAreRefusedWithPlaceCauseAndRemedy) {
    const std::string limbs = kJoints + R"(, "limbs": [)";
    const std::vector<BadActor> all{
        {actor(R"("joints": [{"name": "a", "parent": "b", "at": [0, 0, 0]}])"), "/root/skeleton/joints/0/parent",
         "there is no joint \"b\"", ""},
        {actor(R"("joints": [{"name": "hips", "parent": null, "at": [0, 0, 0]},
                             {"name": "b", "parent": "hip", "at": [0, 0, 0]}])"),
         "/root/skeleton/joints/1/parent", "there is no joint \"hip\"", "did you mean \"hips\"?"},
        {actor(
             R"("joints": [{"name": "a", "parent": "b", "at": [0, 0, 0]}, {"name": "b", "parent": "c", "at": [0, 0, 0]},
                             {"name": "c", "parent": "b", "at": [0, 0, 0]}])"),
         "/root/skeleton/joints/0/parent", "is its own ancestor", "circle"},
        {actor(R"("joints": [{"name": "a", "parent": "a", "at": [0, 0, 0]}])"), "/root/skeleton/joints/0/parent",
         "is its own ancestor", "circle"},
        {actor(R"("joints": [{"name": "a", "parent": null, "at": [0, 0, 0]}, {"name": "a", "parent": null,
                  "at": [0, 0, 0]}])"),
         "/root/skeleton/joints/1/name", "two joints \"a\"", "a name of its own"},
        {actor(R"("joints": [])"), "/root/skeleton/joints", "", ""},
        {actor(kJoints + R"(, "motion": "m")"), "/root/skeleton", "", ""},
        {actor(kJoints + R"(, "pose": [])"), "/root/skeleton", "joints together with pose", ""},
        {actor(kJoints + R"(, "fit": {"scale": 0})"), "/root/skeleton/fit", "fit.scale is 0", "unit of the skeleton"},
        {actor(limbs + R"({"name": "l", "from": "hip", "to": "nee"}])"), "/root/skeleton/limbs/0/to",
         "no joint \"nee\"", "did you mean \"knee\"?"},
        {actor(limbs + R"({"name": "l", "from": "hand", "to": "foot"}])"), "/root/skeleton/limbs/0/to",
         "\"foot\" is not below \"hand\"", "descendants"},
        {actor(limbs + R"({"name": "l", "from": "knee", "to": "knee"}])"), "/root/skeleton/limbs/0/to",
         "\"knee\" is not below \"knee\"", "descendants"},
        {actor(limbs + R"({"name": "l", "from": "hip", "to": "knee"}, {"name": "l", "from": "knee", "to": "foot"}])"),
         "/root/skeleton/limbs/1/name", "two limbs \"l\"", ""},
        {actor(limbs + R"({"name": "l", "from": "hip", "to": "knee", "size": [1, 0]}])"),
         "/root/skeleton/limbs/0/size/1", "above 0", ""},
        {actor(kJoints, R"(, "disjoint": ["kne"])"), "/root/disjoint/0", "no joint \"kne\"", "did you mean \"knee\"?"},
        {actor(kJoints, R"(, "motionMap": {"kne": "K"})"), "/root/motionMap/kne", "no joint \"kne\"",
         "did you mean \"knee\"?"},
        {actor(kJoints, R"(, "poses": {"p": {"kne": [0, 0, 0]}})"), "/root/poses/p/kne", "no joint \"kne\"",
         "did you mean \"knee\"?"},
        {actor(kJoints, R"(, "motion": "w")"), "/root/motion", "no asset \"w\"", ""},
        {actor(kJoints, R"(, "motion": "v")"), "/root/motion", "not of kind \"motion\"", "name one that is"},
        {actor(R"("motion": "v")"), "/root/skeleton/motion", "not of kind \"motion\"", "name one that is"},
        {actor(kJoints, R"(, "cells": [4, 4, 0])"), "/root/cells/2", "from 1 to 64", ""},
        {actor(kJoints, R"(, "miterLimit": 0.5)"), "/root/miterLimit", "at least 1", ""},
        {actor(R"("joints": [{"name": "a", "parent": null, "at": [0, 0, 0],
                  "limits": {"min": [0, 0, 1], "max": [0, 0, 0]}}])"),
         "/root/skeleton/joints/0/limits", "max is below min about z", "swap"},
        {transfer(R"({"type": "skeleton", "limb": "leg", "skeleton": {)" + limbs +
                  R"({"name": "legs", "from": "hip", "to": "knee"}]}})"),
         "/root/by/limb", "no limb \"leg\"", "did you mean \"legs\"?"},
        {transfer(R"({"type": "skeleton", "skeleton": {)" + kJoints + "}}"), "/root/by", "\"limb\" is missing", ""},
        {R"({"type": "volume", "asset": "m"})", "/root/asset", "not of kind \"volume\"", ""},
    };
    for (const BadActor& bad : all) {
        try {
            sceneOf(bad.root, kAssets);
            ADD_FAILURE() << "read " << bad.root;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::StartsWith("/scene.voledit: " + bad.pointer + ": "));
            EXPECT_THAT(error.what(), testing::HasSubstr(bad.cause));
            EXPECT_THAT(error.what(), testing::HasSubstr(bad.remedy));
        }
    }
}

TEST(ActorJson, DeepHierarchiesAndManyLimbsTakeNoTime) {
    std::string joints, limbs;
    for (int j = 0; j < 10'000; ++j) {
        const std::string name = std::to_string(j);
        joints += std::string(j ? ", " : "") + R"({"name": ")" + name + R"(", "parent": )" +
                  (j ? "\"" + std::to_string(j - 1) + "\"" : std::string("null")) + R"(, "at": [0, 0, )" + name + "]}";
        if (j)
            limbs +=
                std::string(j > 1 ? ", " : "") + R"({"name": ")" + name + R"(", "from": "0", "to": ")" + name + "\"}";
    }
    const std::string text = "\"joints\": [" + joints + "], \"limbs\": [" + limbs + "]";
    EXPECT_EQ(actorOf(sceneOf(actor(text, R"(, "cells": [1, 1, 1])"), kAssets)).rig.skeleton.limbs.size(), 9999u);
    EXPECT_THROW(sceneOf(actor(text, R"(, "cells": [64, 64, 64])"), kAssets), Error) << "cells are counted";
}

}  // namespace
}  // namespace voledit::test
