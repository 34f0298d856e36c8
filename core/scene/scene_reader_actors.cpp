// Actors and `skeleton` STFs of a scene file.
#include <algorithm>
#include <map>

#include "core/scene/json_schema.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

std::vector<std::string> namesOf(const std::vector<SceneJoint>& joints) {
    std::vector<std::string> names;
    for (const SceneJoint& joint : joints) names.push_back(joint.name);
    return names;
}

/// Calls entry(name, view) on each member.
template <class Entry>
void forEachMember(const JsonView& view, const Entry& entry) {
    for (auto member = view.value.begin(); member != view.value.end(); ++member)
        entry(member.key(), JsonView{member.value(), view.place.at(member.key())});
}

}  // namespace

ActorObject SceneReader::actor(const JsonView& view) {
    ActorObject result;
    if (view.has("name")) result.name = view["name"].text();
    result.of = object(view["of"]);
    result.rig = rig(view);
    return result;
}

SkeletonTransfer SceneReader::skeletonTransfer(const JsonView& view) {
    SkeletonTransfer result{rig(view), view["limb"].text()};
    std::vector<std::string> known;
    for (const SceneLimb& limb : result.rig.skeleton.limbs) known.push_back(limb.name);
    // Limbs that were left out are known only once the skeleton is.
    if (!known.empty() && std::find(known.begin(), known.end(), result.limb) == known.end())
        failUnknown(view["limb"], "the skeleton has no limb " + described(view.value["limb"]), known,
                    "name one of its limbs");
    return result;
}

ActorRig SceneReader::rig(const JsonView& view) {
    ActorRig result;
    result.skeleton = skeleton(view["skeleton"]);
    if (view.has("motion")) result.motion = motionAsset(view["motion"]);
    if (view.has("motionMap"))
        forEachMember(view["motionMap"], [&](const std::string& name, const JsonView& joint) {
            result.motionMap[name] = joint.value.is_null() ? "" : joint.text();
        });
    if (view.has("motionFit")) result.motionFit = placement(view["motionFit"]);
    if (view.has("inPlace")) result.inPlace = view.value["inPlace"].get<bool>();
    result.allDisjoint = view.has("mode") && view.value["mode"] == "disjoint";
    if (view.has("disjoint"))
        for (const auto& name : view.value["disjoint"]) result.disjoint.push_back(name.get<std::string>());
    if (view.has("cells")) result.cells = indices(view["cells"]);
    if (view.has("miterLimit")) result.miterLimit = view.value["miterLimit"].get<double>();
    if (view.has("smooth")) result.smooth = view.value["smooth"].get<bool>();
    if (view.has("preserveVolume")) result.preserveVolume = view.value["preserveVolume"].get<bool>();
    if (view.has("poses"))
        forEachMember(view["poses"], [&](const std::string& name, const JsonView& pose) {
            forEachMember(pose, [&](const std::string& joint, const JsonView& degrees) {
                result.poses[name][joint] = *vector(degrees);
            });
            result.poses.try_emplace(name);  // of no joint
        });
    checkJointNames(view, result);
    const auto& [motion, joints, fit, limbs] = result.skeleton;
    const double count = double(limbs.empty() && motion.empty() ? joints.size() : limbs.size());
    countCells(count * double(result.cells.x) * result.cells.y * result.cells.z,
               view.has("cells") ? view["cells"].place : view.place);
    return result;
}

std::string SceneReader::motionAsset(const JsonView& name) {
    motionUses_.push_back({name.text(), name.place.pointer()});
    return name.text();
}

SceneSkeleton SceneReader::skeleton(const JsonView& view) {
    SceneSkeleton result;
    const bool hasJoints = view.has("joints");
    if (!hasJoints) result.motion = motionAsset(view["motion"]);
    if (hasJoints || view.has("pose")) {
        const JsonView joints = view[hasJoints ? "joints" : "pose"];
        if (joints.value.size() > kMostJoints)
            fail(joints.place,
                 "found " + described(joints.value) + "; a skeleton has at most " + std::to_string(kMostJoints) +
                     " joints",
                 "leave some of them out");
        for (std::size_t j = 0; j < joints.value.size(); ++j) result.joints.push_back(joint(joints[j]));
        checkJoints(joints, result.joints);
    }
    if (view.has("fit")) result.fit = fit(view["fit"]);
    if (!view.has("limbs")) return result;
    const JsonView limbs = view["limbs"];
    if (limbs.value.size() > kMostJoints)
        fail(limbs.place, "found " + described(limbs.value) + "; there are at most " + std::to_string(kMostJoints),
             "leave some of them out");
    for (std::size_t l = 0; l < limbs.value.size(); ++l) result.limbs.push_back(limb(limbs[l]));
    checkLimbs(limbs, result);
    return result;
}

Placement SceneReader::fit(const JsonView& view) const {
    if (view.has("scale")) {
        const JsonView scale = view["scale"];
        const auto isZero = [](const nlohmann::json& number) {
            return number.is_number() && number.get<double>() == 0;
        };
        const auto& value = scale.value;
        if (isZero(value) || (value.is_array() && std::any_of(value.begin(), value.end(), isZero)))
            fail(view.place, "fit.scale is 0, which flattens the skeleton",
                 "give the length in the object of one unit of the skeleton");
    }
    return placement(view);
}

