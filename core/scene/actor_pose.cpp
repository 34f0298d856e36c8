#include "core/scene/actor_pose.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/json_schema.h"
#include "core/scene/json_text.h"

namespace voledit {

namespace {

std::vector<std::string> namesOf(const Skeleton& skeleton) {
    std::vector<std::string> names;
    for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
    return names;
}

std::vector<std::string> namesOf(const Motion& motion) {
    std::vector<std::string> names;
    for (const MotionJoint& joint : motion.joints) names.push_back(joint.name);
    return names;
}

/// The first few of `names`, for messages.
std::string someOf(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t n = 0; n < names.size() && n < 4; ++n) list += (n ? ", " : "") + abridged(names[n]);
    return list + (names.size() > 4 ? ", …" : "");
}

std::string didYouMean(const std::string& name, const std::vector<std::string>& known) {
    const std::string nearest = nearestName(name, known);
    return nearest.empty() ? "name one of " + someOf(known) : "did you mean \"" + nearest + "\"?";
}

/// Whether the rig plays its skeleton's own motion as it is.
bool playsItsOwn(const ActorRig& rig) {
    return rig.motion == rig.skeleton.motion && rig.motionMap.empty() && !rig.motionFit && !rig.inPlace;
}

}  // namespace

std::shared_ptr<const Motion> motionOf(const LoadedAssets& assets, const std::string& name) {
    const auto found = assets.motions.find(name);
    if (found == assets.motions.end() || !found->second)
        throw Error("motion \"" + abridged(name) + "\"", "it is not loaded", "check the asset's path");
    return found->second;
}

int jointIn(const Skeleton& skeleton, const std::string& name, const std::string& what) {
    const int joint = skeleton.find(name);
    if (joint < 0)
        throw Error(what, "the skeleton has no joint \"" + abridged(name) + "\"", didYouMean(name, namesOf(skeleton)));
    return joint;
}

Skeleton skeletonOf(const SceneSkeleton& skeleton, const LoadedAssets& assets) {
    if (!skeleton.motion.empty()) {
        Skeleton result = skeletonOf(*motionOf(assets, skeleton.motion));
        for (const SceneJoint& own : skeleton.joints)
            result.joints[std::size_t(jointIn(result, own.name, "skeleton.pose"))].limits = own.limits;
        return result;
    }
    std::vector<Joint> joints;
    std::vector<std::string> parents;
    for (const SceneJoint& joint : skeleton.joints) {
        joints.push_back({joint.name, Joint::kNoParent, joint.at, joint.limits});
        parents.push_back(joint.parent);
    }
    return makeSkeleton(std::move(joints), parents);
}

std::vector<SceneLimb> limbsOf(const SceneSkeleton& skeleton, const Skeleton& rest) {
    if (!skeleton.limbs.empty()) return skeleton.limbs;
    std::vector<int> bones(rest.joints.size());  // that begin at each joint
    const auto hasLength = [&](const Joint& joint) {
        return joint.parent != Joint::kNoParent && joint.at != rest.joints[std::size_t(joint.parent)].at;
    };
    for (const Joint& joint : rest.joints)
        if (hasLength(joint)) ++bones[std::size_t(joint.parent)];
    std::vector<SceneLimb> limbs;
    for (const Joint& joint : rest.joints) {
        if (!hasLength(joint)) continue;
        SceneLimb limb;
        limb.from = rest.joints[std::size_t(joint.parent)].name;
        limb.to = joint.name;
        limb.name = bones[std::size_t(joint.parent)] == 1 ? limb.from : limb.from + " " + limb.to;
        limbs.push_back(std::move(limb));
    }
    if (limbs.empty())
        throw Error("skeleton", "it has no bone with a length", "give it two joints or more, apart from one another");
    return limbs;
}

std::map<std::string, std::string> jointTable(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion) {
    const std::vector<std::string> known = namesOf(motion);
    const std::set<std::string> ofMotion(known.begin(), known.end());
    std::map<std::string, std::string> result;
    std::set<std::string> taken;
    for (const auto& [joint, motionJoint] : rig.motionMap) {
        jointIn(skeleton, joint, "motionMap");
        if (motionJoint.empty()) continue;
        if (!ofMotion.contains(motionJoint))
            throw Error("motionMap", "the motion has no joint \"" + abridged(motionJoint) + "\"",
                        didYouMean(motionJoint, known));
        result[joint] = motionJoint;
        taken.insert(motionJoint);
    }
    for (const auto& [joint, motionJoint] : matchingJoints(skeleton, motion))
        if (!rig.motionMap.contains(joint) && !taken.contains(motionJoint)) result[joint] = motionJoint;
    return result;
}

std::map<std::string, std::string> mappedJoints(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion) {
    auto result = jointTable(rig, skeleton, motion);
    // A table that says of every joint that nothing drives it is one to be filled in.
    const bool said = std::all_of(skeleton.joints.begin(), skeleton.joints.end(),
                                  [&](const Joint& joint) { return rig.motionMap.contains(joint.name); });
    if (result.empty() && !said)
        throw Error("motion \"" + abridged(rig.motion) + "\"",
                    "none of its joints (" + someOf(namesOf(motion)) + ") matches one of the skeleton's (" +
                        someOf(namesOf(skeleton)) + ")",
                    "say which drives which in `motionMap`");
    return result;
}

Pose motionPoseOf(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion,
                  const std::map<std::string, std::string>& joints, double t) {
    if (playsItsOwn(rig)) return poseAt(motion, t);
    MotionMap map;
    map.joints = joints;
    if (rig.motionFit) map.skeletonFromMotion = worldFromRest(*rig.motionFit);
    map.inPlace = rig.inPlace;
    map.up = upOf(skeleton).axis;
    return retargeted(skeleton, motion, map, t);
}

Pose withOwnRotations(Pose pose, const SceneSkeleton& own, const Skeleton& skeleton) {
    std::unordered_map<std::string, std::size_t> index;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) index.emplace(skeleton.joints[j].name, j);
    for (const SceneJoint& joint : own.joints) {
        const auto found = index.find(joint.name);
        const std::size_t at =
            found != index.end() ? found->second : std::size_t(jointIn(skeleton, joint.name, "skeleton"));
        if (joint.rotate->degrees != Vec3(0)) pose.rotate[at] = pose.rotate[at] * quatOfDegrees(joint.rotate->degrees);
        pose.translate[at] += *joint.translate;
    }
    return pose;
}

}  // namespace voledit
