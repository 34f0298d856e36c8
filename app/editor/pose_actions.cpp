// The named actions of joints and poses.

#include <charconv>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "app/editor/actor_actions.h"
#include "app/editor/tools/joint_edits.h"
#include "app/editor/tools/tool_actions.h"
#include "core/base/error.h"
#include "core/skeleton/ik.h"

namespace voledit {

namespace {

const std::string& nameOf(const CompiledActor& actor, int joint) {
    return actor.skeleton.joints[std::size_t(joint)].name;
}

/// "10 20 -5" or "10,20,-5".
Vec3 threeNumbers(const std::string& action, std::string text) {
    for (char& c : text)
        if (c == ',') c = ' ';
    std::istringstream words(text);
    Vec3 numbers(0);
    std::string word, more;
    for (int a = 0; a < 3; ++a) {
        words >> word;
        const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), numbers[a]);
        if (!words || failed != std::errc{} || end != word.data() + word.size() || !std::isfinite(numbers[a]))
            throw Error(action + " takes three numbers, as 10 20 -5, not \"" + text + "\"");
    }
    if (words >> more) throw Error(action + " takes three numbers, not more");
    return numbers;
}

std::vector<int> needJoints(const Workspace& workspace, const CompiledActor& actor, const std::string& action) {
    std::vector<int> joints = selectedJoints(workspace, actor);
    if (joints.empty()) throw Error(action, "no joint is selected", "click one in the view, or use joint.select");
    return joints;
}

std::string countOf(const CompiledActor& actor, const std::vector<int>& joints) {
    return joints.size() == 1 ? nameOf(actor, joints[0]) : std::to_string(joints.size()) + " joints";
}

bool anyJoint(const Workspace& workspace) {
    return !workspace.selection.joints.empty() && hasActor(workspace);
}

// ---- Joints -------------------------------------------------------------------------------------------------------

/// Names stand apart by blanks; one that has blanks itself stands in quotes, or alone.
void selectAction(Workspace& workspace, const std::string& argument) {
    const Scene& scene = workspace.document.scene();
    const CompiledScene* compiled = workspace.compiled.root ? &workspace.compiled : nullptr;
    std::vector<JointRef> found;
    try {
        if (!argument.empty()) found.push_back(jointNamed(scene, compiled, workspace.selection, argument));
    } catch (const Error&) {
        std::istringstream words(argument);
        for (std::string word; words >> word;) found.push_back(jointNamed(scene, compiled, workspace.selection, word));
    }
    if (found.empty()) {
        workspace.selection.joints.clear();
        return;
    }
    selectActor(workspace, *found.front().actor);
    workspace.selection.joints.clear();
    for (const JointRef& joint : found) {
        if (joint.actor != found.front().actor) throw Error("joint.select", "joints of one actor can be selected", {});
        const std::string& name = nameOf(*joint.actor, joint.joint);
        std::erase(workspace.selection.joints, name);
        workspace.selection.joints.push_back(name);
    }
}

void rotateAction(Workspace& workspace, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "joint.rotate");
    const std::vector<int> joints = needJoints(workspace, *actor, "joint.rotate");
    const Quat own = quatOfDegrees(threeNumbers("joint.rotate", argument));
    Pose pose = actor->pose;
    for (const int j : joints) {
        Quat& local = pose.rotate[std::size_t(j)];
        local = actor->motionPose.rotate[std::size_t(j)] * own;
        if (const auto& limits = actor->skeleton.joints[std::size_t(j)].limits) local = limited(local, *limits);
    }
    workspace.document.apply("Rotate " + countOf(*actor, joints),
                             [&](Scene& scene) { setPose(scene, *actor, pose, workspace.when()); });
}

void moveAction(Workspace& workspace, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "joint.move");
    const int joint = needJoints(workspace, *actor, "joint.move").back();
    const Vec3 to = threeNumbers("joint.move", argument);
    const std::string& name = nameOf(*actor, joint);
    if (workspace.actors.rigEdit) {
        workspace.document.apply("Move rest of " + name, [&](Scene& scene) {
            setJointAt(scene, actor->path, name, skeletonPoint(*actor, to));
        });
        return;
    }
    const auto said = workspace.actors.chains.find(name);
    const int chain = said != workspace.actors.chains.end() ? said->second : usualChain(actor->skeleton, joint);
    const Pose pose = reached(*actor, joint, to, chain);
    const bool root = actor->skeleton.joints[std::size_t(joint)].parent == Joint::kNoParent;
    workspace.document.apply((root ? "Move " : "Pose ") + name,
                             [&](Scene& scene) { setPose(scene, *actor, pose, workspace.when()); });
}

bool isDisjoint(const ActorRig& rig, const std::string& joint) {
    return std::find(rig.disjoint.begin(), rig.disjoint.end(), joint) != rig.disjoint.end();
}

