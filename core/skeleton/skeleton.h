#pragma once
// Skeletons: joints in a rest pose, poses of them, and where a pose carries the joints (definitions.md §6.3).

#include <optional>
#include <string>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// How far a joint may turn: its local rotation as degrees about x, y and z (R_z·R_y·R_x), each within [min, max].
struct JointLimits {
    Vec3 min{-180}, max{180};
    bool operator==(const JointLimits&) const = default;
};

struct Joint {
    static constexpr int kNoParent = -1;
    std::string name;
    int parent = kNoParent;  // index of an earlier joint
    Vec3 at{0};              // rest position, skeleton space
    std::optional<JointLimits> limits;
    bool operator==(const Joint&) const = default;
};

/// A tree (or several) of joints; parents stand before their children. In the rest pose every joint's axes are those of
/// skeleton space.
struct Skeleton {
    std::vector<Joint> joints;

    /// Index of the joint `name`; -1 where there is none.
    int find(const std::string& name) const;
    /// Indices of the joints whose parent is `joint` (kNoParent: the roots), ascending.
    std::vector<int> childrenOf(int joint) const;
    bool operator==(const Skeleton&) const = default;
};

/// Brings joints into an order in which parents stand before children, otherwise as they were. Throws Error, naming the
/// joint, for names given twice or empty, parents that are missing, circles, positions that are not finite, limits
/// that leave no angle, and more joints than `kMostJoints`. `parents[i]` is the name of joint i's parent, "" for none.
inline constexpr std::size_t kMostJoints = 10'000;
Skeleton makeSkeleton(std::vector<Joint> joints, const std::vector<std::string>& parents);

/// A pose: for each joint its rotation and displacement from rest, both relative to its parent (in the parent's turned
/// axes; a root's in skeleton space).
struct Pose {
    std::vector<Quat> rotate;     // unit quaternions
    std::vector<Vec3> translate;  // skeleton units; 0 keeps the bone as it is
    bool operator==(const Pose&) const = default;
};
Pose restPose(const Skeleton& skeleton);

/// Where a joint is: maps its rest neighbourhood by q ↦ position + linear·(q − rest position).
struct PosedJoint {
    Mat3 linear{1.0};  // a rotation, but for skeletons laid into objects by scales that differ along the axes
    Vec3 position{0};
};

/// Forward kinematics, in skeleton space: R_j = R_parent·rotate_j, x_j = x_parent + R_parent·(at_j − at_parent +
/// translate_j); roots x_j = at_j + translate_j. One for each joint.
std::vector<PosedJoint> posedJoints(const Skeleton& skeleton, const Pose& pose);

/// The same joints after `objectFromSkeleton` (affine; its linear part L must be invertible): x ↦ L x + t,
/// linear ↦ L·linear·L⁻¹.
std::vector<PosedJoint> laidInto(const std::vector<PosedJoint>& joints, const Mat4& objectFromSkeleton);
/// The skeleton with its rest positions moved so.
Skeleton laidInto(const Skeleton& skeleton, const Mat4& objectFromSkeleton);

/// Interpolates pose a (s = 0) to b (s = 1): rotations by slerp along the shortest path, translations linearly.
Pose interpolated(const Pose& a, const Pose& b, double s);

/// Rotation a (s = 0) to b (s = 1), both unit, along the shortest path; a itself where they are equal.
Quat slerped(const Quat& a, const Quat& b, double s);

/// Rotation from degrees about x, y, z (R_z·R_y·R_x, as `place`), and back: components in [−180, 180], y in [−90, 90].
Quat quatOfDegrees(const Vec3& degrees);
Vec3 degreesOf(const Quat& rotation);
/// The shortest rotation that carries direction a to b (neither 0; opposite ones: about an axis across a).
Quat shortestArc(const Vec3& a, const Vec3& b);

/// The pose seen in a mirror: joints swap with their partners (`mirrorPartner`), rotations and translations are
/// reflected across the plane through the skeleton's middle with normal `axis` (0, 1, 2: skeleton x, y, z).
Pose mirrored(const Skeleton& skeleton, const Pose& pose, int axis = 0);
/// The joint on the other side by name: left/right, L/R, l_/r_, .L/.R … in any case; itself where there is none.
int mirrorPartner(const Skeleton& skeleton, int joint);

}  // namespace voledit
