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

std::string endingOf(const fs::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

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

bool isMotionFile(const fs::path& path) {
    constexpr std::array kEndings{".bvh", ".fbx", ".dae", ".glb", ".gltf"};
    return std::find(kEndings.begin(), kEndings.end(), endingOf(path)) != kEndings.end();
}

NodePath actorForMotion(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    const CompiledScene* compiled = workspace.compiled.root ? &workspace.compiled : nullptr;
    if (const ActorPtr actor = meantActor(scene, compiled, workspace.selection)) return actor->path;
    if (actorPaths(scene).empty())
        throw Error("the scene has no actor that a motion could drive: rig the object first (Actor ▸ Auto-rig)");
    throw Error("the scene has several actors; select the one that the motion is to drive");
}

void takeMotion(Workspace& workspace, const ReadMotion& read) {
    const NodePath actor = actorForMotion(workspace);
    const std::string written = writtenPath(read.path.string(), workspace.folder);
    std::string name = assetOf(workspace, written), problem;
    workspace.document.apply("Import motion", [&](Scene& scene) {
        if (name.empty()) name = addMotionAsset(scene, read.path.stem().string(), written);
        try {
            setMotion(scene, actor, name, *read.motion);
        } catch (const Error& error) {
            problem = error.what();
            // The table is what the user goes on with: it must stand there, with nothing in it.
            const Skeleton skeleton = meantActor(scene, &workspace.compiled, workspace.selection)->skeleton;
            editRig(scene, actor, [&](ActorRig& rig) {
                rig.motion = name;
                rig.motionMap.clear();
                for (const Joint& joint : skeleton.joints) rig.motionMap[joint.name] = "";
            });
        }
        // Before the step ends: it is compiled with it.
        workspace.assets.motions[name] = read.motion;
    });
    for (const std::string& warning : read.warnings) workspace.notify(Notice::Kind::Warning, warning);
    selectTarget(workspace, actor);
    if (problem.empty()) {
        workspace.notify(Notice::Kind::Info, "Motion " + name + ": " + std::to_string(read.motion->frames) + " frames");
        return;
    }
    std::vector<std::string> joints;
    for (const MotionJoint& joint : read.motion->joints) joints.push_back(joint.name);
    workspace.actors.showTable = true;
    workspace.notify(Notice::Kind::Warning, "No joint of " + name + " (" + someNames(joints) +
                                                ") is called as one of the actor's. Choose which drives which in "
                                                "Inspector ▸ Motion ▸ Joints.");
}

}  // namespace voledit
