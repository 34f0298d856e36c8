#include "core/scene/actor_edits.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "core/base/error.h"
#include "core/scene/actor_pose.h"
#include "core/scene/scene_at.h"
#include "core/scene/scene_walk.h"

namespace voledit {

namespace {

void editActor(Scene& scene, const NodePath& path, const std::function<void(ActorObject&)>& change) {
    const ActorObject* actor = findActorAt(scene, path);
    if (!actor) throw Error(path, "there is no actor", "it may have been removed");
    ActorObject changed = *actor;  // so that an Error leaves the scene as it was
    change(changed);
    editObjectAt(scene, followedUse(scene, path), [&](Object& object) { object.kind = std::move(changed); });
}

/// `wanted`, or it with a number behind, such that it is not one of `taken`.
std::string uniqueName(const std::set<std::string>& taken, const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; taken.contains(name); ++n) name = wanted + " " + std::to_string(n);
    return name;
}

/// The skeleton, where it can be known with nothing but `motion` (asset `asset`) loaded.
std::optional<Skeleton> knownSkeleton(const ActorRig& rig, const std::string& asset, const Motion& motion) {
    if (rig.skeleton.motion.empty()) return skeletonOf(rig.skeleton, LoadedAssets{});
    if (rig.skeleton.motion == asset) return skeletonOf(motion);
    return std::nullopt;
}

/// A similarity in the members that people edit; as a matrix where that loses something.
Placement placementOf(const Mat4& matrix) {
    const Mat3 linear(matrix);
    const double scale = std::cbrt(glm::determinant(linear));
    Placement placement;
    placement.translate = Vec3(matrix[3]);
    placement.scale = Vec3(scale);
    placement.rotate = degreesOf(glm::normalize(glm::quat_cast(linear / scale)));
    const Mat4 again = worldFromRest(placement);
    double difference = 0, size = 0;
    for (int c = 0; c < 4; ++c) {
        difference = std::max(difference, glm::length(again[c] - matrix[c]));
        size = std::max(size, glm::length(matrix[c]));
    }
    if (difference <= 1e-9 * size) return placement;
    placement = {};
    placement.matrix = matrix;
    return placement;
}

void proposeFit(ActorRig& rig, const Skeleton& skeleton, const Motion& motion,
                const std::map<std::string, std::string>& joints) {
    if (joints.size() >= 2) rig.motionFit = placementOf(proposedMotionFit(skeleton, motion, joints));
}

Timeline timelineFor(const Timeline& timeline, const Motion& motion, bool keepRate) {
    Timeline result = timeline;
    if (!keepRate) {
        const double rate = std::min(60.0, 1 / motion.frameTime);
        // Files say 0.033333 for a thirtieth.
        const double whole = std::max(1.0, std::round(rate));
        result.fps = std::abs(rate - whole) < 1e-3 * whole ? whole : rate;
    }
    const double frames = std::ceil(std::min(motion.duration() * result.fps, 1e9) - 1e-3) + 1;  // the last one too
    result.end = std::max({result.start + 1, int(frames), keepRate ? timeline.end : 0});
    return result;
}

SceneLimb sceneLimbOf(const Limb& limb, const Skeleton& skeleton) {
    SceneLimb result;
    result.name = limb.name;
    result.from = skeleton.joints[std::size_t(limb.from)].name;
    result.to = skeleton.joints[std::size_t(limb.to)].name;
    result.roll = glm::degrees(limb.roll);
    return result;
}

void setExtent(SceneLimb& written, const Limb& limb) {
    written.size = limb.size;
    written.offset = limb.offset;
    written.pad = limb.pad;
}

}  // namespace

const ActorObject* findActorAt(const Scene& scene, const NodePath& path) {
    const Object* object = findObjectAt(scene, followedUse(scene, path));
    return object ? std::get_if<ActorObject>(&object->kind) : nullptr;
}

std::vector<NodePath> actorPaths(const Scene& scene) {
    std::vector<NodePath> paths;
    forEachNode(scene, [&](const NodePath& path, const NodePointer& node) {
        const auto* object = std::get_if<const Object*>(&node);
        if (object && std::holds_alternative<ActorObject>((*object)->kind)) paths.push_back(path);
    });
    return paths;
}