void disjointAction(Workspace& workspace, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "joint.disjoint");
    const std::vector<int> joints = needJoints(workspace, *actor, "joint.disjoint");
    const ActorRig& rig = findActorAt(workspace.document.scene(), actor->path)->rig;
    const bool on = switchArgument("joint.disjoint", argument, isDisjoint(rig, nameOf(*actor, joints.back())));
    workspace.document.apply(on ? "Make joints disjoint" : "Connect joints", [&](Scene& scene) {
        editRig(scene, actor->path, [&](ActorRig& changed) {
            for (const int joint : joints) {
                std::erase(changed.disjoint, nameOf(*actor, joint));
                if (on) changed.disjoint.push_back(nameOf(*actor, joint));
            }
        });
    });
}

void addJointActions(Actions& actions, Workspace& workspace, ViewportTools& tools) {
    const auto any = [&workspace] { return hasActor(workspace); };
    const auto some = [&workspace] { return anyJoint(workspace); };
    actions.add({"joint.select", "Select Joints…", "", "NAME…", "Selects joints by name; none without one",
                 [&](const std::string& argument) { selectAction(workspace, argument); }, any});
    actions.add({"joint.rotate", "Rotation…", "", "X Y Z",
                 "Sets the selected joints' own rotation, on top of the motion: degrees about x, then y, then z",
                 [&](const std::string& argument) { rotateAction(workspace, argument); }, some});
    actions.add({"joint.move", "Move To…", "", "X Y Z",
                 "Brings the selected joint to a place by IK, world units; a root moves there",
                 [&](const std::string& argument) { moveAction(workspace, argument); }, some});
    actions.add({"joint.disjoint", "Disjoint", "", "on|off",
                 "Whether regions come apart at the selected joints, as rigid boxes",
                 [&](const std::string& argument) { disjointAction(workspace, argument); }, some,
                 [&workspace] {
                     if (!anyJoint(workspace)) return false;
                     const ActorPtr actor = needActor(workspace, "");
                     const ActorObject* object = findActorAt(workspace.document.scene(), actor->path);
                     return object && isDisjoint(object->rig, workspace.selection.joints.back());
                 }});
    actions.add({"tool.rotate", "Rotate Joints", "R", "",
                 "The selected joints turn with the mouse until a click; X, Y, Z their own axes, digits type degrees",
                 [&](const std::string&) { tools.joints().turn(toolContext(workspace)); }, some});
}

// ---- Poses --------------------------------------------------------------------------------------------------------

NamedPose poseNow(const Workspace& workspace, const CompiledActor& actor) {
    return poseOf(workspace.document.scene(), actor.path, workspace.time);
}

/// What `pose` says of `joint`; no rotation where it says nothing.
Vec3 degreesIn(const NamedPose& pose, const std::string& joint) {
    const auto found = pose.find(joint);
    return found == pose.end() ? Vec3(0) : found->second;
}

/// The actor's pose with what `part` says in its place.
NamedPose merged(const Workspace& workspace, const CompiledActor& actor, const NamedPose& part) {
    NamedPose pose = poseNow(workspace, actor);
    for (const auto& [joint, degrees] : part) pose[joint] = degrees;
    return pose;
}

void setWholePose(Workspace& workspace, const CompiledActor& actor, const std::string& step, const NamedPose& pose) {
    workspace.document.apply(step, [&](Scene& scene) { applyPose(scene, actor.path, pose, workspace.when()); });
}

std::string partnerOf(const CompiledActor& actor, const std::string& joint) {
    const int at = actor.skeleton.find(joint);
    return at < 0 ? joint : nameOf(actor, mirrorPartner(actor.skeleton, at));
}

/// `part` on the other side: of every joint that it has the partner's.
NamedPose mirroredPart(const CompiledActor& actor, const NamedPose& part) {
    const NamedPose all = mirroredPose(actor, part);
    NamedPose other;
    for (const auto& [joint, degrees] : part) {
        const std::string partner = partnerOf(actor, joint);
        other[partner] = degreesIn(all, partner);
    }
    return other;
}

/// The joints that copying and mirroring mean: the selected ones, else all.
NamedPose selectedPart(const Workspace& workspace, const CompiledActor& actor) {
    const NamedPose now = poseNow(workspace, actor);
    NamedPose part;
    for (const int joint : selectedJoints(workspace, actor))
        part[nameOf(actor, joint)] = degreesIn(now, nameOf(actor, joint));
    if (!part.empty()) return part;
    for (const Joint& joint : actor.skeleton.joints) part[joint.name] = degreesIn(now, joint.name);
    return part;
}

void pasteAction(Workspace& workspace, bool mirror) {
    const ActorPtr actor = needActor(workspace, "pose.paste");
    if (!workspace.actors.copied) throw Error("pose.paste", "no pose was copied", "copy one first (pose.copy)");
    NamedPose part;
    for (const auto& [joint, degrees] : *workspace.actors.copied)
        if (actor->skeleton.find(joint) >= 0) part[joint] = degrees;
    if (mirror) part = mirroredPart(*actor, part);
    setWholePose(workspace, *actor, mirror ? "Paste mirrored pose" : "Paste pose", merged(workspace, *actor, part));
}

