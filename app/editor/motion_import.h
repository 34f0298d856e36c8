#pragma once
// Motions of files into the scene: reading them, and letting them drive an actor.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/editor/workspace.h"
#include "core/io/io_client.h"

namespace voledit {

/// True if `path` is named as a file that holds nothing but motions: .bvh, .fbx, .dae; and .glb, .gltf where an actor
/// waits for one.
bool isMotionFile(const std::filesystem::path& path);

/// A motion as read from a file.
struct ReadMotion {
    std::filesystem::path path;
    std::shared_ptr<const Motion> motion;
    std::vector<std::string> warnings;
};

/// Adds the motion as an asset (or takes the asset that is that file already) and lets it drive the active actor, as
/// one step. Where no joint of both is called alike, every joint keeps its rest, and a notice points to the table.
/// Throws Error where there is no actor.
void takeMotion(Workspace& workspace, const ReadMotion& read);

/// The actor that a motion goes to. Throws Error where there is none, or several and none is selected.
NodePath actorForMotion(const Workspace& workspace);

}  // namespace voledit
