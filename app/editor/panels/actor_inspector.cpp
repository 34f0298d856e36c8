#include "app/editor/panels/actor_inspector.h"

#include <imgui.h>

#include <cstdio>

#include "app/editor/actor_actions.h"
#include "app/editor/icons.h"
#include "app/editor/panels/inspectors.h"
#include "core/base/error.h"

namespace voledit {

namespace {

std::string share(std::size_t part, std::size_t whole) {
    char text[64];
    std::snprintf(text, sizeof text, "%zu  (%.2f %%)", part, whole ? 100.0 * double(part) / double(whole) : 0.0);
    return text;
}

void line(const char* label, const std::string& text) {
    ui::row(label);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    noteWidget(label);
}

/// What was counted of the actor that is shown at rest.
void coverageRows(const Workspace& workspace) {
    const ActorState& state = workspace.actors;
    if (!state.showCoverage || !state.rigEdit) return;
    if (!state.coverage) return ui::note("Counting…");
    const Coverage& coverage = *state.coverage;
    line("Opaque", std::to_string(coverage.opaque) + " voxels");
    line("Uncovered", share(coverage.uncovered, coverage.opaque));
    line("Covered twice", share(coverage.doubly, coverage.opaque));
}

/// A switch of the view, by its action.
void viewSwitch(Workspace& workspace, const char* label, const char* action, bool now, const char* help) {
    bool value = now;
    if (ui::checkbox(label, value, help).changed) workspace.actions.run(action, value ? "on" : "off");
}

void regionRows(Inspection& in, ActorRig& rig) {
    Workspace& workspace = in.workspace();
    static const std::vector<std::string> modes{"Connected", "Disjoint"};
    int mode = rig.allDisjoint ? 1 : 0;
    Edit edit = ui::choice("Mode", mode, modes, "Regions stay joined at joints, or move apart as rigid boxes");
    if (edit.changed) rig.allDisjoint = mode == 1;
    in.note(edit, "Change mode");

    in.note(ui::integers("Cells", rig.cells, 1, 64, "Parts of each region: across, across, along. More bend smoother."),
            "Change cells");
    NumberFormat limit{1, 20, 0.02, 2};
    in.note(ui::number("Miter limit", rig.miterLimit, limit,
                       "How far a bend's outer corner may reach, of a straight one's; past it the corner is bevelled"),
            "Change miter limit");
    in.note(ui::checkbox("Smooth", rig.smooth, "Bends without a crease at joints"), "Change smoothness");
    in.note(ui::checkbox("Keep volume", rig.preserveVolume, "Bends neither thin nor swell the limb"),
            "Change volume preservation");
    const ActorState& state = workspace.actors;
    viewSwitch(workspace, "Show regions", "view.regions", state.showRegions, "Outlines of all regions in the view");
    viewSwitch(workspace, "Show coverage", "view.coverage", state.showCoverage && state.rigEdit,
               "The actor at rest, with voxels in no region in red and in several in yellow");
    coverageRows(workspace);
}

void rigRows(Inspection& in, ActorRig& rig, const CompiledActor& actor) {
    Workspace& workspace = in.workspace();
    const std::size_t joints = actor.skeleton.joints.size();
    ui::finePrint(std::to_string(joints) + (joints == 1 ? " joint" : " joints") + "  ·  " +
                  std::to_string(actor.limbs.size()) + (actor.limbs.size() == 1 ? " limb" : " limbs") +
                  (rig.skeleton.motion.empty() ? "" : "  ·  rest pose of " + rig.skeleton.motion));
    ui::note("Rig anew, as a");
    static constexpr const char* kWords[] = {"biped", "quadruped", "chain"};
    static constexpr const char* kTitles[] = {"Biped", "Quadruped", "Chain"};
    for (int kind = 0; kind < 3; ++kind) {
        if (kind > 0) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ui::button(kTitles[kind], "Lays such a skeleton into the object, and fits regions (actor.rig)"))
            workspace.actions.run("actor.rig", kWords[kind]);
    }
    viewSwitch(workspace, "Edit rig", "rig.edit", workspace.actors.rigEdit,
               "Shows the actor at rest, to move joints and edit regions (Tab)");
    if (ui::button("Fit all regions", "Fits the regions of all limbs to the opaque voxels about them"))
        workspace.actions.run("rig.fit", "all");
    if (!ui::section("Skeleton fit", false)) return;
    const WidgetScope scope("Skeleton fit");
    ImGui::PushID("skeleton fit");
    in.placementRows(rig.skeleton.fit, "/skeleton/fit");
    ImGui::PopID();
}

}  // namespace

void inspectPoses(Inspection& in, const ActorRig& rig) {
    Workspace& workspace = in.workspace();
    const Actions& actions = workspace.actions;
    std::string wanted, unwanted;
    for (const auto& [name, pose] : rig.poses) {
        ImGui::PushID(name.c_str());
        const WidgetScope scope("Poses");
        const float trash = 1.1f * ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
        if (ImGui::Button(name.c_str(), ImVec2(ImGui::GetContentRegionAvail().x - trash, 0))) wanted = name;
        noteWidget(name);
        ui::tooltip("Takes this pose");
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ui::iconButton(icons::kRemove, ("Delete " + name).c_str(), "Takes the pose out of the library"))
            unwanted = name;
        ImGui::PopID();
    }
    if (rig.poses.empty()) ui::note("The library is empty. Pose the actor, then save.");
    ui::text("Pose name", workspace.actors.poseName, "What the pose is called in the library");
    const float space = ImGui::GetStyle().ItemInnerSpacing.x;
    const auto small = [&](const char* id, const char* label, bool first) {
        const Action* action = actions.find(id);
        if (!action) return;
        if (!first) ImGui::SameLine(0, space);
        if (ui::button(label, actions.tooltip(id), action->isEnabled())) actions.run(id);
    };
    small("pose.save", "Save pose", true);
    small("pose.clear", "Clear", false);
    small("pose.mirror", "Mirror", false);
    small("pose.copy", "Copy", true);
    small("pose.paste", "Paste", false);
    small("pose.paste-mirrored", "Paste mirrored", false);
    if (!wanted.empty()) actions.run("pose.apply", wanted);
    if (!unwanted.empty()) actions.run("pose.delete", unwanted);
}

void inspectActor(Inspection& in, ActorObject& object) {
    Workspace& workspace = in.workspace();
    ActorPtr actor;
    for (const ActorPtr& compiled : workspace.compiled.actors)
        if (compiled->path == in.path()) actor = compiled;
    if (!actor) return ui::note("This actor takes no part in what is shown.");
    const std::vector<int> joints = selectedJoints(workspace, *actor);
    if (!joints.empty()) inspectJoint(in, object.rig, *actor, joints.back());
    ui::heading("MOTION");
    inspectMotion(in, object.rig, *actor);
    ui::heading("POSES");
    inspectPoses(in, object.rig);
    ui::heading("RIG");
    rigRows(in, object.rig, *actor);
    ui::heading("REGIONS");
    regionRows(in, object.rig);
}

}  // namespace voledit
