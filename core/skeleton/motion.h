#pragma once
// Motions: a hierarchy and what its channels say at each frame, as BVH files hold them.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace voledit {

enum class MotionChannel : std::uint8_t { Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation };

struct MotionJoint {
    std::string name;  // an end site is PARENT_End
    int parent = Joint::kNoParent;
    Vec3 offset{0};                       // the file's units and axes
    std::vector<MotionChannel> channels;  // in the file's order, the first rotation outermost
    bool endSite = false;
    bool operator==(const MotionJoint&) const = default;
};

/// Immutable once read; shared. Values are what the file says: degrees, the file's units, no axes changed.
struct Motion {
    std::vector<MotionJoint> joints;  // parents before children, in the file's order; names are unique
    double frameTime = 1.0 / 30;      // seconds, > 0
    std::size_t frames = 0;
    std::vector<double> values;  // frames × channelCount(), the joints' channels in order; finite

    std::size_t channelCount() const;
    double duration() const { return frames > 1 ? double(frames - 1) * frameTime : 0; }  // seconds
    bool operator==(const Motion&) const = default;
};

/// The rest pose: the sums of OFFSETs. Joints have the same indices as in the motion.
Skeleton skeletonOf(const Motion& motion);

/// The pose of frame `frame`, relative to `skeletonOf(motion)`: rotations multiplied in channel order, the first listed
/// outermost; a root's position channels replace its OFFSET, those of a joint below add to it (scene-format.md §2).
Pose poseOfFrame(const Motion& motion, std::size_t frame);
/// The pose at t seconds, held at the ends, slerped between frames.
Pose poseAt(const Motion& motion, double t);

/// How a motion drives another skeleton.
struct MotionMap {
    std::map<std::string, std::string> joints;  // joint of the skeleton → joint of the motion; the others keep rest
    Mat4 skeletonFromMotion{1.0};               // axes, unit and place: similarity
    bool inPlace = false;  // the root stays over its place (no travel across the up-axis, which is `up`)
    int up = 2;            // skeleton space: 0, 1, 2
};

/// The pose of `skeleton` at t seconds of `motion`. With A the rotation of skeletonFromMotion, R(t) the global rotation
/// of the mapped motion joint: a mapped joint's global rotation is A·R(t)·A⁻¹·N, where N carries the skeleton's rest
/// bone onto the direction of the motion's rest bone (the shortest arc between the directions to the mapped joint
/// below), so that bones point as in the motion. N is the identity where they agree, where there is no mapped joint
/// below, for hubs, where there are several, and for trunk, head, collars and feet, which every rest pose holds alike.
/// Unmapped joints keep their rest rotation relative to the parent. A root (the topmost mapped joint of its tree, if
/// there is one) moves to skeletonFromMotion·x(t), also where N is not the identity. Position channels below the root
/// count where the bone above is the motion's own (same vector after A), else bones keep their length. Names that are
/// in neither are passed over. Where skeleton is skeletonOf(motion), all names are mapped to themselves and
/// skeletonFromMotion is the identity, this is poseAt(motion, t), to rounding.
///
/// Two refinements: a skeletonFromMotion that turns the body otherwise than `proposedMotionFit` does turns all of it
/// (bones are compared after that turn); and for motions whose rest pose is no posture at all (every bone along one
/// axis), the frame in which the body stands most like the skeleton takes the rest pose's part.
/// Throws Error where skeletonFromMotion has no inverse.
Pose retargeted(const Skeleton& skeleton, const Motion& motion, const MotionMap& map, double t);

/// Joints that mean the same, by name: equal ones; else by the usual words of BVH, MakeHuman, CMU, Mixamo and FBX rigs
/// for hips, spine, chest, neck, head, collar, (upper) arm, forearm, hand, (upper) leg, shin, foot, toe and left/right
/// ("LeftUpLeg", "UpLeg_L", "lThigh", "upperleg01.L", "LeftHip" above "LeftKnee" …); where several chain joints stand
/// for one (Spine1, Spine2 …), in order along the chain. Every motion joint is used at most once. Empty where nothing
/// matches.
std::map<std::string, std::string> matchingJoints(const Skeleton& skeleton, const Motion& motion);

/// A similarity that lays the motion into the skeleton's space: turns the motion's up to the skeleton's and its left to
/// the skeleton's left (by the places of all mapped joints at rest; axes to axes where they nearly are), scales by the
/// ratio of the legs' lengths (of all mapped bones where no legs are known), so that feet do not slide, and places the
/// motion's first frame so that the skeleton's root stands over its rest place and its lowest mapped joint as high as
/// at rest. Throws Error where fewer than two joints are mapped.
Mat4 proposedMotionFit(const Skeleton& skeleton, const Motion& motion,
                       const std::map<std::string, std::string>& joints);

/// The axis (0, 1, 2) along which a skeleton's rest pose is upright, and the sign of up.
struct UpAxis {
    int axis = 2;
    double sign = 1;
    bool operator==(const UpAxis&) const = default;
};
UpAxis upOf(const Skeleton& skeleton);

}  // namespace voledit
