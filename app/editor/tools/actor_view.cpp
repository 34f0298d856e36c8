#include "app/editor/tools/actor_view.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/scene/nodes.h"
#include "core/scene/scene_values.h"

namespace voledit {

namespace {

/// A point seen at `pixel` (z: depth).
struct Candidate {
    JointHit hit;
    double distance = 0, depth = 0;
};

/// Of the nearest within a pixel, the one in front.
std::optional<JointHit> bestOf(const std::vector<Candidate>& candidates) {
    double nearest = kInfinity;
    for (const Candidate& c : candidates) nearest = std::min(nearest, c.distance);
    const Candidate* best = nullptr;
    for (const Candidate& c : candidates)
        if (c.distance <= nearest + 1 && (!best || c.depth < best->depth)) best = &c;
    return best ? std::optional(best->hit) : std::nullopt;
}

std::string listed(const Skeleton& skeleton) {
    constexpr std::size_t kMost = 60;
    std::string names;
    for (std::size_t j = 0; j < std::min(kMost, skeleton.joints.size()); ++j)
        names += (j ? ", " : "") + skeleton.joints[j].name;
    if (skeleton.joints.size() > kMost) names += " and " + std::to_string(skeleton.joints.size() - kMost) + " more";
    return names;
}

}  // namespace

ActorPtr activeActor(const Scene& scene, const CompiledScene* compiled, const Selection& selection) {
    if (!compiled || compiled->actors.empty()) return nullptr;
    if (selection.node.empty()) return selection.lattice.empty() ? compiled->actors.front() : nullptr;
    const NodePath path = followedUse(scene, selection.node);
    for (const ActorPtr& actor : compiled->actors)
        if (actor->path == path) return actor;
    return nullptr;
}

ActorPtr meantActor(const Scene& scene, const CompiledScene* compiled, const Selection& selection) {
    if (ActorPtr active = activeActor(scene, compiled, selection)) return active;
    return compiled && compiled->actors.size() == 1 ? compiled->actors.front() : nullptr;
}

Mat4 worldFromSkeleton(const CompiledActor& actor) {
    return actor.worldFromObject * actor.objectFromSkeleton;
}

Vec3 shownJoint(const CompiledActor& actor, int joint) {
    return transformPoint(actor.worldFromObject, actor.posed[std::size_t(joint)].position);
}

Mat3 shownAxes(const CompiledActor& actor, int joint) {
    const Mat3 turned = posedJoints(actor.skeleton, actor.pose)[std::size_t(joint)].linear;
    Mat3 axes = Mat3(worldFromSkeleton(actor)) * turned;
    for (int a = 0; a < 3; ++a) axes[a] = glm::normalize(axes[a]);
    return axes;
}

JointRef jointNamed(const Scene& scene, const CompiledScene* compiled, const Selection& selection,
                    const std::string& name) {
    if (!compiled || compiled->actors.empty()) throw Error("the scene has no actor, hence no joint \"" + name + "\"");
    // The actor's own name may hold a slash, a joint's too: every cut is tried.
    for (const ActorPtr& actor : compiled->actors)
        if (!actor->name.empty() && name.starts_with(actor->name + "/"))
            if (const int joint = actor->skeleton.find(name.substr(actor->name.size() + 1)); joint >= 0)
                return {actor, joint};
    std::vector<ActorPtr> order = compiled->actors;
    if (ActorPtr meant = meantActor(scene, compiled, selection)) order.insert(order.begin(), meant);
    for (const ActorPtr& actor : order)
        if (const int joint = actor->skeleton.find(name); joint >= 0) return {actor, joint};
    std::string there;
    for (const ActorPtr& actor : compiled->actors)
        there += "\n  " + (actor->name.empty() ? actor->path : actor->name) + ": " + listed(actor->skeleton);
    throw Error("there is no joint \"" + name + "\"; there are" + there);
}

std::optional<JointHit> jointAt(const CompiledScene& compiled, const Camera& camera, Index2 size, const Vec2& at,
                                double radius) {
    std::vector<Candidate> joints, bones;
    for (const ActorPtr& actor : compiled.actors) {
        std::vector<Vec3> pixels;
        for (int j = 0; j < int(actor->posed.size()); ++j) {
            const Vec3 shown = shownJoint(*actor, j);
            pixels.push_back(project(camera, size, shown));
            const double distance = glm::distance(Vec2(pixels.back()), at);
            if (pixels.back().z > 0 && distance <= radius)
                joints.push_back({{{actor, j}, -1, shown}, distance, pixels.back().z});
        }
        for (const Limb& limb : actor->limbs) {
            const Vec3 from = pixels[std::size_t(limb.from)], to = pixels[std::size_t(limb.to)];
            const Vec2 along(to - from);
            if (!(from.z > 0 && to.z > 0) || glm::dot(along, along) < 1) continue;
            const double s = glm::clamp(glm::dot(at - Vec2(from), along) / glm::dot(along, along), 0.0, 1.0);
            const double distance = glm::distance(Vec2(from) + s * along, at);
            if (distance > 0.7 * radius) continue;
            // Depths, not shares of the screen, are linear along the bone.
            const double share = s * from.z / (to.z + s * (from.z - to.z));
            const Vec3 hit = glm::mix(shownJoint(*actor, limb.from), shownJoint(*actor, limb.to), share);
            bones.push_back({{{actor, limb.from}, limb.to, hit}, distance, project(camera, size, hit).z});
        }
    }
    return joints.empty() ? bestOf(bones) : bestOf(joints);
}

std::vector<int> selectedJoints(const Scene& scene, const CompiledActor& actor, const Selection& selection) {
    std::vector<int> joints;
    if (selection.node.empty() || followedUse(scene, selection.node) != actor.path) return joints;
    for (const std::string& name : selection.joints)
        if (const int joint = actor.skeleton.find(name); joint >= 0) joints.push_back(joint);
    return joints;
}

std::vector<int> limbsFrom(const CompiledActor& actor, int joint) {
    std::vector<int> limbs;
    for (int l = 0; l < int(actor.limbs.size()); ++l)
        if (actor.limbs[std::size_t(l)].from == joint) limbs.push_back(l);
    return limbs;
}

std::vector<int> editedLimbs(const CompiledActor& actor, int joint) {
    std::vector<int> limbs = limbsFrom(actor, joint);
    for (int l = 0; limbs.empty() && l < int(actor.limbs.size()); ++l)
        if (actor.limbs[std::size_t(l)].to == joint) limbs.push_back(l);
    return limbs;
}

}  // namespace voledit
