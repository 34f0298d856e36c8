// removeNode: what holds nothing any more goes too, and what holds one thing becomes it.
#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/scene/node_edits.h"
#include "core/scene/scene_children.h"

namespace voledit {

namespace {

/// Places of children that are gone.
using Lost = std::vector<std::pair<std::string, std::size_t>>;

bool lostMember(const Lost& lost, const char* member) {
    return std::any_of(lost.begin(), lost.end(), [&](const auto& place) { return place.first == member; });
}
bool lostElement(const Lost& lost, const char* member, std::size_t element) {
    return std::find(lost.begin(), lost.end(), std::pair(std::string(member), element)) != lost.end();
}

template <class Node>
void eraseLost(std::vector<SharedValue<Node>>& list, const Lost& lost, const char* member) {
    std::size_t n = 0;
    std::erase_if(list, [&](const auto&) { return lostElement(lost, member, n++); });
}

FieldRef zero() {
    return Field{NumberField{0}};
}

/// Limbs that lost an object of their own show the actor's.
void resetLost(SceneSkeleton& skeleton, const Lost& lost) {
    for (std::size_t l = 0; l < skeleton.limbs.size(); ++l)
        if (lostElement(lost, "limbs", l)) skeleton.limbs[l].of.reset();
}

// ---- What is left of a node that lost some of its children; nothing where it cannot do without

std::optional<ObjectRef> left(const Object& object, const Lost& lost) {
    if (const auto* cvg = std::get_if<CvgObject>(&object.kind)) {
        CvgObject rest = *cvg;
        if (lostMember(lost, "weight")) rest.weight = zero();
        eraseLost(rest.of, lost, "of");
        if (rest.of.empty()) return std::nullopt;
        if (rest.of.size() == 1) return rest.of.front();
        return Object{std::move(rest)};
    }
    if (const auto* transfer = std::get_if<TransferObject>(&object.kind)) {
        if (lostMember(lost, "of")) return std::nullopt;
        TransferObject rest = *transfer;
        eraseLost(rest.by, lost, "by");
        if (rest.by.empty()) return rest.of;
        return Object{std::move(rest)};
    }
    if (const auto* displace = std::get_if<DisplaceObject>(&object.kind)) {
        if (lostMember(lost, "of")) return std::nullopt;
        return displace->of;
    }
    if (const auto* actor = std::get_if<ActorObject>(&object.kind)) {
        if (lostMember(lost, "of")) return std::nullopt;
        ActorObject rest = *actor;
        resetLost(rest.rig.skeleton, lost);
        return Object{std::move(rest)};
    }
    if (const auto* fields = std::get_if<FieldsObject>(&object.kind)) {
        FieldsObject rest = *fields;
        if (lostMember(lost, "opacity")) rest.opacity = zero();
        for (std::size_t c = 0; c < 3; ++c)
            if (lostElement(lost, "color", c)) rest.color[c] = zero();
        std::erase_if(rest.attributes, [&](const auto& entry) { return lostMember(lost, entry.first.c_str()); });
        return Object{std::move(rest)};
    }
    return std::nullopt;
}

template <class Fields>
void replaceLost(Fields& fields, const Lost& lost) {
    static constexpr const char* names[] = {"x", "y", "z"};
    for (std::size_t a = 0; a < 3; ++a)
        if (lostMember(lost, names[a])) fields[a] = zero();
}

std::optional<TransferRef> left(const Transfer& transfer, const Lost& lost) {
    Transfer rest = transfer;
    if (auto* sequence = std::get_if<SequenceTransfer>(&rest.kind)) {
        eraseLost(sequence->of, lost, "of");
        if (sequence->of.empty()) return std::nullopt;
        return rest;
    }
    if (auto* transferred = std::get_if<TransferredTransfer>(&rest.kind)) {
        if (lostMember(lost, "of")) return std::nullopt;
        return transferred->of;
    }
    if (auto* fields = std::get_if<FieldsTransfer>(&rest.kind)) replaceLost(fields->fields, lost);
    if (auto* skeleton = std::get_if<SkeletonTransfer>(&rest.kind)) resetLost(skeleton->rig.skeleton, lost);
    return rest;
}

std::optional<DisplacementRef> left(const Displacement& displacement, const Lost& lost) {
    Displacement rest = displacement;
    if (auto* combined = std::get_if<CombinedDisplacement>(&rest.kind)) {
        eraseLost(combined->of, lost, "of");
        if (combined->of.empty()) return std::nullopt;
        if (combined->of.size() == 1) return combined->of.front();
        return rest;
    }
    if (auto* scale = std::get_if<ScaleDisplacement>(&rest.kind)) {
        if (lostMember(lost, "of")) return std::nullopt;
        scale->by = zero();
        return rest;
    }
    if (auto* blend = std::get_if<BlendDisplacement>(&rest.kind)) {
        const bool first = !lostElement(lost, "of", 0), second = !lostElement(lost, "of", 1);
        if (!first && !second) return std::nullopt;
        if (!first) return blend->second;
        if (!second) return blend->first;
        blend->weight = zero();
        return rest;
    }
    if (auto* fields = std::get_if<FieldsDisplacement>(&rest.kind)) {
        replaceLost(fields->fields, lost);
        return rest;
    }
    return std::nullopt;  // `of`, without its STF
}

std::optional<FieldRef> left(const Field&, const Lost&) {
    return std::nullopt;
}

// ---- What comes in the place of a node that is removed: its operand, where that shows what it showed before

std::optional<ObjectRef> operandOf(const Object& object) {
    if (const auto* place = std::get_if<PlaceObject>(&object.kind)) return place->of;
    if (const auto* recolor = std::get_if<RecolorObject>(&object.kind)) return recolor->of;
    if (const auto* transfer = std::get_if<TransferObject>(&object.kind)) return transfer->of;
    if (const auto* actor = std::get_if<ActorObject>(&object.kind)) return actor->of;
    if (const auto* displace = std::get_if<DisplaceObject>(&object.kind)) return displace->of;
    return std::nullopt;
}
std::optional<TransferRef> operandOf(const Transfer&) {
    return std::nullopt;
}
std::optional<DisplacementRef> operandOf(const Displacement& displacement) {
    if (const auto* scale = std::get_if<ScaleDisplacement>(&displacement.kind)) return scale->of;
    return std::nullopt;
}
std::optional<FieldRef> operandOf(const Field& field) {
    if (const auto* map = std::get_if<MappedField>(&field.kind)) return map->of;
    return std::nullopt;
}

/// A component's `of` of type `fields` is read as an STF, whose component is the same field.
FieldRef asWritten(const FieldRef& field) {
    const auto* component = std::get_if<ComponentOf>(&field->kind);
    const auto* of = component ? std::get_if<DisplacementRef>(&component->of) : nullptr;
    const auto* fields = of ? std::get_if<FieldsDisplacement>(&(*of)->kind) : nullptr;
    if (!fields) return field;
    Transfer transfer;
    transfer.kind = FieldsTransfer{fields->fields, "", false};
    return Field{ComponentOf{component->axis, TransferRef(std::move(transfer))}};
}
template <class Node>
const SharedValue<Node>& asWritten(const SharedValue<Node>& node) {
    return node;
}

/// Takes one node and every use of names that are gone out of a scene.
class Removal {
public:
    Removal(Scene& scene, NodePath target) : scene_(scene), target_(std::move(target)) {}

