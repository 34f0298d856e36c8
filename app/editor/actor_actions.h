#pragma once
// The named actions of actors: rigging, motions, modes, poses, joints.

#include <functional>
#include <string>
#include <vector>

#include "app/editor/background.h"
#include "app/editor/tools/actor_view.h"
#include "app/editor/tools/viewport_tools.h"
#include "app/editor/workspace.h"
#include "core/scene/actor_edits.h"

namespace voledit {

/// Adds actor.rig, actor.import-motion, actor.clear-motion, actor.mode, rig.edit, rig.fit, view.regions, view.coverage.
/// Long work goes to `background`; `importMotion(path)` reads a motion file and lets it drive the actor, asking for one
/// where the path is empty. All outlive `actions`.
void addActorActions(Actions& actions, Workspace& workspace, Background& background,
                     const std::function<void(const std::string&)>& importMotion);

/// Adds joint.select, joint.rotate, joint.move, joint.disjoint, joint.clear-rotation, tool.rotate, pose.copy,
/// pose.paste, pose.paste-mirrored, pose.mirror, pose.clear, pose.save, pose.apply, pose.delete.
void addPoseActions(Actions& actions, Workspace& workspace, ViewportTools& tools);

/// The actor that an action means (tools/actor_view.h). Throws Error, which names the action, where there is none.
ActorPtr needActor(const Workspace& workspace, const std::string& action);
bool hasActor(const Workspace& workspace);
/// Its selected joints.
std::vector<int> selectedJoints(const Workspace& workspace, const CompiledActor& actor);
/// Selects the actor, if it is not, with the joints that it has selected.
void selectActor(Workspace& workspace, const CompiledActor& actor);
/// "connected", "disjoint" or, without an actor, "": what actor.mode has been given.
std::string actorMode(const Workspace& workspace);

/// `scene` with actor `path` in its rest pose: without motion, and no joint with a rotation or displacement of its own.
Scene atRest(Scene scene, const NodePath& path);

}  // namespace voledit
