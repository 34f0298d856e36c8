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
    void write(SharedValue<Node>& node, const NodePath& path) const {
        const auto first = frames_.lower_bound(path);
        if (first == frames_.end() || !first->first.starts_with(path)) return;
        if constexpr (std::is_same_v<Node, Transfer>)
            if (first->first == path) node.edit().frame = TrackedFrame(first->second);
        visitChildren(node.edit(), [&](const ChildStep& step, auto& child) { write(child, childPath(path, step)); });
    }

private:
    const DefaultFrames& frames_;
};

}  // namespace

void writeFrames(Scene& scene, const DefaultFrames& frames) {
    const FrameWriter writer(frames);
    writer.write(scene.root, kRootPath);
    for (auto& [name, object] : scene.objects) writer.write(object, objectPath(name));
    for (auto& [name, transfer] : scene.transfers) writer.write(transfer, transferPath(name));
    for (auto& [name, displacement] : scene.displacements) writer.write(displacement, displacementPath(name));
}

}  // namespace voledit
