#pragma once
// The rows of an actor (inspectors.h), in parts: its joints, its motion, its regions, its poses.

#include "app/editor/panels/inspection.h"
#include "app/editor/tools/actor_view.h"

namespace voledit {

/// The leading selected joint: rotation, limits, IK, place at rest while the rig is edited; and the regions that begin
/// at it.
void inspectJoint(Inspection& inspection, ActorRig& rig, const CompiledActor& actor, int joint);
/// Which motion drives the actor and how: joint by joint, where it is laid.
void inspectMotion(Inspection& inspection, ActorRig& rig, const CompiledActor& actor);
/// The library of poses.
void inspectPoses(Inspection& inspection, const ActorRig& rig);

}  // namespace voledit
