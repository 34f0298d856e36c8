#pragma once
// What the files of the joint tool share. For those alone.

#include <vector>

#include "app/editor/tools/actor_overlay.h"
#include "app/editor/tools/tool_context.h"

namespace voledit {

/// Whether rest positions and regions are dragged, not poses.
bool editsRig(const ToolContext& context);
/// The actor that drags without a joint under the pointer mean (actor_view.h).
ActorPtr activeActor(const ToolContext& context);
std::vector<int> selectedJoints(const ToolContext& context, const CompiledActor& actor);
ActorLook lookOf(const ToolContext& context, const CompiledActor& actor);
/// The joint that the rings are about; none while the rig is edited.
JointRef ringedJoint(const ToolContext& context);
/// The limbs whose faces have handles: of the leading selected joint, while the rig is edited.
std::vector<int> limbsWithHandles(const ToolContext& context, const CompiledActor& actor);
const std::string& nameOf(const CompiledActor& actor, int joint);

}  // namespace voledit
