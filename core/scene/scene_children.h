#pragma once
// What a node of a scene (object, STF, SD object, scalar field) is made of: the nodes within it, and the values that
// may have tracks. The one list of members that walking, addressing, rewriting and evaluating at a time share.

#include <string>
#include <string_view>
#include <type_traits>

#include "core/scene/scene.h"

namespace voledit {

/// Where a node stands within another, in the saved JSON: a member, or an element of one; or, of an actor's limb,
/// member `inner` of element `element` of member `member` of member `outer`.
struct ChildStep {
    static constexpr std::size_t kNone = std::size_t(-1);
    std::string_view member;
    std::size_t element = kNone;
    std::string_view outer = {}, inner = {};
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
    const auto visitLimbs = [&](auto& skeleton) {
        for (std::size_t l = 0; l < skeleton.limbs.size(); ++l)
            if (skeleton.limbs[l].of) visit(ChildStep{"limbs", l, "skeleton", "of"}, *skeleton.limbs[l].of);
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
    } else if constexpr (std::is_same_v<K, ActorObject>) {
        visit(ChildStep{"of"}, kind.of);
        visitLimbs(kind.rig.skeleton);
    } else if constexpr (std::is_same_v<K, SkeletonTransfer>) {
        visitLimbs(kind.rig.skeleton);
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

/// Where a value stands within its node: tokens of a JSON pointer. A link to the name around it, so that no text is
/// made unless it is asked for. Joints and limbs go by their names, control points by their index in the lattice. A
/// number that is a scalar field has no name of its own: its node is it.
struct ValueName {
    static constexpr std::size_t kNone = std::size_t(-1);
    std::string_view member = {};
    std::size_t index = kNone;
    const ValueName* outer = nullptr;

    ValueName in(std::string_view name) const { return {name, kNone, this}; }
    ValueName in(std::size_t number) const { return {{}, number, this}; }
    /// "/skeleton/joints/LeftArm/rotate"; "" for no name.
    std::string pointer() const;
    /// Whether `pointer` says this name.
    bool is(std::string_view pointer) const;
};

template <class Visit>
void visitTrackedIn(auto& box, const ValueName& name,
                    const Visit& visit) requires std::is_same_v<std::remove_cvref_t<decltype(box)>, TrackedBox> {
    visit(name.in("min"), box.min);
    visit(name.in("max"), box.max);
}

/// visitTracked for a placement's members, which stand in `name`, or in the node itself.
template <class Kind, class Visit>
void visitTrackedPlacement(Kind& placement, const ValueName* name, const Visit& visit) {
    visit(ValueName{"translate", ValueName::kNone, name}, placement.translate);
    visit(ValueName{"rotate", ValueName::kNone, name}, placement.rotate);
    visit(ValueName{"scale", ValueName::kNone, name}, placement.scale);
    if (placement.matrix) visit(ValueName{"matrix", ValueName::kNone, name}, *placement.matrix);
}

/// visitTracked for the shape of a solid.
template <class Shape, class Visit>
void visitTrackedInShape(Shape& shape, const Visit& visit) {
    using S = std::remove_const_t<Shape>;
    const ValueName outer{"shape"};
    const auto visitRod = [&](std::string_view kind) {
        const ValueName rod = outer.in(kind);
        if constexpr (requires { shape.from; }) {
            visit(rod.in("from"), shape.from);
            visit(rod.in("to"), shape.to);
            visit(rod.in("radius"), shape.radius);
        }
    };
    if constexpr (std::is_same_v<S, SolidSphere>) {
        const ValueName sphere = outer.in("sphere");
        visit(sphere.in("center"), shape.center);
        visit(sphere.in("radius"), shape.radius);
    } else if constexpr (std::is_same_v<S, SolidBox>) {
        visitTrackedIn(shape.box, outer.in("box"), visit);
    } else if constexpr (std::is_same_v<S, SolidCylinder>) {
        visitRod("cylinder");
    } else if constexpr (std::is_same_v<S, SolidCapsule>) {
        visitRod("capsule");
    } else if constexpr (std::is_same_v<S, SolidTorus>) {
        const ValueName torus = outer.in("torus");
        visit(torus.in("center"), shape.center);
        visit(torus.in("axis"), shape.axis);
        visit(torus.in("major"), shape.major);
        visit(torus.in("minor"), shape.minor);
    } else if constexpr (std::is_same_v<S, SolidText>) {
        const ValueName text = outer.in("text");
        visit(text.in("height"), shape.height);
        visit(text.in("depth"), shape.depth);
    } else {
        const ValueName formula = outer.in("expression");
        visitTrackedIn(shape.bounds, formula.in("bounds"), visit);
    }
}

/// visitTracked for what an actor and a `skeleton` STF share.
template <class Rig, class Visit>
void visitTrackedInRig(Rig& rig, const Visit& visit) {
    const ValueName skeleton{"skeleton"};
    const ValueName joints = skeleton.in(rig.skeleton.motion.empty() ? "joints" : "pose");
    for (auto& joint : rig.skeleton.joints) {
        const ValueName name = joints.in(joint.name);
        if (rig.skeleton.motion.empty()) visit(name.in("at"), joint.at);
        visit(name.in("rotate"), joint.rotate);
        visit(name.in("translate"), joint.translate);
    }
    const ValueName fit = skeleton.in("fit"), limbs = skeleton.in("limbs"), motionFit{"motionFit"};
    visitTrackedPlacement(rig.skeleton.fit, &fit, visit);
    for (auto& limb : rig.skeleton.limbs) {
        const ValueName name = limbs.in(limb.name);
        if (limb.size) visit(name.in("size"), *limb.size);
        visit(name.in("offset"), limb.offset);
        visit(name.in("roll"), limb.roll);
        if (limb.pad) visit(name.in("pad"), *limb.pad);
    }
    if (rig.motionFit) visitTrackedPlacement(*rig.motionFit, &motionFit, visit);
}

/// visitTracked for one kind of node; kinds without such values have none.
template <class Kind, class Visit>
void visitTrackedOfKind(Kind& kind, const Visit& visit) {
    using K = std::remove_const_t<Kind>;
    const auto visitOptional = [&](const ValueName& name, auto& value) {
        if (value) visit(name, *value);
    };
    if constexpr (std::is_same_v<K, VolumeObject>) {
        const ValueName appearance{"appearance"};
        visitOptional(appearance.in("color"), kind.appearance.color);
        visitOptional(appearance.in("opacity"), kind.appearance.opacity);
        visitOptional(appearance.in("gradientOpacity"), kind.appearance.gradientOpacity);
    } else if constexpr (std::is_same_v<K, SolidObject>) {
        std::visit([&](auto& shape) { visitTrackedInShape(shape, visit); }, kind.shape);
        visit(ValueName{"color"}, kind.color);
        if (auto* opacity = std::get_if<Tracked<double>>(&kind.opacity)) visit(ValueName{"opacity"}, *opacity);
        visit(ValueName{"falloff"}, kind.falloff);
    } else if constexpr (std::is_same_v<K, FieldsObject>) {
        visitTrackedIn(kind.bounds, ValueName{"bounds"}, visit);
    } else if constexpr (std::is_same_v<K, PlaceObject> || std::is_same_v<K, AffineTransfer>) {
        visitTrackedPlacement(kind.placement, nullptr, visit);
    } else if constexpr (std::is_same_v<K, RecolorObject>) {
        visitOptional(ValueName{"color"}, kind.color);
        visitOptional(ValueName{"opacity"}, kind.opacity);
    } else if constexpr (std::is_same_v<K, ActorObject> || std::is_same_v<K, SkeletonTransfer>) {
        visitTrackedInRig(kind.rig, visit);
    } else if constexpr (std::is_same_v<K, FfdTransfer>) {
        const ValueName moves{"move"};
        for (auto& [point, move] : kind.moves) {
            const ValueName name = moves.in(point);
            visit(name.in(move.absolute ? "to" : "by"), move.vector);
        }
    } else if constexpr (std::is_same_v<K, LibraryTransfer>) {
        for (auto& [name, argument] : kind.arguments) {
            const ValueName member{name};
            if (auto* numbers = std::get_if<Tracked<std::vector<double>>>(&argument)) visit(member, *numbers);
            if (auto* line = std::get_if<LibraryTransfer::Line>(&argument)) {
                visit(member.in("point"), line->point);
                visit(member.in("direction"), line->direction);
            }
        }
    } else if constexpr (std::is_same_v<K, ExpressionTransfer>) {
        visitOptional(ValueName{"image"}, kind.image);
    } else if constexpr (std::is_same_v<K, MappedTransfer>) {
        visit(ValueName{"points"}, kind.points);
        visit(ValueName{"source"}, kind.source);
    } else if constexpr (std::is_same_v<K, NumberField>) {
        visit(ValueName{}, kind.value);
    } else if constexpr (std::is_same_v<K, MappedField>) {
        visit(ValueName{"map"}, kind.table);
    }
}

/// Calls visit(name, value) for every Tracked and TrackedFrame of `node` (of any of the four types) itself, not of
/// nodes within; const where `node` is. All of them have `animated()` and `at(t)`, and can be assigned what `at` gives.
template <class Node, class Visit>
void visitTracked(Node& node, const Visit& visit) {
    std::visit([&](auto& kind) { visitTrackedOfKind(kind, visit); }, node.kind);
    if constexpr (std::is_same_v<std::remove_const_t<Node>, Transfer>) {
        if (node.frame) visit(ValueName{"frame"}, *node.frame);
        visit(ValueName{"amount"}, node.amount);
    }
}

/// The same for the camera, the light and opacityDistance.
template <class SceneType, class Visit>
void visitTrackedSettings(SceneType& scene, const Visit& visit) {
    if (scene.opacityDistance) visit(ValueName{"opacityDistance"}, *scene.opacityDistance);
    if (scene.camera) {
        const ValueName camera{"camera"};
        visit(camera.in("eye"), scene.camera->eye);
        visit(camera.in("target"), scene.camera->target);
        visit(camera.in("up"), scene.camera->up);
        visit(camera.in("fovY"), scene.camera->fovY);
    }
    const ValueName settings{"render"};
    auto& render = scene.render;
    visit(settings.in("background"), render.background);
    visit(settings.in("step"), render.step);
    visit(settings.in("ambient"), render.ambient);
    visit(settings.in("diffuse"), render.diffuse);
    visit(settings.in("specular"), render.specular);
    visit(settings.in("shininess"), render.shininess);
    if (render.light) visit(settings.in("light"), *render.light);
    visit(settings.in("shadows"), render.shadows);
    visit(settings.in("occlusion"), render.occlusion);
    visit(settings.in("occlusionRadius"), render.occlusionRadius);
    visit(settings.in("exposure"), render.exposure);
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
