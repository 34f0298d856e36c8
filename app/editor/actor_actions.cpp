#include "app/editor/actor_actions.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

#include "app/editor/actor_analysis.h"
#include "app/editor/node_actions.h"
#include "core/base/error.h"
#include "core/rigging/body_frame.h"
#include "core/scene/compile.h"

namespace voledit {

namespace {

const CompiledScene* compiledOf(const Workspace& workspace) {
    return workspace.open && workspace.compiled.root ? &workspace.compiled : nullptr;
}

/// The object that is rigged: the selected one, or the one around what is selected; by default the root.
NodePath objectToRig(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    if (!workspace.selection.node.empty())
        for (NodePath path = followedUse(scene, workspace.selection.node); !path.empty(); path = parentOf(scene, path))
            if (findObjectAt(scene, path)) return path;
    return kRootPath;
}

/// The object at `path` as a scene of its own, at rest and at the time shown.
TermPtr termAt(const Workspace& workspace, const NodePath& path) {
    Scene scene = workspace.document.scene();
    if (path != kRootPath) scene.root = *findObjectAt(scene, path);
    return compile(scene, workspace.assets, workspace.time, &workspace.compiled).root;
}

std::vector<PosedJoint> restOf(const Skeleton& skeleton) {
    return posedJoints(skeleton, restPose(skeleton));
}

std::string covers(const Coverage& coverage) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * coverage.covered());
    return std::string(text) + " of its opaque voxels lie in a region";
}

// ---- Rigging ------------------------------------------------------------------------------------------------------

/// Puts `rig` about the object at `object`; an actor that stands there gets it in place of its own.
NodePath putRig(Scene& scene, const NodePath& object, const Rig& rig) {
    if (!findActorAt(scene, object)) return addActor(scene, object, "actor", rig);
    Scene fresh = scene;
    const ActorRig made = findActorAt(fresh, addActor(fresh, object + "/of", "actor", rig))->rig;
    editRig(scene, object, [&](ActorRig& old) {
        old.skeleton = made.skeleton;
        old.disjoint.clear();
        old.poses.clear();
    });
    return object;
}

/// A body that lies in the view is looked at from its front, upright: scans and models have their own ideas of up.
void faceBody(Workspace& workspace, const Term& term, const BodyFrame& frame) {
    if (std::abs(glm::dot(basisOf(workspace.camera).up, frame.axes[1])) > 0.7) return;
    const double aspect = double(workspace.viewSize.x) / workspace.viewSize.y;
    workspace.camera = fittingCamera(term.bounds, aspect, frame.axes[2], frame.axes[1]);
}

void finishRig(Workspace& workspace, const Scene& before, const NodePath& object, const Rig& rig,
               const Coverage& coverage) {
    if (!(workspace.document.committed() == before))
        throw Error("the scene has changed while it was being rigged; rig it again");
    NodePath path;
    workspace.document.apply("Auto-rig", [&](Scene& scene) { path = putRig(scene, object, rig); });
    selectTarget(workspace, path);
    workspace.notify(Notice::Kind::Info,
                     "Rigged with " + std::to_string(rig.limbs.size()) + " limbs: " + covers(coverage));
}

void rigAction(Workspace& workspace, Background& background, const std::string& argument) {
    const RigTemplate kind = rigTemplateOf(argument.empty() ? "biped" : argument);
    const NodePath object = objectToRig(workspace);
    const bool actor = findActorAt(workspace.document.scene(), object) != nullptr;
    const TermPtr term = termAt(workspace, actor ? object + "/of" : object);
    background.start("Auto-rig",
                     [&workspace, kind, object, term,
                      before = workspace.document.committed()](Progress& progress) -> Background::Finish {
                         const OpaqueVoxels voxels = opaqueVoxels(*term, kOpaque, 256, nullptr);
                         report(&progress, 0.4);
                         Rig rig = fittedRig(voxels, kind);
                         const BodyFrame frame = bodyFrame(voxels, kind == RigTemplate::Quadruped);
                         const bool face = kind != RigTemplate::Chain && object == kRootPath;
                         report(&progress, 0.9);
                         Coverage coverage = coverageOf(voxels, rig.limbs, restOf(rig.skeleton), {});
                         return [&workspace, before, object, term, frame, face, rig = std::move(rig),
                                 coverage = std::move(coverage)] {
                             finishRig(workspace, before, object, rig, coverage);
                             if (face) faceBody(workspace, *term, frame);
                         };
                     });
}

