#pragma once
// What a node of a scene (object, STF, SD object, scalar field) is made of: the nodes within it, and the values that
// may have tracks. The one list of members that walking, addressing, rewriting and evaluating at a time share.

#include <string>
#include <string_view>
#include <type_traits>

#include "core/scene/scene.h"

namespace voledit {

/// Where a node stands within another, in the saved JSON: a member, or an element of one.
struct ChildStep {
    static constexpr std::size_t kNone = std::size_t(-1);
    std::string_view member;
    std::size_t element = kNone;
};

// ---- The nodes within ---------------------------------------------------------------------------------------------

/// visitChildren for one kind of node; kinds without nodes within have none.
template <class Kind, class Visit>
void visitChildrenOfKind(Kind& kind, const Visit& visit) {
    using K = std::remove_const_t<Kind>;
    const auto visitList = [&](std::string_view member, auto& list) {
        for (std::size_t i = 0; i < list.size(); ++i) visit(ChildStep{member, i}, list[i]);
    };
    const auto visitXyz = [&](auto& fields) {
        visit(ChildStep{"x"}, fields[0]);
        visit(ChildStep{"y"}, fields[1]);
        visit(ChildStep{"z"}, fields[2]);
    };
    if constexpr (std::is_same_v<K, FieldsObject>) {
        visit(ChildStep{"opacity"}, kind.opacity);
        visitList("color", kind.color);
        for (auto& [name, field] : kind.attributes) visit(ChildStep{name}, field);
    } else if constexpr (std::is_same_v<K, CvgObject>) {
        visitList("of", kind.of);
        if (kind.by == CvgOperator::Blend) visit(ChildStep{"weight"}, kind.weight);
    } else if constexpr (std::is_same_v<K, TransferObject>) {
        visitList("by", kind.by);
        visit(ChildStep{"of"}, kind.of);
    } else if constexpr (std::is_same_v<K, DisplaceObject> || std::is_same_v<K, TransferredTransfer> ||
                         std::is_same_v<K, ScaleDisplacement>) {
        visit(ChildStep{"by"}, kind.by);
        visit(ChildStep{"of"}, kind.of);
    } else if constexpr (std::is_same_v<K, PlaceObject> || std::is_same_v<K, RecolorObject> ||
                         std::is_same_v<K, AttributeOf> || std::is_same_v<K, MappedField>) {
        visit(ChildStep{"of"}, kind.of);
    } else if constexpr (std::is_same_v<K, FieldsTransfer>) {
        if (kind.asset.empty()) visitXyz(kind.fields);
    } else if constexpr (std::is_same_v<K, FieldsDisplacement>) {
        visitXyz(kind.fields);
    } else if constexpr (std::is_same_v<K, SequenceTransfer> || std::is_same_v<K, CombinedDisplacement>) {
        visitList("of", kind.of);
    } else if constexpr (std::is_same_v<K, OfDisplacement>) {
        visit(ChildStep{"transfer"}, kind.transfer);
    } else if constexpr (std::is_same_v<K, BlendDisplacement>) {
        visit(ChildStep{"weight"}, kind.weight);
        visit(ChildStep{"of", 0}, kind.first);
        visit(ChildStep{"of", 1}, kind.second);
    } else if constexpr (std::is_same_v<K, ComponentOf>) {
        std::visit([&](auto& of) { visit(ChildStep{"of"}, of); }, kind.of);
    }
}

/// Calls visit(step, child) for every node directly within `node` (of any of the four types), in the file's order.
/// `child` is an ObjectRef, TransferRef, DisplacementRef or FieldRef, const where `node` is. `use` is not followed.
template <class Node, class Visit>
void visitChildren(Node& node, const Visit& visit) {
    std::visit([&](auto& kind) { visitChildrenOfKind(kind, visit); }, node.kind);
}

// ---- Values that may have tracks ----------------------------------------------------------------------------------

template <class Visit>
void visitTrackedIn(auto& box,
                    const Visit& visit) requires std::is_same_v<std::remove_cvref_t<decltype(box)>, TrackedBox> {
    visit(box.min);
    visit(box.max);
}
template <class Visit>
void visitTrackedIn(auto& placement,
                    const Visit& visit) requires std::is_same_v<std::remove_cvref_t<decltype(placement)>, Placement> {
    visit(placement.translate);
    visit(placement.rotate);
    visit(placement.scale);
    if (placement.matrix) visit(*placement.matrix);
}

/// visitTracked for the shape of a solid.
template <class Shape, class Visit>
void visitTrackedInShape(Shape& shape, const Visit& visit) {
    using S = std::remove_const_t<Shape>;
    if constexpr (std::is_same_v<S, SolidSphere>) {
        visit(shape.center);
        visit(shape.radius);
    } else if constexpr (std::is_same_v<S, SolidBox>) {
        visitTrackedIn(shape.box, visit);
    } else if constexpr (std::is_same_v<S, SolidCylinder> || std::is_same_v<S, SolidCapsule>) {
        visit(shape.from);
        visit(shape.to);
        visit(shape.radius);
    } else if constexpr (std::is_same_v<S, SolidTorus>) {
        visit(shape.center);
        visit(shape.axis);
        visit(shape.major);
        visit(shape.minor);
    } else if constexpr (std::is_same_v<S, SolidText>) {
        visit(shape.height);
        visit(shape.depth);
    } else {
        visitTrackedIn(shape.bounds, visit);
    }
}

/// visitTracked for one kind of node; kinds without such values have none.
template <class Kind, class Visit>
void visitTrackedOfKind(Kind& kind, const Visit& visit) {
    using K = std::remove_const_t<Kind>;
    const auto visitOptional = [&](auto& value) {
        if (value) visit(*value);
    };
    if constexpr (std::is_same_v<K, VolumeObject>) {
        visitOptional(kind.appearance.color);
        visitOptional(kind.appearance.opacity);
        visitOptional(kind.appearance.gradientOpacity);
    } else if constexpr (std::is_same_v<K, SolidObject>) {
        std::visit([&](auto& shape) { visitTrackedInShape(shape, visit); }, kind.shape);
        visit(kind.color);
        if (auto* opacity = std::get_if<Tracked<double>>(&kind.opacity)) visit(*opacity);
        visit(kind.falloff);
    } else if constexpr (std::is_same_v<K, FieldsObject>) {
        visitTrackedIn(kind.bounds, visit);
    } else if constexpr (std::is_same_v<K, PlaceObject> || std::is_same_v<K, AffineTransfer>) {
        visitTrackedIn(kind.placement, visit);
    } else if constexpr (std::is_same_v<K, RecolorObject>) {
        visitOptional(kind.color);
        visitOptional(kind.opacity);
    } else if constexpr (std::is_same_v<K, FfdTransfer>) {
        for (auto& [point, move] : kind.moves) visit(move.vector);
    } else if constexpr (std::is_same_v<K, LibraryTransfer>) {
        for (auto& [name, argument] : kind.arguments) {
            if (auto* numbers = std::get_if<Tracked<std::vector<double>>>(&argument)) visit(*numbers);
            if (auto* line = std::get_if<LibraryTransfer::Line>(&argument)) {
                visit(line->point);
                visit(line->direction);
            }
        }
    } else if constexpr (std::is_same_v<K, ExpressionTransfer>) {
        visitOptional(kind.image);
    } else if constexpr (std::is_same_v<K, MappedTransfer>) {
        visit(kind.points);
        visit(kind.source);
    } else if constexpr (std::is_same_v<K, NumberField>) {
        visit(kind.value);
    } else if constexpr (std::is_same_v<K, MappedField>) {
        visit(kind.table);
    }
}

/// Calls visit(value) for every Tracked and TrackedFrame of `node` (of any of the four types) itself, not of nodes
/// within; const where `node` is. All of them have `animated()` and `at(t)`, and can be assigned what `at` gives.
template <class Node, class Visit>
void visitTracked(Node& node, const Visit& visit) {
    std::visit([&](auto& kind) { visitTrackedOfKind(kind, visit); }, node.kind);
    if constexpr (std::is_same_v<std::remove_const_t<Node>, Transfer>) {
        if (node.frame) visit(*node.frame);
        visit(node.amount);
    }
}

/// The same for the camera, the light and opacityDistance.
template <class SceneType, class Visit>
void visitTrackedSettings(SceneType& scene, const Visit& visit) {
    if (scene.opacityDistance) visit(*scene.opacityDistance);
    if (scene.camera) {
        visit(scene.camera->eye);
        visit(scene.camera->target);
        visit(scene.camera->up);
        visit(scene.camera->fovY);
    }
    auto& render = scene.render;
    visit(render.background);
    visit(render.step);
    visit(render.ambient);
    visit(render.diffuse);
    visit(render.specular);
    visit(render.shininess);
    if (render.light) visit(*render.light);
}

// ---- Changing what is shared --------------------------------------------------------------------------------------

/// `node` with every node directly within replaced by what change(step, child) gives (the same type); `node` itself,
/// shared, where that is what was there (by `sharesWith`) everywhere.
template <class Node, class Change>
SharedValue<Node> withChildren(const SharedValue<Node>& node, const Change& change) {
    SharedValue<Node> result = node;
    std::size_t n = 0;
    visitChildren(*node, [&](const ChildStep& step, const auto& child) {
        const std::size_t mine = n++;
        const auto changed = change(step, child);
        if (changed.sharesWith(child)) return;
        std::size_t at = 0;
        visitChildren(result.edit(), [&](const ChildStep&, auto& slot) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(slot)>, std::remove_cvref_t<decltype(child)>>)
                if (at == mine) slot = changed;
            ++at;
        });
    });
    return result;
}

/// The tree at `node` with every node for which change(node) gives another (an optional of its type) replaced by it; an
/// inner one before the outer one that holds it. What nothing changes in stays shared.
template <class Node, class Change>
SharedValue<Node> rewritten(const SharedValue<Node>& node, const Change& change) {
    const auto within =
        withChildren(node, [&](const ChildStep&, const auto& child) { return rewritten(child, change); });
    if (auto replacement = change(*within)) return SharedValue<Node>(std::move(*replacement));
    return within;
}

/// The same for all of a scene.
template <class Change>
void rewriteNodes(Scene& scene, const Change& change) {
    scene.root = rewritten(scene.root, change);
    for (auto& [name, object] : scene.objects) object = rewritten(object, change);
    for (auto& [name, transfer] : scene.transfers) transfer = rewritten(transfer, change);
    for (auto& [name, displacement] : scene.displacements) displacement = rewritten(displacement, change);
}

}  // namespace voledit
