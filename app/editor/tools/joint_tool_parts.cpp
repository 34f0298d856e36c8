#include "app/editor/tools/joint_tool_parts.h"

namespace voledit {

bool editsRig(const ToolContext& context) {
    return context.actors && context.actors->rigEdit;
}

ActorPtr activeActor(const ToolContext& context) {
    return activeActor(context.document.scene(), context.compiled, context.selection);
}

std::vector<int> selectedJoints(const ToolContext& context, const CompiledActor& actor) {
    return selectedJoints(context.document.scene(), actor, context.selection);
}

ActorLook lookOf(const ToolContext& context, const CompiledActor& actor) {
    ActorLook look;
    look.selected = selectedJoints(context, actor);
    look.camera = context.camera;
    look.size = context.size;
    look.scale = context.scale;
    if (context.actors) look.regions = context.actors->showRegions;
    return look;
}

JointRef ringedJoint(const ToolContext& context) {
    if (editsRig(context)) return {};
    const ActorPtr actor = activeActor(context);
    if (!actor) return {};
    const std::vector<int> selected = selectedJoints(context, *actor);
    return selected.empty() ? JointRef{} : JointRef{actor, selected.back()};
}

std::vector<int> limbsWithHandles(const ToolContext& context, const CompiledActor& actor) {
    if (!editsRig(context)) return {};
    const std::vector<int> selected = selectedJoints(context, actor);
    return selected.empty() ? std::vector<int>{} : editedLimbs(actor, selected.back());
}

const std::string& nameOf(const CompiledActor& actor, int joint) {
    return actor.skeleton.joints[std::size_t(joint)].name;
}

}  // namespace voledit
