#pragma once
// A body rigged by itself and moved by another skeleton's motion, both from resources.

#include "core/base/paths.h"
#include "core/io/bvh.h"
#include "core/io/io_client.h"
#include "core/rigging/rig.h"
#include "core/scene/actor_edits.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

struct Body {
    Scene scene;
    LoadedAssets assets;
    double covered = 0;
};

/// The person of resources, rigged, with a motion of resources.
inline Body rigged(const std::string& motion) {
    Body body;
    IoClient io;
    const auto volume = io.readVolume(resourceFolder() / "volumes/human_body.mhd").volume;
    body.scene = sceneOfVolume("human_body.mhd", "body", suggestedPreset(*volume));
    body.assets.volumes["body"] = volume;
    const OpaqueVoxels voxels = opaqueVoxels(*compile(body.scene, body.assets, 0, nullptr).root, 0.02);
    const Rig rig = fittedRig(voxels, RigTemplate::Biped);
    const NodePath actor = addActor(body.scene, kRootPath, "actor", rig);
    const auto read = std::make_shared<const Motion>(readBvh(resourceFolder() / "motions" / (motion + ".bvh")));
    const std::string asset = addMotionAsset(body.scene, motion, motion + ".bvh");
    setMotion(body.scene, actor, asset, *read);
    body.assets.motions[asset] = read;
    const auto rest = posedJoints(rig.skeleton, restPose(rig.skeleton));
    body.covered = coverageOf(voxels, rig.limbs, rest, {}).covered();
    return body;
}

}  // namespace voledit
