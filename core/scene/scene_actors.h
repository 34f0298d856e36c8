#pragma once
// Skeletons, limbs and how they move, as written in a file (scene-format.md §1: `actor`, `skeleton`).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene_fields.h"
#include "core/skeleton/skeleton.h"

namespace voledit {

/// Degrees about x, y, z, as `place` turns. A type of its own because its tracks are interpolated as quaternions, along
/// the shortest path.
struct Rotation {
    Vec3 degrees{0};
    bool operator==(const Rotation&) const = default;
};
std::vector<double> numbersOf(const Rotation& value);
void setNumbers(Rotation& value, std::span<const double> numbers);
/// `numbersAtTime` for rotations: a track of the whole gives the rotation between its keys by the shortest path,
/// *linear* by slerp, *smooth* by the Hermite curve of unit quaternions [Kim, Kim, Shin 1995] whose angular velocity at
/// a key is the mean over both segments (Catmull–Rom; C¹). At its keys it has their very numbers. Tracks of single
/// components are degrees and nothing else.
std::vector<double> numbersAtTime(const Rotation& value, const std::vector<PartTrack>& tracks, double t);

struct SceneJoint {
    std::string name;
    std::string parent;         // "" for null
    Tracked<Vec3> at{Vec3(0)};  // absolute, skeleton space
    Tracked<Rotation> rotate;
    Tracked<Vec3> translate{Vec3(0)};
    std::optional<JointLimits> limits;
    bool operator==(const SceneJoint&) const = default;
};

struct SceneLimb {
    std::string name, from, to;
    std::optional<Tracked<Vec2>> size;  // nullopt: fitted, with offset and pads
    Tracked<Vec2> offset{Vec2(0)};      // of the section's middle from the bone
    Tracked<double> roll = 0;           // degrees
    std::optional<Tracked<Vec2>> pad;   // nullopt: 0, or fitted with the size
    std::optional<ObjectRef> of;        // instead of the actor's
    bool operator==(const SceneLimb&) const = default;
};

/// `skeleton` of an actor: the rest pose of a motion, or joints.
struct SceneSkeleton {
    std::string motion;              // an asset; "" where there are joints
    std::vector<SceneJoint> joints;  // with `motion`: only those that have a rotate, translate or limits of their own
    Placement fit;                   // lays it into the object
    std::vector<SceneLimb> limbs;    // empty: one for each bone that has a length
    bool operator==(const SceneSkeleton&) const = default;
};

/// A pose of a library: rotations of joints, degrees.
using NamedPose = std::map<std::string, Vec3>;

/// What an actor and a `skeleton` STF share.
struct ActorRig {
    SceneSkeleton skeleton;
    std::string motion;  // an asset; "" for none. Joints' own rotations are applied on top (before it, in rest axes)
    std::map<std::string, std::string> motionMap;  // joint → motion's joint ("": none); the others: by names
    std::optional<Placement> motionFit;            // skeleton space from the motion's; nullopt: the identity
    bool inPlace = false;
    bool allDisjoint = false;           // `mode`
    std::vector<std::string> disjoint;  // joints
    Index3 cells{6, 6, 8};              // of a limb
    double miterLimit = 2;
    bool smooth = true;
    bool preserveVolume = false;
    std::map<std::string, NamedPose> poses;  // the pose library
    bool operator==(const ActorRig&) const = default;
};

/// `actor`: what its limbs' regions move of an object.
struct ActorObject {
    std::string name;
    ActorRig rig;
    ObjectRef of;
    bool operator==(const ActorObject&) const = default;
};

/// `skeleton`: the STF of one limb.
struct SkeletonTransfer {
    ActorRig rig;
    std::string limb;
    bool operator==(const SkeletonTransfer&) const = default;
};

}  // namespace voledit
