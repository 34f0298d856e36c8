#pragma once
// The scene's actors as the viewport shows them: where their joints stand, which is meant, which is under the pointer.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/selection.h"
#include "core/scene/compile.h"

namespace voledit {

using ActorPtr = std::shared_ptr<const CompiledActor>;

/// The actor that tools, panels and actions work on: the selected one; where no node is selected, the first. Null where
/// another node is selected, and where there is none.
ActorPtr activeActor(const Scene& scene, const CompiledScene* compiled, const Selection& selection);
/// The same, and where another node is selected the only one that the scene has.
ActorPtr meantActor(const Scene& scene, const CompiledScene* compiled, const Selection& selection);

/// World from the actor's skeleton space.
Mat4 worldFromSkeleton(const CompiledActor& actor);
/// Where joint `joint` is shown, world units.
Vec3 shownJoint(const CompiledActor& actor, int joint);
/// A joint's own axes as shown: unit columns, world space.
Mat3 shownAxes(const CompiledActor& actor, int joint);

/// A joint of an actor; -1 is none.
struct JointRef {
    ActorPtr actor;
    int joint = -1;
    explicit operator bool() const { return joint >= 0; }
};
/// NAME of the meant actor (of any other where that has none), or ACTOR/NAME. Throws Error that says what there is.
JointRef jointNamed(const Scene& scene, const CompiledScene* compiled, const Selection& selection,
                    const std::string& name);

/// What lies under the pointer: a joint, or the bone that begins at it.
struct JointHit {
    JointRef of;
    int to = -1;  // of a bone: where it ends; -1: the joint itself
    Vec3 at{0};   // the point that was hit, world units
    bool operator==(const JointHit& other) const {
        return of.actor == other.of.actor && of.joint == other.of.joint && to == other.to;
    }
};
/// The joint nearest to pixel `at` and no further than `radius` pixels; else the bone (limb) so near that is the
/// nearest. Of several as near (within a pixel) the one in front.
std::optional<JointHit> jointAt(const CompiledScene& compiled, const Camera& camera, Index2 size, const Vec2& at,
                                double radius);

/// Indices of the selected joints that `actor` has, in the order of the selection.
std::vector<int> selectedJoints(const Scene& scene, const CompiledActor& actor, const Selection& selection);
/// Limbs that begin at `joint`.
std::vector<int> limbsFrom(const CompiledActor& actor, int joint);
/// The limbs that `joint` is edited by: those that begin at it, else the one that ends there.
std::vector<int> editedLimbs(const CompiledActor& actor, int joint);

}  // namespace voledit
