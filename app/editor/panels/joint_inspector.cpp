#include <imgui.h>

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "app/editor/actor_actions.h"
#include "app/editor/panels/actor_inspector.h"
#include "app/editor/tools/joint_edits.h"

namespace voledit {

namespace {

/// The joint's entry in the scene; one that has none (its skeleton is a motion's) gets one when it is changed.
SceneJoint entryOf(const ActorRig& rig, const std::string& name) {
    for (const SceneJoint& joint : rig.skeleton.joints)
        if (joint.name == name) return joint;
    SceneJoint joint;
    joint.name = name;
    return joint;
}

void putEntry(ActorRig& rig, const SceneJoint& entry) {
    for (SceneJoint& joint : rig.skeleton.joints)
        if (joint.name == entry.name) {
            joint = entry;
            return;
        }
    rig.skeleton.joints.push_back(entry);
}

/// Where a joint's value stands below the actor.
std::string memberOf(const SceneJoint& joint, const char* value) {
    return "/skeleton/joints/" + pointerToken(joint.name) + "/" + value;
}

void rotationRow(Inspection& in, SceneJoint& joint, bool root) {
    const NumberFormat degrees{-kInfinity, kInfinity, 0.5, 1, "°"};
    in.tracked("Rotate", memberOf(joint, "rotate"), joint.rotate, [&](Rotation& now) {
        return ui::vector("Rotate", now.degrees, degrees, "The joint's own rotation, on top of the motion: degrees");
    });
    if (root || joint.translate.animated() || *joint.translate != Vec3(0))
        in.position("Translate", memberOf(joint, "translate"), joint.translate,
                    "The joint's own displacement, on top of the motion");
}

void limitRows(Inspection& in, SceneJoint& joint) {
    bool limited = joint.limits.has_value();
    Edit edit = ui::checkbox("Limits", limited, "How far the joint may turn when it is dragged or turned in the view");
    if (edit.changed) joint.limits = limited ? std::optional(JointLimits{}) : std::nullopt;
    in.note(edit, "Change limits");
    if (!joint.limits) return;
    const NumberFormat degrees{-180, 180, 0.5, 0, "°"};
    JointLimits limits = *joint.limits;
    in.note(ui::vector("Least", limits.min, degrees, "Degrees about x, y, z"), "Change limits");
    in.note(ui::vector("Most", limits.max, degrees, "Degrees about x, y, z"), "Change limits");
    // An end that is pushed past the other takes it along.
    for (int a = 0; a < 3; ++a) {
        if (limits.min[a] != joint.limits->min[a]) limits.max[a] = std::max(limits.max[a], limits.min[a]);
        if (limits.max[a] != joint.limits->max[a]) limits.min[a] = std::min(limits.min[a], limits.max[a]);
    }
    joint.limits = limits;
}

void chainRow(Inspection& in, const CompiledActor& actor, int joint) {
    auto& chains = in.workspace().actors.chains;
    const std::string& name = actor.skeleton.joints[std::size_t(joint)].name;
    const auto said = chains.find(name);
    int chain = said != chains.end() ? said->second : usualChain(actor.skeleton, joint);
    const Edit edit =
        ui::integer("IK chain", chain, 1, 32, "How many bones turn when the joint is dragged in the view");
    if (edit.changed) chains[name] = chain;
}

void disjointRow(Inspection& in, ActorRig& rig, const std::string& name) {
    bool apart = std::find(rig.disjoint.begin(), rig.disjoint.end(), name) != rig.disjoint.end();
    const Edit edit = ui::checkbox("Disjoint", apart, "Regions come apart at this joint, as rigid boxes");
    if (edit.changed) {
        std::erase(rig.disjoint, name);
        if (apart) rig.disjoint.push_back(name);
    }
    in.note(edit, "Change disjoint joints");
}

ParameterFormat lengths(const Inspection& in, double low) {
    ParameterFormat format{in.lengthFormat(), {low, kInfinity}};
    format.format.min = low;
    return format;
}

std::array<double, 2> two(const Vec2& v) {
    return {v.x, v.y};
}

/// The region's rows: previews write it into the scene, limbs that were left out with it.
void limbRows(Inspection& in, const CompiledActor& actor, const Limb& limb) {
    constexpr double kThinnest = 1e-6;
    Document& document = in.workspace().document;
    const auto apply = [&](const Edit& edit, const char* step, const std::function<void(SceneLimb&)>& change) {
        applyEdit(document, edit, step, [&](Scene& scene) { editLimb(scene, actor.path, limb.name, change, actor); });
    };
    auto size = two(limb.size), offset = two(limb.offset), pad = two(limb.pad);
    double roll = glm::degrees(limb.roll);
    apply(ui::pair("Size", size, lengths(in, kThinnest), "Of the region's section, across the bone"), "Change size",
          [&](SceneLimb& l) { l.size = Tracked<Vec2>(Vec2(size[0], size[1])); });
    apply(ui::pair("Offset", offset, lengths(in, -kInfinity), "Of the section's middle from the bone"), "Change offset",
          [&](SceneLimb& l) { l.offset = Tracked<Vec2>(Vec2(offset[0], offset[1])); });
    apply(ui::pair("Pad", pad, lengths(in, -kInfinity),
                   "How far the region reaches beyond the joints it begins and "
                   "ends at, where it is not connected"),
          "Change pad", [&](SceneLimb& l) { l.pad = Tracked<Vec2>(Vec2(pad[0], pad[1])); });
    const NumberFormat degrees{-360, 360, 0.5, 1, "°"};
    apply(ui::number("Roll", roll, degrees, "Turns the region about the bone"), "Change roll",
          [&](SceneLimb& l) { l.roll = Tracked<double>(roll); });
}

void limbs(Inspection& in, const CompiledActor& actor, int joint) {
    const std::vector<int> shown = editedLimbs(actor, joint);
    for (const int l : shown) {
        const Limb& limb = actor.limbs[std::size_t(l)];
        const std::string title = "REGION  " + limb.name;
        ui::heading(title.c_str());
        ImGui::PushID(limb.name.c_str());
        // Of several the names tell them apart; of one there is nothing to tell.
        const WidgetScope scope(shown.size() > 1 ? limb.name.c_str() : "Region");
        limbRows(in, actor, limb);
        ImGui::PopID();
    }
    if (!shown.empty() &&
        ui::button(shown.size() > 1 ? "Fit these regions" : "Fit region", in.workspace().actions.tooltip("rig.fit")))
        in.workspace().actions.run("rig.fit");
}

}  // namespace

void inspectJoint(Inspection& in, ActorRig& rig, const CompiledActor& actor, int joint) {
    const std::string& name = actor.skeleton.joints[std::size_t(joint)].name;
    const std::size_t count = in.workspace().selection.joints.size();
    ui::heading(("JOINT  " + name + (count > 1 ? "  (of " + std::to_string(count) + ")" : "")).c_str());
    const SceneJoint before = entryOf(rig, name);
    SceneJoint entry = before;
    const bool root = actor.skeleton.joints[std::size_t(joint)].parent == Joint::kNoParent;
    if (!in.workspace().actors.rigEdit) {
        rotationRow(in, entry, root);
        chainRow(in, actor, joint);
    } else if (rig.skeleton.motion.empty()) {
        in.position("Place", memberOf(entry, "at"), entry.at, "At rest, in the skeleton's own space");
    }
    limitRows(in, entry);
    if (!(entry == before)) putEntry(rig, entry);
    disjointRow(in, rig, name);
    limbs(in, actor, joint);
}

}  // namespace voledit
