#include "app/editor/tools/joint_tool.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/editor/scene_tree.h"
#include "app/editor/tools/joint_edits.h"
#include "app/editor/tools/joint_tool_parts.h"
#include "core/base/error.h"
#include "core/rigging/curve_skeleton.h"
#include "core/scene/nodes.h"

namespace voledit {

namespace {

constexpr double kReach = 9;          // pixels from a joint that still hit it, at scale 1
constexpr double kRingReach = 6;      // and from a ring
constexpr double kDragThreshold = 3;  // pixels that a press may wander and still be a click, at scale 1
constexpr double kSnapReach = 0.05;   // of the object's diagonal, that a joint may go to the medial axis

/// The actor's row in the tree, which a `use` may stand for.
std::string rowOf(const Scene& scene, const NodePath& target) {
    for (const SceneRow& row : sceneRows(scene, {}))
        if (row.target == target) return row.path;
    return target;
}

/// A joint's own axes in the camera's: x right, y up, z towards the eye.
Mat3 axesInView(const CompiledActor& actor, int joint, const Camera& camera) {
    const CameraBasis basis = basisOf(camera);
    const Vec3 toEye = glm::normalize(camera.eye - shownJoint(actor, joint));
    Mat3 axes = shownAxes(actor, joint);
    for (int a = 0; a < 3; ++a)
        axes[a] = Vec3(glm::dot(axes[a], basis.right), glm::dot(axes[a], basis.up), glm::dot(axes[a], toEye));
    return axes;
}

std::string countOf(const CompiledActor& actor, const std::vector<int>& joints) {
    return joints.size() == 1 ? nameOf(actor, joints.front()) : std::to_string(joints.size()) + " joints";
}

}  // namespace

bool JointTool::pointer(ToolContext context, const PointerEvent& event) {
    pointer_ = event.at;
    switch (event.phase) {
        case PointerPhase::Down:
            return press(context, event);
        case PointerPhase::Move:
            return moved(context, event);
        case PointerPhase::Up:
            return release(context, event);
        case PointerPhase::Leave:
            if (idle()) {
                hovered_.reset();
                hoveredRing_.reset();
                hoveredFace_.reset();
            }
            return !idle();
        case PointerPhase::DoubleClick:
        case PointerPhase::Wheel:
            return !idle();
    }
    return false;
}

void JointTool::hover(const ToolContext& context, const Vec2& at) {
    hovered_.reset();
    hoveredRing_.reset();
    hoveredFace_.reset();
    if (!context.compiled) return;
    const auto hit = jointAt(*context.compiled, context.camera, context.size, at, kReach * context.scale);
    // A joint goes before a ring, a ring before a bone.
    if (const JointRef joint = ringedJoint(context); joint && !(hit && hit->to < 0))
        hoveredRing_ = ringAt(*joint.actor, joint.joint, lookOf(context, *joint.actor), at, kRingReach * context.scale);
    if (const ActorPtr actor = activeActor(context); actor && !(hit && hit->to < 0))
        hoveredFace_ = handleAt(*actor, limbsWithHandles(context, *actor), context.camera, context.size, at,
                                kReach * context.scale);
    if (!hoveredRing_ && !hoveredFace_) hovered_ = hit;
}

bool JointTool::press(ToolContext& context, const PointerEvent& event) {
    if (moving()) {
        if (event.button == PointerButton::Right) cancel(context);
        if (event.button == PointerButton::Left) finish(context);
        return true;
    }
    if (event.button != PointerButton::Left || event.modifiers.alt) return !idle();
    if (event.modifiers.ctrl && !editsRig(context)) return false;
    hover(context, event.at);
    if (!hoversAny()) return false;
    pressed_ = hovered_;
    pressedRing_ = hoveredRing_;
    pressedFace_ = hoveredFace_;
    pressedAt_ = event.at;
    toggling_ = event.modifiers.shift;
    grip_ = pressedRing_ ? Grip::Ring : pressedFace_ ? Grip::Face : pressed_->to >= 0 ? Grip::Bone : Grip::Place;
    if (pressed_) {
        const std::vector<int> selected = selectedJoints(context, *pressed_->of.actor);
        wasSelected_ = std::find(selected.begin(), selected.end(), pressed_->of.joint) != selected.end();
        if (!wasSelected_) select(context, pressed_->of, toggling_);
    }
    state_ = State::Pressed;
    return true;
}

bool JointTool::moved(ToolContext& context, const PointerEvent& event) {
    if (moving()) {
        follow(context, event);
    } else if (state_ == State::Pressed) {
        if (glm::distance(event.at, pressedAt_) <= kDragThreshold * context.scale) return true;
        state_ = State::Idle;
        if (grip_ == Grip::Ring) {
            const JointRef joint = ringedJoint(context);
            if (!joint) return true;
            beginTurn(context, joint.actor, pressedAt_,
                      pressedRing_->axis < 3 ? std::optional(pressedRing_->axis) : std::nullopt);
        } else if (grip_ == Grip::Face) {
            beginPull(context, pressedAt_);
        } else {
            beginMove(context, pressedAt_);
        }
        state_ = State::Dragging;
        follow(context, event);
    } else {
        hover(context, event.at);
    }
    return !idle();
}

bool JointTool::release(ToolContext& context, const PointerEvent& event) {
    if (event.button != PointerButton::Left || state_ == State::Following) return !idle();
    if (idle()) return false;
    if (state_ == State::Dragging) {
        finish(context);
    } else if (pressed_ && wasSelected_) {
        select(context, pressed_->of, toggling_);
    }
    state_ = State::Idle;
    hover(context, event.at);
    return true;
}

void JointTool::select(ToolContext& context, const JointRef& joint, bool toggle) {
    const std::string& name = nameOf(*joint.actor, joint.joint);
    const Scene& scene = context.document.scene();
    Selection& selection = context.selection;
    const bool same = !selection.node.empty() && followedUse(scene, selection.node) == joint.actor->path;
    Selection next{"", {}, same ? selection.node : rowOf(scene, joint.actor->path), {}};
    if (toggle && same) next.joints = selection.joints;
    const auto at = std::find(next.joints.begin(), next.joints.end(), name);
    if (at != next.joints.end())
        next.joints.erase(at);
    else
        next.joints.push_back(name);
    selection = std::move(next);
}

// ---- What goes on -------------------------------------------------------------------------------------------------

void JointTool::beginMove(const ToolContext& context, const Vec2& at) {
    // As compiled last: the one that was pressed on may be older.
    const JointRef of = pressed_ ? pressed_->of : JointRef{};
    ActorPtr actor = activeActor(context);
    if (!actor) actor = of.actor;
    if (!actor) return;
    std::vector<int> joints = selectedJoints(context, *actor);
    const int leading = of ? of.joint : joints.empty() ? -1 : joints.back();
    if (leading < 0) return;
    std::erase(joints, leading);
    joints.push_back(leading);
    if (editsRig(context)) {
        const ActorObject* object = findActorAt(context.document.scene(), actor->path);
        if (object && !object->rig.skeleton.motion.empty())
            throw Error("the rest pose is that of motion \"" + object->rig.skeleton.motion +
                        "\"; lay it in as a whole (Skeleton fit in the inspector), or rig the object anew");
    }
    const bool bone = grip_ == Grip::Bone && !editsRig(context);
    const Vec3 anchor = bone ? pressed_->at : shownJoint(*actor, leading);
    going_ = Going{actor, context.compiled->time, joints, bone ? pressed_->to : -1,
                   PointMove(anchor, context.camera, context.size, at)};
}

void JointTool::beginTurn(const ToolContext& context, const ActorPtr& actor, const Vec2& at, std::optional<int> axis) {
    const std::vector<int> joints = selectedJoints(context, *actor);
    const int leading = joints.back();
    const Vec2 pivot(project(context.camera, context.size, shownJoint(*actor, leading)));
    going_ = Going{actor, context.compiled->time, joints, -1,
                   JointTurn(pivot, at, axesInView(*actor, leading, context.camera), axis)};
}

void JointTool::beginPull(const ToolContext& context, const Vec2& at) {
    const ActorPtr actor = activeActor(context);
    if (!actor || !pressedFace_ || pressedFace_->limb >= int(actor->limbs.size())) return;
    going_ = Going{actor, context.compiled->time, {}, -1, FacePull{*pressedFace_, placeOf(*actor, *pressedFace_), at}};
}

bool JointTool::grab(ToolContext context) {
    const ActorPtr actor = activeActor(context);
    if (!idle() || !actor || selectedJoints(context, *actor).empty()) return false;
    const Vec3 pixel =
        project(context.camera, context.size, shownJoint(*actor, selectedJoints(context, *actor).back()));
    if (!(pixel.z > 0)) return false;
    grip_ = Grip::Place;
    pressed_.reset();
    beginMove(context, pointer_);
    state_ = State::Following;
    return true;
}

bool JointTool::turn(ToolContext context) {
    const JointRef joint = ringedJoint(context);
    if (!idle() || !joint) return false;
    grip_ = Grip::Ring;
    beginTurn(context, joint.actor, pointer_, std::nullopt);
    state_ = State::Following;
    return true;
}

void JointTool::follow(ToolContext& context, const PointerEvent& event) {
    if (!going_) return;
    snap_ = !event.modifiers.ctrl;
    if (auto* move = std::get_if<PointMove>(&going_->by)) move->follow(event.at, event.modifiers.shift);
    if (auto* turn = std::get_if<JointTurn>(&going_->by))
        turn->follow(event.at, event.modifiers.shift, event.modifiers.ctrl);
    if (auto* face = std::get_if<FacePull>(&going_->by)) {
        face->path += (event.at - face->last) * (event.modifiers.shift ? 0.1 : 1.0);
        face->last = event.at;
    }
    preview(context);
}

Pose JointTool::wantedPose(const ToolContext& context) const {
    const CompiledActor& actor = *going_->actor;
    if (const auto* turn = std::get_if<JointTurn>(&going_->by)) {
        const Vec3 pivot = shownJoint(actor, going_->joints.back());
        return turned(actor, going_->joints, {turn->axis(), glm::normalize(context.camera.eye - pivot)},
                      turn->degrees());
    }
    const auto& move = std::get<PointMove>(going_->by);
    const Vec3 target = move.anchor() + move.offset();
    if (going_->to >= 0) return pointed(actor, going_->to, target);
    const int joint = going_->joints.back();
    int chain = usualChain(actor.skeleton, joint);
    if (context.actors)
        if (const auto said = context.actors->chains.find(nameOf(actor, joint)); said != context.actors->chains.end())
            chain = said->second;
    return reached(actor, joint, target, chain);
}

void JointTool::moveRest(Scene& scene, const ToolContext& context) const {
    const CompiledActor& actor = *going_->actor;
    const Vec3 offset = std::get<PointMove>(going_->by).offset();
    const ActorBody* body = context.actors ? context.actors->body.get() : nullptr;
    const bool snaps = snap_ && going_->joints.size() == 1 && body && body->of == actor.of;
    for (const int joint : going_->joints) {
        Vec3 to = shownJoint(actor, joint) + offset;
        if (snaps) {
            const Vec3 inside = transformPoint(glm::inverse(actor.worldFromObject), to);
            const double reach = kSnapReach * glm::length(body->voxels.bounds().size());
            to =
                transformPoint(actor.worldFromObject, snappedToMedialAxis(body->voxels, body->distance, inside, reach));
        }
        setJointAt(scene, actor.path, nameOf(actor, joint), skeletonPoint(actor, to));
    }
}

void JointTool::preview(ToolContext& context) {
    try {
        if (const auto* face = std::get_if<FacePull>(&going_->by)) {
            const CompiledActor& actor = *going_->actor;
            const Limb& limb = actor.limbs[std::size_t(face->handle.limb)];
            const double distance = pulledBy(face->place, context.camera, context.size, face->path);
            context.document.preview([&](Scene& scene) {
                editLimb(
                    scene, actor.path, limb.name,
                    [&](SceneLimb& changed) { pull(changed, limb, face->handle.face, distance); }, actor);
            });
        } else if (editsRig(context)) {
            context.document.preview([&](Scene& scene) { moveRest(scene, context); });
        } else {
            const Pose pose = wantedPose(context);
            context.document.preview([&](Scene& scene) {
                setPose(scene, *going_->actor, pose, {going_->time, context.autoKey});
            });
        }
    } catch (...) {
        cancel(context);
        throw;
    }
}

std::string JointTool::stepName(const ToolContext& context) const {
    const CompiledActor& actor = *going_->actor;
    if (const auto* face = std::get_if<FacePull>(&going_->by))
        return "Resize " + actor.limbs[std::size_t(face->handle.limb)].name;
    const int leading = going_->joints.back();
    if (std::holds_alternative<JointTurn>(going_->by)) return "Rotate " + countOf(actor, going_->joints);
    if (editsRig(context)) return "Move rest of " + countOf(actor, going_->joints);
    const bool root = actor.skeleton.joints[std::size_t(leading)].parent == Joint::kNoParent;
    return (root ? "Move " : "Pose ") + nameOf(actor, leading);
}

void JointTool::finish(ToolContext& context) {
    const std::string name = going_ ? stepName(context) : "";
    going_.reset();
    state_ = State::Idle;
    if (!name.empty()) context.document.commit(name);
}

void JointTool::cancel(ToolContext context) {
    if (moving() && going_) context.document.cancel();
    going_.reset();
    pressed_.reset();
    pressedRing_.reset();
    state_ = State::Idle;
}

bool JointTool::key(ToolContext context, const KeyEvent& event) {
    if (idle()) return false;
    if (event.key == "Escape") {
        cancel(context);
    } else if (moving() && going_ && !event.modifiers.ctrl && !event.modifiers.alt) {
        if (event.key == "Enter" || event.key == "KeypadEnter")
            finish(context);
        else if (auto* move = std::get_if<PointMove>(&going_->by); move && move->key(event.key))
            preview(context);
        else if (auto* turn = std::get_if<JointTurn>(&going_->by); turn && turn->key(event.key))
            preview(context);
    }
    // While something is going on no shortcut may change the scene below it.
    return true;
}

}  // namespace voledit
