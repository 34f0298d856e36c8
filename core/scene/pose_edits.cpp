// Edits of joints and poses (actor_edits.h).
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/actor_edits.h"
#include "core/scene/json_schema.h"

namespace voledit {

namespace {

const ActorObject& actorAt(const Scene& scene, const NodePath& path) {
    const ActorObject* actor = findActorAt(scene, path);
    if (!actor) throw Error(path, "there is no actor", "it may have been removed");
    return *actor;
}

SceneJoint* findJoint(SceneSkeleton& skeleton, const std::string& name) {
    const auto joint = std::find_if(skeleton.joints.begin(), skeleton.joints.end(),
                                    [&](const SceneJoint& each) { return each.name == name; });
    return joint == skeleton.joints.end() ? nullptr : &*joint;
}

/// Joint `name`; a motion's skeleton lists only those with something of their own, so others are added.
SceneJoint& jointOf(SceneSkeleton& skeleton, const NodePath& actor, const std::string& name) {
    if (SceneJoint* joint = findJoint(skeleton, name)) return *joint;
    if (skeleton.motion.empty()) {
        std::vector<std::string> names;
        for (const SceneJoint& joint : skeleton.joints) names.push_back(joint.name);
        const std::string nearest = nearestName(name, names);
        throw Error(actor, "it has no joint \"" + name + "\"",
                    nearest.empty() ? "it may have been removed" : "did you mean \"" + nearest + "\"?");
    }
    SceneJoint added;
    added.name = name;
    skeleton.joints.push_back(std::move(added));
    return skeleton.joints.back();
}

/// A motion's skeleton does not list joints that have nothing of their own.
void removeIdle(SceneSkeleton& skeleton) {
    if (skeleton.motion.empty()) return;
    std::erase_if(skeleton.joints, [](const SceneJoint& joint) {
        SceneJoint idle;
        idle.name = joint.name;
        return joint == idle;
    });
}

void editJoint(Scene& scene, const NodePath& actor, const std::string& name,
               const std::function<void(SceneJoint&)>& change) {
    editRig(scene, actor, [&](ActorRig& rig) {
        change(jointOf(rig.skeleton, actor, name));
        removeIdle(rig.skeleton);
    });
}

/// The axis along which joints and their partners on the other side stand apart; x where none have any.
int axisBetweenSides(const Skeleton& skeleton) {
    Vec3 apart(0);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const auto partner = std::size_t(mirrorPartner(skeleton, int(j)));
        for (int a = 0; a < 3; ++a) apart[a] += std::abs(skeleton.joints[j].at[a] - skeleton.joints[partner].at[a]);
    }
    int axis = 0;
    for (int a = 1; a < 3; ++a)
        if (apart[a] > apart[axis]) axis = a;
    return axis;
}

}  // namespace

void setJointRotation(Scene& scene, const NodePath& actor, const std::string& joint, const Quat& rotation,
                      const When& when) {
    editJoint(scene, actor, joint,
              [&](SceneJoint& edited) { setWhen(edited.rotate, Rotation{degreesOf(rotation)}, when); });
}

void setJointTranslation(Scene& scene, const NodePath& actor, const std::string& joint, const Vec3& translation,
                         const When& when) {
    editJoint(scene, actor, joint, [&](SceneJoint& edited) { setWhen(edited.translate, translation, when); });
}

void setJointAt(Scene& scene, const NodePath& actor, const std::string& joint, const Vec3& at) {
    if (!actorAt(scene, actor).rig.skeleton.motion.empty())
        throw Error(actor, "its joints rest where its motion says", "move its `fit`, or give it joints of its own");
    editJoint(scene, actor, joint, [&](SceneJoint& edited) { edited.at = at; });
}

void setJointLimits(Scene& scene, const NodePath& actor, const std::string& joint,
                    const std::optional<JointLimits>& limits) {
    for (int a = 0; limits && a < 3; ++a)
        if (!(limits->min[a] <= limits->max[a]))
            throw Error(actor,
                        std::string("the limits about ") + "xyz"[a] + " of joint \"" + joint + "\" leave no angle",
                        "give a min that is at most max, in degrees");
    editJoint(scene, actor, joint, [&](SceneJoint& edited) { edited.limits = limits; });
}

NamedPose poseOf(const Scene& scene, const NodePath& actor, double t) {
    NamedPose pose;
    for (const SceneJoint& joint : actorAt(scene, actor).rig.skeleton.joints)
        if (const Vec3 degrees = joint.rotate.at(t).degrees; degrees != Vec3(0)) pose[joint.name] = degrees;
    return pose;
}

void applyPose(Scene& scene, const NodePath& actor, const NamedPose& pose, const When& when) {
    editRig(scene, actor, [&](ActorRig& rig) {
        for (const auto& [name, degrees] : pose) jointOf(rig.skeleton, actor, name);
        for (SceneJoint& joint : rig.skeleton.joints) {
            const auto found = pose.find(joint.name);
            const Vec3 degrees = found == pose.end() ? Vec3(0) : found->second;
            setWhen(joint.rotate, Rotation{degrees}, when);
        }
        removeIdle(rig.skeleton);
    });
}

NamedPose mirroredPose(const CompiledActor& actor, const NamedPose& pose) {
    Pose full = restPose(actor.skeleton);
    for (const auto& [name, degrees] : pose)
        if (const int joint = actor.skeleton.find(name); joint >= 0)
            full.rotate[std::size_t(joint)] = quatOfDegrees(degrees);
    const Pose reflected = mirrored(actor.skeleton, full, axisBetweenSides(actor.skeleton));
    NamedPose result;
    for (const auto& [name, degrees] : pose) {
        const int joint = actor.skeleton.find(name);
        if (joint < 0) continue;
        const int partner = mirrorPartner(actor.skeleton, joint);
        result[actor.skeleton.joints[std::size_t(partner)].name] = degreesOf(reflected.rotate[std::size_t(partner)]);
    }
    return result;
}

void savePose(Scene& scene, const NodePath& actor, const std::string& name, const NamedPose& pose) {
    if (name.empty()) throw Error(actor, "the pose has no name", "give it one");
    editRig(scene, actor, [&](ActorRig& rig) { rig.poses[name] = pose; });
}

void removePose(Scene& scene, const NodePath& actor, const std::string& name) {
    editRig(scene, actor, [&](ActorRig& rig) {
        if (rig.poses.erase(name) == 0)
            throw Error(actor, "it has no pose \"" + name + "\"", "it may have been removed");
    });
}

}  // namespace voledit