NodePath addActor(Scene& scene, const NodePath& object, const std::string& name, const Rig& rig) {
    std::set<std::string> taken;
    for (const NodePath& path : actorPaths(scene)) taken.insert(findActorAt(scene, path)->name);
    ActorObject actor;
    actor.name = uniqueName(taken, name.empty() ? "actor" : name);
    for (const Joint& joint : rig.skeleton.joints) {
        SceneJoint written;
        written.name = joint.name;
        if (joint.parent != Joint::kNoParent) written.parent = rig.skeleton.joints[std::size_t(joint.parent)].name;
        written.at = joint.at;
        written.limits = joint.limits;
        actor.rig.skeleton.joints.push_back(std::move(written));
    }
    for (const Limb& limb : rig.limbs) {
        actor.rig.skeleton.limbs.push_back(sceneLimbOf(limb, rig.skeleton));
        setExtent(actor.rig.skeleton.limbs.back(), limb);
    }
    actor.rig.preserveVolume = true;  // else a twist, shared by two regions, narrows wrists and shoulders
    editObjectAt(scene, object, [&](Object& inner) {
        actor.of = std::move(inner);
        inner.kind = std::move(actor);
    });
    return object;
}

std::string addMotionAsset(Scene& scene, const std::string& name, const std::string& path) {
    std::set<std::string> taken;
    for (const auto& [asset, value] : scene.assets) taken.insert(asset);
    const std::string unique = uniqueName(taken, name.empty() ? "motion" : name);
    scene.assets[unique] = {AssetKind::Motion, path};
    return unique;
}

void setMotion(Scene& scene, const NodePath& actor, const std::string& asset, const Motion& motion) {
    const bool keepRate = animated(scene);
    editActor(scene, actor, [&](ActorObject& object) {
        ActorRig& rig = object.rig;
        rig.motion = asset;
        rig.motionMap.clear();
        rig.motionFit.reset();
        if (rig.skeleton.motion == asset) return;
        if (const auto skeleton = knownSkeleton(rig, asset, motion))
            proposeFit(rig, *skeleton, motion, mappedJoints(rig, *skeleton, motion));
    });
    scene.timeline = timelineFor(scene.timeline, motion, keepRate);
}

void clearMotion(Scene& scene, const NodePath& actor) {
    editActor(scene, actor, [](ActorObject& object) {
        object.rig.motion.clear();
        object.rig.motionMap.clear();
        object.rig.motionFit.reset();
        object.rig.inPlace = false;
    });
}

void setMotionJoint(Scene& scene, const NodePath& actor, const std::string& joint, const std::string& motionJoint,
                    const Motion& motion) {
    editActor(scene, actor, [&](ActorObject& object) {
        ActorRig& rig = object.rig;
        const auto skeleton = knownSkeleton(rig, rig.motion, motion);
        if (skeleton && rig.motionMap.empty()) {
            rig.motionMap = jointTable(rig, *skeleton, motion);
            for (const Joint& each : skeleton->joints) rig.motionMap.try_emplace(each.name);
        }
        rig.motionMap[joint] = motionJoint;
        if (!skeleton) return;
        const auto joints = jointTable(rig, *skeleton, motion);  // finds names that are wrong
        if (!rig.motionFit && rig.skeleton.motion.empty()) proposeFit(rig, *skeleton, motion, joints);
    });
}

void editLimb(Scene& scene, const NodePath& actor, const std::string& limb,
              const std::function<void(SceneLimb&)>& change, const CompiledActor& compiled) {
    editActor(scene, actor, [&](ActorObject& object) {
        auto& limbs = object.rig.skeleton.limbs;
        if (limbs.empty())
            for (const Limb& each : compiled.limbs) limbs.push_back(sceneLimbOf(each, compiled.skeleton));
        const auto named = [&](const auto& each) { return each.name == limb; };
        const auto written = std::find_if(limbs.begin(), limbs.end(), named);
        if (written == limbs.end())
            throw Error(actor, "it has no limb \"" + limb + "\"", "name one of its " + std::to_string(limbs.size()));
        const auto fitted = std::find_if(compiled.limbs.begin(), compiled.limbs.end(), named);
        if (!written->size && fitted != compiled.limbs.end()) setExtent(*written, *fitted);
        change(*written);
    });
}

void setFittedLimbs(Scene& scene, const NodePath& actor, const std::vector<Limb>& limbs) {
    editActor(scene, actor, [&](ActorObject& object) {
        SceneSkeleton& skeleton = object.rig.skeleton;
        if (skeleton.limbs.empty() && skeleton.motion.empty()) {
            const Skeleton rest = skeletonOf(skeleton, LoadedAssets{});
            for (const Limb& limb : limbs) skeleton.limbs.push_back(sceneLimbOf(limb, rest));
        }
        for (SceneLimb& written : skeleton.limbs)
            for (const Limb& limb : limbs)
                if (limb.name == written.name) setExtent(written, limb);
    });
}

void editRig(Scene& scene, const NodePath& actor, const std::function<void(ActorRig&)>& change) {
    editActor(scene, actor, [&](ActorObject& object) { change(object.rig); });
}

}  // namespace voledit