    void run() {
        // Entries that hold nothing any more take their uses with them.
        do {
            changed_ = false;
            const auto root = without(scene_.root, kRootPath);
            if (!root)
                throw Error(target_, "without it the scene would show nothing",
                            "put another object in its place first");
            scene_.root = *root;
            prune(scene_.objects, objects_, objectPath);
            prune(scene_.transfers, transfers_, transferPath);
            prune(scene_.displacements, displacements_, displacementPath);
            target_.clear();
        } while (changed_);
    }

private:
    template <class Map>
    void prune(Map& named, std::set<std::string>& gone, NodePath (*pathOf)(const std::string&)) {
        for (auto entry = named.begin(); entry != named.end();) {
            if (auto kept = without(entry->second, pathOf(entry->first))) {
                entry->second = std::move(*kept);
                ++entry;
                continue;
            }
            gone.insert(entry->first);
            changed_ = true;
            entry = named.erase(entry);
        }
    }

    bool isGone(const Object& node) const {
        const auto* use = std::get_if<ObjectUse>(&node.kind);
        return use && objects_.contains(use->name);
    }
    bool isGone(const Transfer& node) const {
        const auto* use = std::get_if<TransferUse>(&node.kind);
        return use && transfers_.contains(use->name);
    }
    bool isGone(const Displacement& node) const {
        const auto* use = std::get_if<DisplacementUse>(&node.kind);
        return use && displacements_.contains(use->name);
    }
    bool isGone(const Field&) const { return false; }

    /// `node`, which stands at `path`, without what is gone; nothing where that is all of it.
    template <class Node>
    std::optional<SharedValue<Node>> without(const SharedValue<Node>& node, const NodePath& path) {
        if (path == target_) return operandOf(*node);
        if (isGone(*node)) return std::nullopt;
        Lost lost;
        const auto kept = withChildren(node, [&]<class Child>(const ChildStep& step, const Child& child) {
            const auto rest = without(child, childPath(path, step));
            if (!rest) lost.emplace_back(std::string(step.member), step.element);
            return rest.value_or(child);
        });
        return lost.empty() ? std::optional(asWritten(kept)) : left(*kept, lost);
    }

    Scene& scene_;
    NodePath target_;
    std::set<std::string> objects_, transfers_, displacements_;  // names that are gone
    bool changed_ = false;
};

}  // namespace

void removeNode(Scene& scene, const NodePath& path) {
    if (!findObjectAt(scene, path) && !findTransferAt(scene, path) && !findDisplacementAt(scene, path) &&
        !findFieldAt(scene, path))
        throw Error(path, "the scene has nothing there", "it may have been removed");
    Scene result = scene;
    Removal(result, path).run();
    scene = std::move(result);
}

}  // namespace voledit
