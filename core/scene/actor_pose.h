#pragma once
// What a rig says about joints: the skeleton, its limbs, and its pose at a time.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/compile.h"
#include "core/scene/scene_actors.h"
#include "core/skeleton/motion.h"

namespace voledit {

/// The motion asset `name`; throws Error where it is not loaded.
std::shared_ptr<const Motion> motionOf(const LoadedAssets& assets, const std::string& name);

/// The rig's rest pose with its limits, skeleton space: its joints, or those of its motion. Throws Error for joints
/// that make no skeleton, and for a `pose` of joints that the motion has not.
Skeleton skeletonOf(const SceneSkeleton& skeleton, const LoadedAssets& assets);

/// Index of joint `name`; throws Error, with a near name, where there is none. `what` names who asks.
int jointIn(const Skeleton& skeleton, const std::string& name, const std::string& what);

/// The limbs as written; where none are, one for each bone that has a length, called as the joint that it begins at, or
/// where several begin there "FROM TO". Throws Error where there is no such bone either.
std::vector<SceneLimb> limbsOf(const SceneSkeleton& skeleton, const Skeleton& rest);

/// Which joint of `motion` drives which of `skeleton`: the rig's `motionMap`, and for joints that it does not list
/// `matchingJoints`, of what is left. May be empty. Throws Error for names that the skeleton or the motion has not.
std::map<std::string, std::string> jointTable(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion);
/// The same; throws Error, naming some joints of both, where nothing matches, unless the table says of every joint that
/// nothing drives it.
std::map<std::string, std::string> mappedJoints(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion);

/// The pose of the rig's motion alone at t seconds, by `joints` (`mappedJoints`).
Pose motionPoseOf(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion,
                  const std::map<std::string, std::string>& joints, double t);

/// `pose` with the joints' own rotations and translations on top: local = motion's local · own.
Pose withOwnRotations(Pose pose, const SceneSkeleton& own, const Skeleton& skeleton);

}  // namespace voledit
