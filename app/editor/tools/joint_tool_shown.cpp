// What the joint tool shows: the overlay, words for the status line and beside the pointer.
#include "app/editor/tools/joint_tool.h"
#include "app/editor/tools/joint_tool_parts.h"

namespace voledit {

std::string JointTool::readout() const {
    if (!moving() || !going_) return "";
    if (const auto* turn = std::get_if<JointTurn>(&going_->by)) return turn->readout();
    const auto* move = std::get_if<PointMove>(&going_->by);
    return move ? "Move " + move->readout() : "";
}

std::string JointTool::hoveredName() const {
    if (!idle() || !hovered_) return "";
    const CompiledActor& actor = *hovered_->of.actor;
    return nameOf(actor, hovered_->of.joint);
}

std::string JointTool::hint(const ToolContext& context) const {
    const bool turning = going_ && std::holds_alternative<JointTurn>(going_->by);
    const std::string end = state_ == State::Dragging ? "release: confirm" : "Enter or click: confirm";
    if (moving() && turning)
        return "X/Y/Z: about own axis  ·  digits: degrees  ·  Ctrl: steps  ·  Shift: precise  ·  " + end +
               "  ·  Esc: cancel";
    if (moving() && grip_ == Grip::Face)
        return "Drag: the face  ·  Shift: precise  ·  release: confirm  ·  Esc: cancel";
    if (moving())
        return std::string(editsRig(context) ? "Ctrl: no snapping to the middle  ·  " : "") +
               "X/Y/Z: lock axis  ·  digits: distance  ·  Shift: precise  ·  " + end + "  ·  Esc: cancel";
    if (hoveredRing_) return "Drag: turn  ·  Ctrl: steps  ·  Shift: precise";
    if (hoveredFace_) return "Drag: pull the region's face";
    const bool rig = editsRig(context);
    if (hovered_) {
        if (rig) return "Click: select  ·  Drag: move at rest, snapped to the middle  ·  Ctrl+drag: freely";
        if (hovered_->to >= 0) return "Click: select  ·  Drag: point the bone";
        return "Click: select  ·  Shift+click: add  ·  Drag: pose";
    }
    const ActorPtr actor = activeActor(context);
    if (!actor) return "";
    if (rig) return "Rig, at rest  ·  Drag a joint: move it  ·  Tab: pose";
    if (!selectedJoints(context, *actor).empty()) return "G: move  ·  R: rotate  ·  I: key  ·  Alt+R: clear rotation";
    return "Drag a joint: pose  ·  Tab: edit the rig";
}

void JointTool::fillOverlay(const ToolContext& context, Overlay& overlay) const {
    if (!context.compiled) return;
    const ActorPtr shown = activeActor(context);
    for (const ActorPtr& actor : context.compiled->actors) {
        ActorLook look = lookOf(context, *actor);
        look.active = actor == shown;
        const bool here = hovered_ && hovered_->of.actor->path == actor->path && idle();
        if (here && hovered_->to < 0) look.hovered = hovered_->of.joint;
        if (here && hovered_->to >= 0)
            for (int l = 0; l < int(actor->limbs.size()); ++l)
                if (actor->limbs[std::size_t(l)].from == hovered_->of.joint &&
                    actor->limbs[std::size_t(l)].to == hovered_->to)
                    look.hoveredBone = l;
        const ActorState* state = context.actors;
        if (editsRig(context) && state->showCoverage && state->body && state->coverage && state->body->of == actor->of)
            appendCoverage(*actor, *state->body, *state->coverage, context.scale, overlay);
        appendActor(*actor, look, overlay);
        if (look.active) {
            std::optional<RegionHandle> marked = hoveredFace_;
            if (going_)
                if (const auto* face = std::get_if<FacePull>(&going_->by)) marked = face->handle;
            appendHandles(*actor, limbsWithHandles(context, *actor), marked, context.scale, overlay);
        }
    }
    if (const JointRef joint = ringedJoint(context)) {
        std::optional<RingHit> marked = hoveredRing_;
        if (going_)
            if (const auto* turn = std::get_if<JointTurn>(&going_->by)) marked = RingHit{turn->axis().value_or(3)};
        appendRings(*joint.actor, joint.joint, marked, lookOf(context, *joint.actor), overlay);
    }
}

}  // namespace voledit
