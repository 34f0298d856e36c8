#include "app/editor/motion_import.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "app/editor/node_actions.h"
#include "app/editor/tools/actor_view.h"
#include "core/base/error.h"
#include "core/scene/actor_edits.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

/// The asset that is this very file; "" where none is.
std::string assetOf(const Workspace& workspace, const std::string& written) {
    for (const auto& [name, asset] : workspace.document.scene().assets)
        if (asset.kind == AssetKind::Motion && asset.path == written) return name;
    return "";
}

std::string someNames(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t n = 0; n < std::min<std::size_t>(4, names.size()); ++n) text += (n ? ", " : "") + names[n];
    return text + (names.size() > 4 ? " …" : "");
}

}  // namespace

ReadMotion readMotionFile(IoClient& io, const fs::path& path, Progress* progress) {
    MotionFile file = io.readMotion(path, progress);
    return {path, std::move(file.motion), std::move(file.warnings)};
}

NodePath actorForMotion(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    const CompiledScene* compiled = workspace.compiled.root ? &workspace.compiled : nullptr;
    if (const ActorPtr actor = meantActor(scene, compiled, workspace.selection)) return actor->path;
    if (actorPaths(scene).empty())
        throw Error("the scene has no actor that a motion could drive: rig the object first (Actor ▸ Auto-rig)");
    throw Error("the scene has several actors; select the one that the motion is to drive");
}

namespace {

/// Lets `motion` drive the actor. Where nothing matches, the table stands there with nothing in it, for the user to go
/// on with, and false is given back.
bool drive(Scene& scene, const CompiledScene& compiled, const NodePath& actor, const std::string& asset,
           const Motion& motion) {
    try {
        setMotion(scene, actor, asset, motion);
        return true;
    } catch (const Error&) {
        editRig(scene, actor, [&](ActorRig& rig) {
            rig.motion = asset;
            rig.motionMap.clear();
            for (const ActorPtr& shown : compiled.actors)
                if (shown->path == actor)
                    for (const Joint& joint : shown->skeleton.joints) rig.motionMap[joint.name] = "";
        });
        return false;
    }
}

void tellOf(Workspace& workspace, const std::string& name, const Motion& motion, bool matched) {
    if (matched) {
        workspace.notify(Notice::Kind::Info, "Motion " + name + ": " + std::to_string(motion.frames) + " frames");
        return;
    }
    std::vector<std::string> joints;
    for (const MotionJoint& joint : motion.joints) joints.push_back(joint.name);
    workspace.actors.showTable = true;
    workspace.notify(Notice::Kind::Warning, "No joint of " + name + " (" + someNames(joints) +
                                                ") is called as one of the actor's. Choose which drives which in "
                                                "the inspector's table of joints.");
}

}  // namespace

void takeMotion(Workspace& workspace, const ReadMotion& read) {
    const NodePath actor = actorForMotion(workspace);
    const std::string written = writtenPath(read.path.string(), workspace.folder);
    std::string name = assetOf(workspace, written);
    bool matched = true;
    workspace.document.apply("Import motion", [&](Scene& scene) {
        if (name.empty()) name = addMotionAsset(scene, read.path.stem().string(), written);
        matched = drive(scene, workspace.compiled, actor, name, *read.motion);
    });
    workspace.assets.motions[name] = read.motion;
    for (const std::string& warning : read.warnings) workspace.notify(Notice::Kind::Warning, warning);
    selectTarget(workspace, actor);
    tellOf(workspace, name, *read.motion, matched);
}

void driveByAsset(Workspace& workspace, const NodePath& actor, const std::string& asset) {
    const auto found = workspace.assets.motions.find(asset);
    if (found == workspace.assets.motions.end())
        throw Error("asset \"" + asset + "\"", "its motion was not read", "open the scene again");
    const std::shared_ptr<const Motion> motion = found->second;
    bool matched = true;
    workspace.document.apply("Change motion",
                             [&](Scene& scene) { matched = drive(scene, workspace.compiled, actor, asset, *motion); });
    tellOf(workspace, asset, *motion, matched);
}

}  // namespace voledit
