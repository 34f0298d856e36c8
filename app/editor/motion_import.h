#pragma once
// Motions of files into the scene: reading them, and letting them drive an actor.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/editor/workspace.h"
#include "core/io/io_client.h"

namespace voledit {

/// A motion as read from a file.
struct ReadMotion {
    std::filesystem::path path;
    std::shared_ptr<const Motion> motion;
    std::vector<std::string> warnings;
};

/// Reads a motion of any format. Throws Error, Cancelled.
ReadMotion readMotionFile(IoClient& io, const std::filesystem::path& path, Progress* progress);

/// Adds the motion as an asset (or takes the asset that is that file already) and lets it drive the active actor, as
/// one step. Where no joint of both is called alike, every joint keeps its rest, and a notice points to the table.
/// Throws Error where there is no actor.
void takeMotion(Workspace& workspace, const ReadMotion& read);

/// Lets a motion asset that is there already drive the actor at `actor`, as one step; the same where nothing matches.
void driveByAsset(Workspace& workspace, const NodePath& actor, const std::string& asset);

/// The actor that a motion goes to. Throws Error where there is none, or several and none is selected.
NodePath actorForMotion(const Workspace& workspace);

}  // namespace voledit