SceneJoint SceneReader::joint(const JsonView& view) const {
    SceneJoint result;
    result.name = view["name"].text();
    if (view.has("parent") && view.value["parent"].is_string()) result.parent = view["parent"].text();
    if (view.has("at")) result.at = vector(view["at"]);
    if (view.has("rotate")) result.rotate = rotation(view["rotate"]);
    if (view.has("translate")) result.translate = vector(view["translate"]);
    if (!view.has("limits")) return result;
    const JsonView limits = view["limits"];
    result.limits = JointLimits{*vector(limits["min"]), *vector(limits["max"])};
    for (int a = 0; a < 3; ++a)
        if (result.limits->max[a] < result.limits->min[a])
            fail(limits.place, std::string("max is below min about ") + "xyz"[a], "swap the two");
    return result;
}

SceneLimb SceneReader::limb(const JsonView& view) {
    SceneLimb result;
    result.name = view["name"].text();
    result.from = view["from"].text();
    result.to = view["to"].text();
    if (view.has("size")) result.size = pair(view["size"]);
    if (view.has("offset")) result.offset = pair(view["offset"]);
    if (view.has("roll")) result.roll = number(view["roll"]);
    if (view.has("pad")) result.pad = pair(view["pad"]);
    if (view.has("of")) result.of = object(view["of"]);
    return result;
}

/// Names are given once, parents exist, and nothing is its own ancestor.
void SceneReader::checkJoints(const JsonView& view, const std::vector<SceneJoint>& joints) const {
    std::map<std::string, std::size_t> index;
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (!index.emplace(joints[j].name, j).second)
            fail(view[j]["name"].place, "there are two joints " + described(view[j].value["name"]),
                 "give each a name of its own");
    std::vector<std::size_t> seenBy(joints.size(), joints.size());  // the joint from which a walk to the root came by
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (joints[j].parent.empty()) continue;
        if (!index.contains(joints[j].parent))
            failUnknown(view[j]["parent"], "there is no joint " + described(view[j].value["parent"]), namesOf(joints),
                        "name a joint of the list, or null");
        for (std::size_t k = j; seenBy[k] == joints.size() || seenBy[k] == j;) {
            if (seenBy[k] == j)
                fail(view[j]["parent"].place,
                     "joint " + described(nlohmann::json(joints[k].name)) + " is its own ancestor",
                     "break the circle of parents");
            seenBy[k] = j;
            const auto parent = index.find(joints[k].parent);
            if (parent == index.end()) break;
            k = parent->second;
        }
    }
}

/// Names are given once; where the joints are known, `from` and `to` are such, one above the other.
void SceneReader::checkLimbs(const JsonView& view, const SceneSkeleton& skeleton) const {
    std::set<std::string> names;
    std::map<std::string, int> index;
    for (const SceneJoint& joint : skeleton.joints) index.emplace(joint.name, int(index.size()));
    std::vector<int> parents;
    for (const SceneJoint& joint : skeleton.joints)
        parents.push_back(joint.parent.empty() ? Joint::kNoParent : index[joint.parent]);
    for (std::size_t l = 0; l < skeleton.limbs.size(); ++l) {
        const SceneLimb& limb = skeleton.limbs[l];
        const JsonView place = view[l];
        if (!names.insert(limb.name).second)
            fail(place["name"].place, "there are two limbs " + described(place.value["name"]),
                 "give each a name of its own");
        if (!skeleton.motion.empty()) continue;
        for (const char* end : {"from", "to"})
            if (!index.contains(place[end].text()))
                failUnknown(place[end], "the skeleton has no joint " + described(place.value[end]),
                            namesOf(skeleton.joints), "name one of its joints");
        const int from = index[limb.from];
        int above = parents[std::size_t(index[limb.to])];
        while (above != Joint::kNoParent && above != from) above = parents[std::size_t(above)];
        if (above == Joint::kNoParent)
            fail(place["to"].place,
                 "joint " + described(place.value["to"]) + " is not below " + described(place.value["from"]),
                 "a limb goes from a joint to one of its descendants");
    }
}

/// Joints that the rig speaks of are the skeleton's, where those are known already.
void SceneReader::checkJointNames(const JsonView& view, const ActorRig& rig) const {
    if (!rig.skeleton.motion.empty()) return;
    const std::vector<std::string> known = namesOf(rig.skeleton.joints);
    const std::set<std::string> joints(known.begin(), known.end());
    const auto check = [&](const std::string& name, const JsonPlace& place) {
        if (joints.contains(name)) return;
        const std::string nearest = nearestName(name, known);
        fail(place, "the skeleton has no joint " + described(nlohmann::json(name)),
             nearest.empty() ? "name one of its joints" : "did you mean \"" + nearest + "\"?");
    };
    if (view.has("disjoint")) {
        const JsonView list = view["disjoint"];
        for (std::size_t n = 0; n < list.value.size(); ++n) check(list[n].text(), list[n].place);
    }
    if (view.has("motionMap"))
        forEachMember(view["motionMap"],
                      [&](const std::string& name, const JsonView& joint) { check(name, joint.place); });
    if (!view.has("poses")) return;
    forEachMember(view["poses"], [&](const std::string&, const JsonView& pose) {
        forEachMember(pose, [&](const std::string& name, const JsonView& joint) { check(name, joint.place); });
    });
}

}  // namespace voledit