/// Which limbs are fitted: those that begin at selected joints; all with "all", and where none is selected.
std::vector<bool> limbsToFit(const Workspace& workspace, const CompiledActor& actor, const std::string& argument) {
    std::vector<bool> fit(actor.limbs.size(), true);
    const std::vector<int> joints = selectedJoints(workspace, actor);
    if (argument == "all" || joints.empty()) return fit;
    if (!argument.empty()) throw Error("rig.fit takes all or nothing, not \"" + argument + "\"");
    fit.assign(actor.limbs.size(), false);
    for (const int joint : joints)
        for (const int limb : editedLimbs(actor, joint)) fit[std::size_t(limb)] = true;
    return fit;
}

void setLimb(SceneLimb& limb, const Limb& fitted) {
    limb.size = Tracked<Vec2>(fitted.size);
    limb.offset = Tracked<Vec2>(fitted.offset);
    limb.pad = Tracked<Vec2>(fitted.pad);
}

void fitAction(Workspace& workspace, Background& background, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "rig.fit");
    const std::vector<bool> fit = limbsToFit(workspace, *actor, argument);
    background.start("Fitting regions",
                     [&workspace, actor, fit, known = workspace.actors.body,
                      before = workspace.document.committed()](Progress& progress) -> Background::Finish {
                         const auto body = known && known->of == actor->of ? known : bodyOf(actor->of, nullptr);
                         report(&progress, 0.5);
                         const std::vector<Limb> fitted = fittedLimbs(body->voxels, actor->rest, actor->limbs, fit);
                         return [&workspace, actor, fit, fitted, before] {
                             if (!(workspace.document.committed() == before))
                                 throw Error("the scene has changed while regions were being fitted; fit them again");
                             workspace.document.apply("Fit regions", [&](Scene& scene) {
                                 for (std::size_t l = 0; l < fitted.size(); ++l)
                                     if (fit[l])
                                         editLimb(
                                             scene, actor->path, actor->limbs[l].name,
                                             [&](SceneLimb& limb) { setLimb(limb, fitted[l]); }, *actor);
                             });
                         };
                     });
}

void editAction(Workspace& workspace, const std::string& argument) {
    ActorState& state = workspace.actors;
    const bool on = switchArgument("rig.edit", argument, state.rigEdit);
    if (on) selectActor(workspace, *needActor(workspace, "rig.edit"));
    state.rigEdit = on;
}

void addRigActions(Actions& actions, Workspace& workspace, Background& background) {
    const auto open = [&workspace] { return workspace.open; };
    const auto any = [&workspace] { return hasActor(workspace); };
    ActorState& state = workspace.actors;
    actions.add({"actor.rig", "Auto-rig", "", "biped|quadruped|chain",
                 "Lays a skeleton with regions into the selected object (by default the whole): an actor",
                 [&](const std::string& argument) { rigAction(workspace, background, argument); }, open});
    actions.add({"rig.edit", "Edit Rig", "Tab", "on|off", "Shows the actor at rest, to move joints and edit regions",
                 [&](const std::string& argument) { editAction(workspace, argument); }, any,
                 [&state] { return state.rigEdit; }});
    actions.add({"rig.fit", "Fit Regions", "", "all",
                 "Fits regions to the opaque voxels about them: of the selected joints, or of all",
                 [&](const std::string& argument) { fitAction(workspace, background, argument); }, any});
    actions.add({"view.regions", "Regions", "", "on|off", "Shows the regions of all limbs",
                 [&state](const std::string& argument) {
                     state.showRegions = switchArgument("view.regions", argument, state.showRegions);
                 },
                 any, [&state] { return state.showRegions; }});
    actions.add({"view.coverage", "Coverage", "", "on|off",
                 "Shows the actor at rest, with voxels in no region in red, and in several in yellow",
                 [&](const std::string& argument) {
                     const bool on = switchArgument("view.coverage", argument, state.showCoverage && state.rigEdit);
                     if (on) editAction(workspace, "on");
                     state.showCoverage = on;
                 },
                 any, [&state] { return state.showCoverage && state.rigEdit; }});
}