void clearAction(Workspace& workspace, bool selectedOnly) {
    const ActorPtr actor = needActor(workspace, "pose.clear");
    if (!selectedOnly) return setWholePose(workspace, *actor, "Clear pose", {});
    NamedPose pose = poseNow(workspace, *actor);
    for (const int joint : needJoints(workspace, *actor, "joint.clear-rotation")) pose.erase(nameOf(*actor, joint));
    setWholePose(workspace, *actor, "Clear rotation", pose);
}

/// "Pose", "Pose 2" …: the first that the library lacks.
std::string freshName(const ActorRig& rig) {
    std::string name = "Pose";
    for (int n = 2; rig.poses.contains(name); ++n) name = "Pose " + std::to_string(n);
    return name;
}

void saveAction(Workspace& workspace, const std::string& argument) {
    const ActorPtr actor = needActor(workspace, "pose.save");
    const ActorRig& rig = findActorAt(workspace.document.scene(), actor->path)->rig;
    std::string& typed = workspace.actors.poseName;
    const std::string name = !argument.empty() ? argument : !typed.empty() ? typed : freshName(rig);
    const NamedPose pose = poseNow(workspace, *actor);
    workspace.document.apply("Save pose " + name, [&](Scene& scene) { savePose(scene, actor->path, name, pose); });
    typed.clear();
}

const NamedPose& needPose(const ActorRig& rig, const std::string& action, const std::string& name) {
    const auto found = rig.poses.find(name);
    if (found != rig.poses.end()) return found->second;
    std::string names;
    for (const auto& [known, pose] : rig.poses) names += (names.empty() ? "" : ", ") + known;
    throw Error(action, "the actor has no pose \"" + name + "\"",
                names.empty() ? "save one first (pose.save)" : "there are " + names);
}

void applyAction(Workspace& workspace, const std::string& name) {
    const ActorPtr actor = needActor(workspace, "pose.apply");
    // A copy: the edit replaces what it points to.
    const NamedPose pose = needPose(findActorAt(workspace.document.scene(), actor->path)->rig, "pose.apply", name);
    setWholePose(workspace, *actor, "Apply pose " + name, pose);
}

void deleteAction(Workspace& workspace, const std::string& name) {
    const ActorPtr actor = needActor(workspace, "pose.delete");
    needPose(findActorAt(workspace.document.scene(), actor->path)->rig, "pose.delete", name);
    workspace.document.apply("Delete pose " + name, [&](Scene& scene) { removePose(scene, actor->path, name); });
}

void addLibraryActions(Actions& actions, Workspace& workspace) {
    const auto any = [&workspace] { return hasActor(workspace); };
    actions.add({"pose.save", "Save Pose", "", "NAME", "Puts the actor's pose into its library",
                 [&](const std::string& name) { saveAction(workspace, name); }, any});
    actions.add({"pose.apply", "Apply Pose…", "", "NAME", "Takes a pose of the library",
                 [&](const std::string& name) { applyAction(workspace, name); }, any});
    actions.add({"pose.delete", "Delete Pose…", "", "NAME", "Takes a pose out of the library",
                 [&](const std::string& name) { deleteAction(workspace, name); }, any});
}

}  // namespace

void addPoseActions(Actions& actions, Workspace& workspace, ViewportTools& tools) {
    const auto any = [&workspace] { return hasActor(workspace); };
    const auto some = [&workspace] { return anyJoint(workspace); };
    const auto copied = [&workspace] { return hasActor(workspace) && workspace.actors.copied.has_value(); };
    addJointActions(actions, workspace, tools);
    actions.add({"joint.clear-rotation", "Clear Rotation", "Alt+R", "",
                 "The selected joints turn no further than the motion says",
                 [&](const std::string&) { clearAction(workspace, true); }, some});
    actions.add({"pose.copy", "Copy Pose", "Ctrl+C", "", "Remembers the rotations of the selected joints, or of all",
                 [&](const std::string&) {
                     workspace.actors.copied = selectedPart(workspace, *needActor(workspace, "pose.copy"));
                 },
                 any});
    actions.add({"pose.paste", "Paste Pose", "Ctrl+V", "", "Gives joints the rotations that were copied",
                 [&](const std::string&) { pasteAction(workspace, false); }, copied});
    actions.add({"pose.paste-mirrored", "Paste Mirrored", "Ctrl+Shift+V", "",
                 "Gives the joints of the other side what was copied, mirrored",
                 [&](const std::string&) { pasteAction(workspace, true); }, copied});
    actions.add({"pose.mirror", "Mirror Pose", "Ctrl+M", "",
                 "Swaps left and right; with joints selected, gives their mirror image to the other side",
                 [&](const std::string&) {
                     const ActorPtr actor = needActor(workspace, "pose.mirror");
                     const NamedPose part = mirroredPart(*actor, selectedPart(workspace, *actor));
                     setWholePose(workspace, *actor, "Mirror pose", merged(workspace, *actor, part));
                 },
                 any});
    actions.add({"pose.clear", "Clear Pose", "", "", "No joint has a rotation of its own any more",
                 [&](const std::string&) { clearAction(workspace, false); }, any});
    addLibraryActions(actions, workspace);
}

}  // namespace voledit
