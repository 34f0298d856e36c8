#include "core/scene/scene_at.h"

#include <algorithm>

#include "core/scene/scene_children.h"

namespace voledit {

namespace {

template <class Node>
bool anyTracks(const Node& node) {
    bool any = false;
    visitTracked(node, [&](const ValueName&, const auto& value) { any = any || value.animated(); });
    return any;
}

/// Whether a motion moves the node.
template <class Node>
bool hasMotion(const Node& node) {
    return std::visit(
        [](const auto& kind) {
            if constexpr (requires { kind.rig; }) return !kind.rig.motion.empty();
            return false;
        },
        node.kind);
}

template <class Node, class Test>
bool anyWithin(const SharedValue<Node>& node, const Test& test) {
    bool any = test(*node);
    visitChildren(*node, [&](const ChildStep&, const auto& child) { any = any || anyWithin(child, test); });
    return any;
}

template <class Test>
bool anyNode(const Scene& scene, const Test& test) {
    const auto inMap = [&](const auto& named) {
        return std::any_of(named.begin(), named.end(),
                           [&](const auto& entry) { return anyWithin(entry.second, test); });
    };
    return anyWithin(scene.root, test) || inMap(scene.objects) || inMap(scene.transfers) || inMap(scene.displacements);
}

/// Tables stay tables: a value that tracks carry below the one before is held up to it.
void holdUp(PiecewiseLinear& table) {
    for (std::size_t i = 1; i < table.points.size(); ++i)
        table.points[i].x = std::max(table.points[i].x, table.points[i - 1].x);
}
void holdUp(ColorTable& table) {
    for (std::size_t i = 1; i < table.points.size(); ++i)
        table.points[i].value = std::max(table.points[i].value, table.points[i - 1].value);
}

template <class T>
void fix(Tracked<T>& value, double t) {
    if (!value.animated()) return;
    T now = value.at(t);
    if constexpr (std::is_same_v<T, PiecewiseLinear> || std::is_same_v<T, ColorTable>) holdUp(now);
    value = std::move(now);
}
void fix(TrackedFrame& value, double t) {
    if (value.animated()) value = value.at(t);
}

template <class Node>
SharedValue<Node> nodeAt(const SharedValue<Node>& node, double t) {
    SharedValue<Node> result =
        withChildren(node, [t](const ChildStep&, const auto& child) { return nodeAt(child, t); });
    if (!anyTracks(*node)) return result;
    visitTracked(result.edit(), [t](const ValueName&, auto& value) { fix(value, t); });
    if constexpr (std::is_same_v<Node, Transfer>) {
        auto& amount = result.edit().amount;
        amount = std::clamp(*amount, 0.0, 1.0);
    }
    return result;
}

}  // namespace

bool hasTracks(const Scene& scene) {
    bool any = false;
    visitTrackedSettings(scene, [&](const ValueName&, const auto& value) { any = any || value.animated(); });
    return any || anyNode(scene, [](const auto& node) { return anyTracks(node); });
}

bool animated(const Scene& scene) {
    return hasTracks(scene) || anyNode(scene, [](const auto& node) { return hasMotion(node); });
}

Scene sceneAt(const Scene& scene, double t) {
    Scene now = scene;
    visitTrackedSettings(now, [t](const ValueName&, auto& value) { fix(value, t); });
    now.root = nodeAt(scene.root, t);
    for (auto& [name, object] : now.objects) object = nodeAt(object, t);
    for (auto& [name, transfer] : now.transfers) transfer = nodeAt(transfer, t);
    for (auto& [name, displacement] : now.displacements) displacement = nodeAt(displacement, t);
    return now;
}

}  // namespace voledit
