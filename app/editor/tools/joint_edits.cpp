#include "app/editor/tools/joint_edits.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/scene/scene_values.h"
#include "core/skeleton/ik.h"

namespace voledit {

namespace {

/// Whether two rotations turn alike (q and −q do).
bool same(const Quat& a, const Quat& b) {
    return std::abs(glm::dot(a, b)) > 1 - 1e-14;
}

bool namesHandOrFoot(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    // Their tips ("LeftHand_End") and fingers are none.
    if (name.ends_with("_end")) return false;
    for (const char* word : {"hand", "foot", "wrist", "ankle"})
        if (name.ends_with(word) || name.starts_with(word) || name.find(std::string(word) + ".") != name.npos ||
            name.find(std::string(word) + "_") != name.npos)
            return true;
    return false;
}

bool isBelow(const Skeleton& skeleton, int joint, int ancestor) {
    for (int j = skeleton.joints[std::size_t(joint)].parent; j != Joint::kNoParent;
         j = skeleton.joints[std::size_t(j)].parent)
        if (j == ancestor) return true;
    return false;
}

/// Rotation of joint `joint`'s parent in skeleton space.
Quat parentRotation(const CompiledActor& actor, const std::vector<PosedJoint>& posed, int joint) {
    const int parent = actor.skeleton.joints[std::size_t(joint)].parent;
    return parent == Joint::kNoParent ? Quat(1, 0, 0, 0) : glm::quat_cast(posed[std::size_t(parent)].linear);
}

}  // namespace

int usualChain(const Skeleton& skeleton, int joint) {
    if (namesHandOrFoot(skeleton.joints[std::size_t(joint)].name)) return 2;
    int bones = 0;
    for (int j = skeleton.joints[std::size_t(joint)].parent; j != Joint::kNoParent;
         j = skeleton.joints[std::size_t(j)].parent) {
        if (skeleton.childrenOf(j).size() > 1) break;
        ++bones;
    }
    return std::max(1, bones);
}

Vec3 skeletonPoint(const CompiledActor& actor, const Vec3& at) {
    return transformPoint(glm::inverse(worldFromSkeleton(actor)), at);
}

Pose reached(const CompiledActor& actor, int joint, const Vec3& target, int chain) {
    const Vec3 to = skeletonPoint(actor, target);
    const Joint& moved = actor.skeleton.joints[std::size_t(joint)];
    if (moved.parent != Joint::kNoParent) return solved(actor.skeleton, actor.pose, {joint, to, chain, std::nullopt});
    Pose pose = actor.pose;
    pose.translate[std::size_t(joint)] = to - moved.at;
    return pose;
}

Pose pointed(const CompiledActor& actor, int to, const Vec3& target) {
    const auto posed = posedJoints(actor.skeleton, actor.pose);
    const int from = actor.skeleton.joints[std::size_t(to)].parent;
    if (from == Joint::kNoParent) return actor.pose;
    const Vec3 base = posed[std::size_t(from)].position, aim = skeletonPoint(actor, target) - base;
    const double length = glm::distance(posed[std::size_t(to)].position, base);
    if (!(glm::length(aim) > 1e-9 * length) || length == 0) return actor.pose;
    return solved(actor.skeleton, actor.pose, {to, base + glm::normalize(aim) * length, 1, std::nullopt});
}

Pose turned(const CompiledActor& actor, const std::vector<int>& joints, const TurnAxis& axis, double degrees) {
    const auto posed = posedJoints(actor.skeleton, actor.pose);
    const Mat3 world(worldFromSkeleton(actor));
    const double angle = degrees * kPi / 180;
    // A skeleton laid in by a mirror turns the other way round.
    const double sense = glm::determinant(world) < 0 ? -1 : 1;
    const Vec3 about = glm::normalize(glm::inverse(world) * axis.world);
    Pose pose = actor.pose;
    for (const int joint : joints) {
        const bool goesAlong =
            std::any_of(joints.begin(), joints.end(), [&](int other) { return isBelow(actor.skeleton, joint, other); });
        if (goesAlong) continue;
        Quat& local = pose.rotate[std::size_t(joint)];
        if (axis.local) {
            Vec3 own(0);
            own[*axis.local] = 1;
            local = local * glm::angleAxis(sense * angle, own);
        } else {
            const Quat parent = parentRotation(actor, posed, joint);
            local = glm::inverse(parent) * glm::angleAxis(sense * angle, about) * parent * local;
        }
        if (const auto& limits = actor.skeleton.joints[std::size_t(joint)].limits) local = limited(local, *limits);
        local = glm::normalize(local);
    }
    return pose;
}

Quat ownRotation(const CompiledActor& actor, const Pose& pose, int joint) {
    const auto j = std::size_t(joint);
    return glm::normalize(glm::inverse(actor.motionPose.rotate[j]) * pose.rotate[j]);
}

void setPose(Scene& scene, const CompiledActor& actor, const Pose& pose, const When& when) {
    for (std::size_t j = 0; j < actor.skeleton.joints.size(); ++j) {
        const std::string& name = actor.skeleton.joints[j].name;
        if (!same(pose.rotate[j], actor.pose.rotate[j]))
            setJointRotation(scene, actor.path, name, ownRotation(actor, pose, int(j)), when);
        if (pose.translate[j] != actor.pose.translate[j]) {
            // In the parent's axes, as the motion's.
            const Vec3 own = pose.translate[j] - actor.motionPose.translate[j];
            setJointTranslation(scene, actor.path, name, own, when);
        }
    }
}

}  // namespace voledit