// ---- Motions ------------------------------------------------------------------------------------------------------

void modeAction(Workspace& workspace, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "actor.mode");
    if (argument != "connected" && argument != "disjoint")
        throw Error("actor.mode takes connected or disjoint, not \"" + argument + "\"");
    workspace.document.apply("Change mode", [&](Scene& scene) {
        editRig(scene, actor->path, [&](ActorRig& rig) { rig.allDisjoint = argument == "disjoint"; });
    });
}

void addMotionActions(Actions& actions, Workspace& workspace,
                      const std::function<void(const std::string&)>& importMotion) {
    const auto open = [&workspace] { return workspace.open; };
    const auto any = [&workspace] { return hasActor(workspace); };
    actions.add({"actor.import-motion", "Import Motion…", "", "PATH",
                 "Lets a motion file (BVH, FBX, glTF, Collada) drive the actor",
                 [importMotion](const std::string& path) { importMotion(path); }, open});
    actions.add({"actor.clear-motion", "Clear Motion", "", "", "The actor keeps its own pose and keys alone",
                 [&](const std::string&) {
                     const ActorPtr actor = needActor(workspace, "actor.clear-motion");
                     workspace.document.apply("Clear motion", [&](Scene& scene) { clearMotion(scene, actor->path); });
                 },
                 [&workspace, any] {
                     if (!any()) return false;
                     const ActorPtr actor = needActor(workspace, "");
                     const ActorObject* object = findActorAt(workspace.document.scene(), actor->path);
                     return object && !object->rig.motion.empty();
                 }});
    actions.add({"actor.mode", "Mode", "", "connected|disjoint",
                 "Whether regions stay joined at joints, or move apart as rigid boxes",
                 [&](const std::string& argument) { modeAction(workspace, argument); }, any});
}

}  // namespace

ActorPtr needActor(const Workspace& workspace, const std::string& action) {
    const CompiledScene* compiled = compiledOf(workspace);
    if (ActorPtr actor = meantActor(workspace.document.scene(), compiled, workspace.selection)) return actor;
    const bool none = !compiled || compiled->actors.empty();
    throw Error(action, none ? "the scene has no actor" : "no actor is selected",
                none ? "rig the object first (actor.rig)" : "click one in the view or in the Scene panel");
}

bool hasActor(const Workspace& workspace) {
    return meantActor(workspace.document.scene(), compiledOf(workspace), workspace.selection) != nullptr;
}

std::vector<int> selectedJoints(const Workspace& workspace, const CompiledActor& actor) {
    return selectedJoints(workspace.document.scene(), actor, workspace.selection);
}

void selectActor(Workspace& workspace, const CompiledActor& actor) {
    if (activeActor(workspace.document.scene(), compiledOf(workspace), workspace.selection).get() == &actor &&
        !workspace.selection.node.empty())
        return;
    selectTarget(workspace, actor.path);
}

std::string actorMode(const Workspace& workspace) {
    if (!hasActor(workspace)) return "";
    const ActorObject* actor = findActorAt(workspace.document.scene(), needActor(workspace, "")->path);
    return !actor ? "" : actor->rig.allDisjoint ? "disjoint" : "connected";
}

Scene atRest(Scene scene, const NodePath& path) {
    if (!findActorAt(scene, path)) return scene;
    editRig(scene, path, [](ActorRig& rig) {
        rig.motion.clear();
        for (SceneJoint& joint : rig.skeleton.joints) {
            joint.rotate = Rotation{};
            joint.translate = Vec3(0);
        }
    });
    return scene;
}

void addActorActions(Actions& actions, Workspace& workspace, Background& background,
                     const std::function<void(const std::string&)>& importMotion) {
    addRigActions(actions, workspace, background);
    addMotionActions(actions, workspace, importMotion);
}

}  // namespace voledit
