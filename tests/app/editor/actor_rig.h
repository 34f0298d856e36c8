#pragma once
// A small scene with an actor: a bar along x with arms to both sides of a chest, looked at from the front.

#include <glm/geometric.hpp>
#include <string>

#include "app/editor/tools/actor_view.h"
#include "core/scene/actor_edits.h"
#include "core/scene/scene_json.h"
#include "tests/app/editor/editor_rig.h"

namespace voledit::test {

/// Joints of a body whose arms lie along x: Hips below Chest, and of each side Arm, ForeArm, Hand and its end.
inline constexpr const char* kActorScene = R"({ "voledit": 1,
  "root": { "type": "actor", "name": "body",
    "skeleton": {
      "joints": [
        { "name": "Hips", "parent": null, "at": [0, 0, 0] },
        { "name": "Chest", "parent": "Hips", "at": [0, 0, 1] },
        { "name": "LeftArm", "parent": "Chest", "at": [0.4, 0, 1] },
        { "name": "LeftForeArm", "parent": "LeftArm", "at": [1.2, 0, 1] },
        { "name": "LeftHand", "parent": "LeftForeArm", "at": [2, 0, 1] },
        { "name": "LeftHand_End", "parent": "LeftHand", "at": [2.4, 0, 1] },
        { "name": "RightArm", "parent": "Chest", "at": [-0.4, 0, 1] },
        { "name": "RightForeArm", "parent": "RightArm", "at": [-1.2, 0, 1] },
        { "name": "RightHand", "parent": "RightForeArm", "at": [-2, 0, 1] },
        { "name": "RightHand_End", "parent": "RightHand", "at": [-2.4, 0, 1] } ],
      "limbs": [
        { "name": "trunk", "from": "Hips", "to": "Chest", "size": [0.8, 0.6], "pad": [0.3, 0.3] },
        { "name": "upper arm L", "from": "LeftArm", "to": "LeftForeArm", "size": [0.6, 0.6], "pad": [0, 0] },
        { "name": "forearm L", "from": "LeftForeArm", "to": "LeftHand", "size": [0.6, 0.6], "pad": [0, 0] },
        { "name": "hand L", "from": "LeftHand", "to": "LeftHand_End", "size": [0.6, 0.6], "pad": [0, 0.1] },
        { "name": "upper arm R", "from": "RightArm", "to": "RightForeArm", "size": [0.6, 0.6], "pad": [0, 0] },
        { "name": "forearm R", "from": "RightForeArm", "to": "RightHand", "size": [0.6, 0.6], "pad": [0, 0] },
        { "name": "hand R", "from": "RightHand", "to": "RightHand_End", "size": [0.6, 0.6], "pad": [0, 0.1] } ] },
    "of": { "type": "union", "of": [
      { "type": "solid", "shape": { "box": { "min": [-2.4, -0.2, 0.8], "max": [2.4, 0.2, 1.2] } },
        "color": [0.9, 0.7, 0.6], "opacity": 0.9 },
      { "type": "solid", "shape": { "box": { "min": [-0.3, -0.2, -0.2], "max": [0.3, 0.2, 1] } },
        "color": [0.9, 0.7, 0.6], "opacity": 0.9 } ] } },
  "camera": { "eye": [0, -10, 0.7], "target": [0, 0, 0.7], "up": [0, 0, 1], "fovY": 30 } })";

inline void openActor(Workspace& workspace) {
    workspace.open = true;
    workspace.document = Document(sceneFromJson(kActorScene, "actor.voledit"));
    workspace.assets = {};
    workspace.viewSize = {800, 600};
    workspace.compiled = compile(workspace.document.scene(), workspace.assets, 0, nullptr);
    workspace.camera = workspace.compiled.camera;
}

inline ActorPtr actorIn(const Workspace& workspace) {
    return workspace.compiled.actors.at(0);
}
inline Vec3 jointIn(const Workspace& workspace, const std::string& name) {
    return shownJoint(*actorIn(workspace), actorIn(workspace)->skeleton.find(name));
}
inline Vec2 jointPixel(const Workspace& workspace, const std::string& name) {
    return Vec2(project(workspace.camera, workspace.viewSize, jointIn(workspace, name)));
}
/// Degrees of a joint's own rotation, as the scene holds it.
inline Vec3 degreesIn(const Workspace& workspace, const std::string& name) {
    const NamedPose pose = poseOf(workspace.document.scene(), "/root", workspace.time);
    const auto found = pose.find(name);
    return found == pose.end() ? Vec3(0) : found->second;
}

}  // namespace voledit::test
