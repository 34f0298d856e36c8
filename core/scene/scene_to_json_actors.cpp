// Actors as JSON.
#include "core/scene/scene_to_json.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;
using voledit::toJson;

void addOwn(ordered_json& object, const SceneJoint& joint) {
    if (joint.rotate != SceneJoint{}.rotate) object["rotate"] = toJson(joint.rotate);
    if (joint.translate != SceneJoint{}.translate) object["translate"] = toJson(joint.translate);
    if (joint.limits) object["limits"] = {{"min", toJson(joint.limits->min)}, {"max", toJson(joint.limits->max)}};
}

ordered_json toJson(const SceneJoint& joint) {
    ordered_json result{{"name", joint.name}};
    result["parent"] = joint.parent.empty() ? ordered_json(nullptr) : ordered_json(joint.parent);
    result["at"] = toJson(joint.at);
    addOwn(result, joint);
    return result;
}

ordered_json toJson(const SceneLimb& limb) {
    const SceneLimb none;
    ordered_json result{{"name", limb.name}, {"from", limb.from}, {"to", limb.to}};
    if (limb.size) result["size"] = toJson(*limb.size);
    if (limb.offset != none.offset) result["offset"] = toJson(limb.offset);
    if (limb.roll != none.roll) result["roll"] = toJson(limb.roll);
    if (limb.pad) result["pad"] = toJson(*limb.pad);
    if (limb.of) result["of"] = toJson(**limb.of);
    return result;
}

}  // namespace

ordered_json toJson(const SceneSkeleton& skeleton) {
    ordered_json result = ordered_json::object();
    if (skeleton.motion.empty()) {
        ordered_json& joints = result["joints"] = ordered_json::array();
        for (const SceneJoint& joint : skeleton.joints) joints.push_back(toJson(joint));
    } else {
        result["motion"] = skeleton.motion;
        for (const SceneJoint& joint : skeleton.joints) {
            ordered_json own{{"name", joint.name}};
            addOwn(own, joint);
            result["pose"].push_back(std::move(own));
        }
    }
    if (skeleton.fit != Placement{}) add(result["fit"] = ordered_json::object(), skeleton.fit);
    for (const SceneLimb& limb : skeleton.limbs) result["limbs"].push_back(toJson(limb));
    return result;
}

void add(ordered_json& object, const ActorRig& rig) {
    const ActorRig none;
    object["skeleton"] = toJson(rig.skeleton);
    if (!rig.motion.empty()) object["motion"] = rig.motion;
    for (const auto& [joint, motionJoint] : rig.motionMap)
        object["motionMap"][joint] = motionJoint.empty() ? ordered_json(nullptr) : ordered_json(motionJoint);
    if (rig.motionFit) add(object["motionFit"] = ordered_json::object(), *rig.motionFit);
    if (rig.inPlace) object["inPlace"] = true;
    if (rig.allDisjoint) object["mode"] = "disjoint";
    if (!rig.disjoint.empty()) object["disjoint"] = rig.disjoint;
    if (rig.cells != none.cells) object["cells"] = toJson(rig.cells);
    if (rig.miterLimit != none.miterLimit) object["miterLimit"] = rig.miterLimit;
    if (rig.smooth != none.smooth) object["smooth"] = rig.smooth;
    if (rig.preserveVolume) object["preserveVolume"] = true;
    for (const auto& [name, pose] : rig.poses) {
        ordered_json& joints = object["poses"][name] = ordered_json::object();
        for (const auto& [joint, degrees] : pose) joints[joint] = toJson(degrees);
    }
}

}  // namespace voledit
