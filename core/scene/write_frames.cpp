// Frames that were left out, written into the scene.
#include "core/scene/compiler.h"
#include "core/scene/scene_children.h"

namespace voledit {

namespace {

class FrameWriter {
public:
    explicit FrameWriter(const DefaultFrames& frames) : frames_(frames) {}

    /// Only nodes that hold a frame's transfer are copied; all others stay shared.
    template <class Node>
    void write(SharedValue<Node>& node, const std::string& pointer) const {
        const auto first = frames_.lower_bound(pointer);
        if (first == frames_.end() || first->first.compare(0, pointer.size(), pointer) != 0) return;
        if constexpr (std::is_same_v<Node, Transfer>)
            if (first->first == pointer) node.edit().frame = TrackedFrame(first->second);
        visitChildren(node.edit(), [&](const ChildStep& step, auto& child) {
            std::string inner = pointerTo(pointer, std::string(step.member));
            if (step.element != ChildStep::kNone) inner = pointerTo(inner, std::to_string(step.element));
            write(child, inner);
        });
    }

private:
    const DefaultFrames& frames_;
};

}  // namespace

void writeFrames(Scene& scene, const DefaultFrames& frames) {
    const FrameWriter writer(frames);
    writer.write(scene.root, "/root");
    for (auto& [name, object] : scene.objects) writer.write(object, pointerTo("/objects", name));
    for (auto& [name, transfer] : scene.transfers) writer.write(transfer, pointerTo("/transfers", name));
    for (auto& [name, displacement] : scene.displacements)
        writer.write(displacement, pointerTo("/displacements", name));
}

}  // namespace voledit
