#include <imgui.h>

#include <algorithm>

#include "app/editor/actor_actions.h"
#include "app/editor/motion_import.h"
#include "app/editor/panels/actor_inspector.h"

namespace voledit {

namespace {

std::shared_ptr<const Motion> motionOf(const Workspace& workspace, const std::string& asset) {
    const auto found = workspace.assets.motions.find(asset);
    return found == workspace.assets.motions.end() ? nullptr : found->second;
}

/// Motion's joint by joint of the skeleton: as the scene says, else by names.
std::map<std::string, std::string> tableOf(const ActorRig& rig, const Skeleton& skeleton, const Motion& motion) {
    if (rig.motionMap.empty()) return matchingJoints(skeleton, motion);
    std::map<std::string, std::string> table;
    for (const auto& [joint, driver] : rig.motionMap)
        if (!driver.empty()) table[joint] = driver;
    return table;
}

void motionCombo(Inspection& in, const ActorRig& rig) {
    Workspace& workspace = in.workspace();
    std::vector<std::string> names{"None"};
    for (const auto& [name, asset] : workspace.document.scene().assets)
        if (asset.kind == AssetKind::Motion) names.push_back(name);
    int index = int(std::find(names.begin() + 1, names.end(), rig.motion) - names.begin());
    if (rig.motion.empty() || index >= int(names.size())) index = 0;
    if (!ui::combo("Motion", index, names, "What drives the actor").changed) return;
    if (index == 0)
        workspace.actions.run("actor.clear-motion");
    else
        driveByAsset(workspace, in.path(), names[std::size_t(index)]);
}

void tableRows(Inspection& in, const CompiledActor& actor, const Motion& motion,
               const std::map<std::string, std::string>& table) {
    Workspace& workspace = in.workspace();
    std::vector<std::string> drivers{"—"};
    for (const MotionJoint& joint : motion.joints)
        if (!joint.endSite) drivers.push_back(joint.name);
    const WidgetScope scope("Joints");
    ImGui::PushID("joints");
    for (const Joint& joint : actor.skeleton.joints) {
        // The ends of limbs turn nothing.
        if (actor.skeleton.childrenOf(int(&joint - actor.skeleton.joints.data())).empty()) continue;
        const auto found = table.find(joint.name);
        const auto at = found == table.end() ? drivers.end() : std::find(drivers.begin(), drivers.end(), found->second);
        int index = at == drivers.end() ? 0 : int(at - drivers.begin());
        if (!ui::combo(joint.name.c_str(), index, drivers, "The motion's joint that drives this one").changed) continue;
        const std::string driver = index == 0 ? "" : drivers[std::size_t(index)];
        workspace.document.apply("Change joint table",
                                 [&](Scene& scene) { setMotionJoint(scene, in.path(), joint.name, driver, motion); });
    }
    ImGui::PopID();
}

bool openSection(const char* label, bool force) {
    if (force) ImGui::GetStateStorage()->SetBool(ImGui::GetID(label), true);
    return ui::section(label, false);
}

}  // namespace

void inspectMotion(Inspection& in, ActorRig& rig, const CompiledActor& actor) {
    Workspace& workspace = in.workspace();
    motionCombo(in, rig);
    ui::actionButton(workspace.actions, "actor.import-motion");
    const std::shared_ptr<const Motion> motion = rig.motion.empty() ? nullptr : motionOf(workspace, rig.motion);
    if (!motion) return;
    const auto table = tableOf(rig, actor.skeleton, *motion);
    std::size_t drivable = 0, driven = 0;
    for (std::size_t j = 0; j < actor.skeleton.joints.size(); ++j) {
        if (actor.skeleton.childrenOf(int(j)).empty()) continue;
        ++drivable;
        driven += table.contains(actor.skeleton.joints[j].name);
    }
    const std::string count = "Matched " + std::to_string(driven) + " of " + std::to_string(drivable) + " joints";
    if (driven == 0)
        ui::warning(count + ": the motion moves nothing. Choose in the table below which joint drives which.");
    else
        ui::finePrint(count + "  ·  " + std::to_string(motion->frames) + " frames");
    noteWidget("Matched");
    in.note(ui::checkbox("In place", rig.inPlace, "The actor stays where it stands: no travel"), "Change in place");
    if (openSection("Joints", std::exchange(workspace.actors.showTable, false))) tableRows(in, actor, *motion, table);
    if (!ui::section("Motion fit", false)) return;
    const WidgetScope scope("Motion fit");
    ImGui::PushID("motion fit");
    const Placement before = rig.motionFit.value_or(Placement{});
    Placement fit = before;
    in.placementRows(fit, "/motionFit");
    if (!(fit == before)) rig.motionFit = fit;
    ImGui::PopID();
}

}  // namespace voledit
