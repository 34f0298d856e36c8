#pragma once
// Edits of actors: skeletons, limbs, motions, poses. `actor` is a path at which an actor stands, or a `use` of one; all
// throw Error where there is none, and change nothing where they throw.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/rigging/rig.h"
#include "core/scene/compile.h"
#include "core/scene/nodes.h"
#include "core/scene/when.h"

namespace voledit {

/// The actor at `path`, `use` followed; null where none stands there.
const ActorObject* findActorAt(const Scene& scene, const NodePath& path);
/// Paths of all actors, in the order of the tree.
std::vector<NodePath> actorPaths(const Scene& scene);

/// Makes the object at `object` (the root, or any other) an actor's operand: the actor stands in its place, called
/// `name` (made unique among actors), with the rig's joints (in the object's space: fit is the identity) and limbs.
/// Returns its path.
NodePath addActor(Scene& scene, const NodePath& object, const std::string& name, const Rig& rig);
/// Adds asset `name` (made unique) of kind motion; returns the name.
std::string addMotionAsset(Scene& scene, const std::string& name, const std::string& path);
/// Lets a motion drive the actor: matches joints by names, proposes `motionFit` (none for the skeleton's own motion,
/// nor where the skeleton is another motion's, which is not known here), and lengthens the timeline to hold the motion
/// (`fps` of the timeline kept; a scene without any keys or motions gets the motion's rate, up to 60, and its length).
/// Throws Error, naming some joints of both, where nothing matches.
void setMotion(Scene& scene, const NodePath& actor, const std::string& asset, const Motion& motion);
void clearMotion(Scene& scene, const NodePath& actor);
/// Sets (or, with "", removes) the motion's joint for a joint. The first call writes the matched table out, with "" for
/// joints that nothing drives; a fit is proposed as soon as enough joints are mapped, where there is none.
void setMotionJoint(Scene& scene, const NodePath& actor, const std::string& joint, const std::string& motionJoint,
                    const Motion& motion);

/// The joint's own rotation (on top of the motion).
void setJointRotation(Scene& scene, const NodePath& actor, const std::string& joint, const Quat& rotation,
                      const When& when);
void setJointTranslation(Scene& scene, const NodePath& actor, const std::string& joint, const Vec3& translation,
                         const When& when);
/// Moves a joint's rest position (skeleton space); children stay. Only for skeletons of `joints`.
void setJointAt(Scene& scene, const NodePath& actor, const std::string& joint, const Vec3& at);
void setJointLimits(Scene& scene, const NodePath& actor, const std::string& joint,
                    const std::optional<JointLimits>& limits);
/// Changes a limb (found by name) by `change`; limbs left out are written out first.
void editLimb(Scene& scene, const NodePath& actor, const std::string& limb,
              const std::function<void(SceneLimb&)>& change, const CompiledActor& compiled);
/// Replaces sizes, offsets and pads of the limbs by fitted ones (found by name). Limbs that are left out are written
/// out first, but for a motion's skeleton, whose joints are not known here: those stay left out, hence fitted.
void setFittedLimbs(Scene& scene, const NodePath& actor, const std::vector<Limb>& limbs);
/// Changes cells, miter limit, modes … of the rig.
void editRig(Scene& scene, const NodePath& actor, const std::function<void(ActorRig&)>& change);

/// The joints' own rotations at t, those that are not the identity; and back: all others become the identity. Where
/// `when` makes keys, every joint gets one, so that poses at several times do not run into each other.
NamedPose poseOf(const Scene& scene, const NodePath& actor, double t);
void applyPose(Scene& scene, const NodePath& actor, const NamedPose& pose, const When& when);
/// The pose in a mirror (core/skeleton/skeleton.h) across the axis along which partners stand apart.
NamedPose mirroredPose(const CompiledActor& actor, const NamedPose& pose);
void savePose(Scene& scene, const NodePath& actor, const std::string& name, const NamedPose& pose);
void removePose(Scene& scene, const NodePath& actor, const std::string& name);

}  // namespace voledit
