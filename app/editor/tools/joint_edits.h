#pragma once
// From what is done to joints in the view to poses, and from poses to edits of the scene. Free of pointer and window.

#include <optional>
#include <string>
#include <vector>

#include "app/editor/tools/actor_view.h"
#include "core/scene/actor_edits.h"

namespace voledit {

/// How many bones above `joint` IK turns where the user has not said: two for hands and feet; else up to the joint
/// where the skeleton branches, at least one.
int usualChain(const Skeleton& skeleton, int joint);

/// The pose in which `joint` stands as near to `target` (world units) as bones and limits let it; a root moves there,
/// and with it all below. `chain`: bones that turn.
Pose reached(const CompiledActor& actor, int joint, const Vec3& target, int chain);
/// The pose in which the bone from its joint to `to` points towards `target` (world units).
Pose pointed(const CompiledActor& actor, int to, const Vec3& target);

/// What joints turn about.
struct TurnAxis {
    std::optional<int> local;  // 0, 1, 2: each joint's own x, y, z; nullopt: `world`
    Vec3 world{0, 0, 1};       // a direction, world space
};
/// The pose with `joints` turned about their own places by `degrees`, within their limits. A joint below another of
/// them goes along with that and turns no further.
Pose turned(const CompiledActor& actor, const std::vector<int>& joints, const TurnAxis& axis, double degrees);

/// Writes `pose` into the scene: own rotations and displacements of the joints that differ from the compiled pose (on
/// top of the motion).
void setPose(Scene& scene, const CompiledActor& actor, const Pose& pose, const When& when);
/// The joint's own rotation, on top of the motion, in `pose`.
Quat ownRotation(const CompiledActor& actor, const Pose& pose, int joint);

/// `at` (world units) in skeleton space.
Vec3 skeletonPoint(const CompiledActor& actor, const Vec3& at);

}  // namespace voledit
