#include "core/scene/nodes.h"

#include <charconv>
#include <optional>

#include "core/base/error.h"
#include "core/scene/json_text.h"
#include "core/scene/scene_children.h"

namespace voledit {

namespace {

/// The first token of a JSON pointer, unescaped, which is taken off its front; nullopt where none is left.
std::optional<std::string> takeToken(std::string_view& pointer) {
    if (pointer.empty() || pointer[0] != '/') return std::nullopt;
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    std::string token;
    for (std::size_t i = 1; i < end; ++i) {
        const bool escaped = pointer[i] == '~' && i + 1 < end && (pointer[i + 1] == '0' || pointer[i + 1] == '1');
        token += escaped ? (pointer[++i] == '0' ? '~' : '/') : pointer[i];
    }
    pointer.remove_prefix(end);
    return token;
}

/// Where the way to `pointer` leads on from a node: the child that its front names, which is taken off. The element
/// kNone matches members only.
bool takeStep(std::string_view& pointer, const ChildStep& step) {
    std::string_view rest = pointer;
    if (!step.outer.empty() && takeToken(rest) != step.outer) return false;
    if (takeToken(rest) != step.member) return false;
    if (step.element != ChildStep::kNone) {
        const auto token = takeToken(rest);
        if (token != std::to_string(step.element)) return false;
    }
    if (!step.inner.empty() && takeToken(rest) != step.inner) return false;
    pointer = rest;
    return true;
}

/// Calls found(node) on the node of type Wanted at `pointer`, seen from `node`; false where there is none.
template <class Wanted, class Node, class Found>
bool reach(const SharedValue<Node>& node, std::string_view pointer, const Found& found) {
    if (pointer.empty()) {
        if constexpr (std::is_same_v<Node, Wanted>) {
            found(*node);
            return true;
        }
        return false;
    }
    bool reached = false, passed = false;
    visitChildren(*node, [&](const ChildStep& step, const auto& child) {
        std::string_view rest = pointer;
        if (passed || !takeStep(rest, step)) return;
        passed = true;
        reached = reach<Wanted>(child, rest, found);
    });
    return reached;
}

/// The same for changing. Only called where `reach` finds it, so that nothing is unshared in vain.
template <class Wanted, class Node, class Change>
void reachForEdit(SharedValue<Node>& node, std::string_view pointer, const Change& change) {
    if (pointer.empty()) {
        if constexpr (std::is_same_v<Node, Wanted>) change(node.edit());
        return;
    }
    bool passed = false;
    visitChildren(node.edit(), [&](const ChildStep& step, auto& child) {
        std::string_view rest = pointer;
        if (passed || !takeStep(rest, step)) return;
        passed = true;
        reachForEdit<Wanted>(child, rest, change);
    });
}

/// Calls use(ref, rest) with the root or entry that `path` starts at; false where there is none.
template <class SceneType, class Use>
bool atTop(SceneType& scene, const NodePath& path, const Use& use) {
    std::string_view rest = path;
    const auto top = takeToken(rest);
    if (top == "root") return use(scene.root, rest);
    const auto name = takeToken(rest);
    if (!name) return false;
    const auto inMap = [&](auto& named) {
        const auto found = named.find(*name);
        return found != named.end() && use(found->second, rest);
    };
    if (top == "objects") return inMap(scene.objects);
    if (top == "transfers") return inMap(scene.transfers);
    if (top == "displacements") return inMap(scene.displacements);
    return false;
}

template <class Wanted>
const Wanted* findAt(const Scene& scene, const NodePath& path) {
    const Wanted* found = nullptr;
    atTop(scene, path, [&](const auto& top, std::string_view rest) {
        return reach<Wanted>(top, rest, [&](const Wanted& node) { found = &node; });
    });
    return found;
}

template <class Wanted>
void editAt(Scene& scene, const NodePath& path, const char* what, const std::function<void(Wanted&)>& change) {
    if (!findAt<Wanted>(scene, path))
        throw Error(path, std::string("the scene has no ") + what + " there", "it may have been removed");
    atTop(scene, path, [&](auto& top, std::string_view rest) {
        reachForEdit<Wanted>(top, rest, change);
        return true;
    });
}

}  // namespace

std::string pointerToken(const std::string& name) {
    std::string token;
    for (const char c : name) token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return token;
}

std::string ValueName::pointer() const {
    std::string result = outer ? outer->pointer() : "";
    if (!member.empty()) result += "/" + pointerToken(std::string(member));
    if (index != kNone) result += "/" + std::to_string(index);
    return result;
}

bool ValueName::is(std::string_view pointer) const {
    const auto take = [&](const std::string& token) {
        if (!pointer.ends_with(token)) return false;
        pointer.remove_suffix(token.size());
        if (!pointer.ends_with('/')) return false;
        pointer.remove_suffix(1);
        return true;
    };
    if (index != kNone && !take(std::to_string(index))) return false;
    if (!member.empty() && !take(pointerToken(std::string(member)))) return false;
    return outer ? outer->is(pointer) : pointer.empty();
}

NodePath objectPath(const std::string& name) {
    return "/objects/" + pointerToken(name);
}
NodePath transferPath(const std::string& name) {
    return "/transfers/" + pointerToken(name);
}
NodePath displacementPath(const std::string& name) {
    return "/displacements/" + pointerToken(name);
}

NodePath childPath(const NodePath& path, const ChildStep& step) {
    NodePath child = path;
    if (!step.outer.empty()) child += "/" + pointerToken(std::string(step.outer));
    child += "/" + pointerToken(std::string(step.member));
    if (step.element != ChildStep::kNone) child += "/" + std::to_string(step.element);
    if (!step.inner.empty()) child += "/" + pointerToken(std::string(step.inner));
    return child;
}

NodePath parentOf(const Scene& scene, const NodePath& path) {
    const auto standsAt = [&](const NodePath& at) {
        return findAt<Object>(scene, at) || findAt<Transfer>(scene, at) || findAt<Displacement>(scene, at) ||
               findAt<Field>(scene, at);
    };
    // A step takes a token or, within a list, two; that to a limb's `of` takes four.
    NodePath parent = path;
    for (int n = 0; n < 4; ++n) {
        const std::size_t slash = parent.rfind('/');
        if (slash == std::string::npos) return "";
        parent.erase(slash);
        if (standsAt(parent)) return parent;
    }
    return "";
}

const Object* findObjectAt(const Scene& scene, const NodePath& path) {
    return findAt<Object>(scene, path);
}
const Transfer* findTransferAt(const Scene& scene, const NodePath& path) {
    return findAt<Transfer>(scene, path);
}
const Displacement* findDisplacementAt(const Scene& scene, const NodePath& path) {
    return findAt<Displacement>(scene, path);
}
const Field* findFieldAt(const Scene& scene, const NodePath& path) {
    return findAt<Field>(scene, path);
}

NodePath followedUse(const Scene& scene, const NodePath& path) {
    NodePath at = path;
    const std::size_t entries = scene.objects.size() + scene.transfers.size() + scene.displacements.size();
    // In a circle no name is reached that was not before.
    for (std::size_t steps = 0; steps <= entries; ++steps) {
        if (const Object* object = findObjectAt(scene, at)) {
            const auto* use = std::get_if<ObjectUse>(&object->kind);
            if (!use) return at;
            at = objectPath(use->name);
        } else if (const Transfer* transfer = findTransferAt(scene, at)) {
            const auto* use = std::get_if<TransferUse>(&transfer->kind);
            if (!use) return at;
            at = transferPath(use->name);
        } else if (const Displacement* displacement = findDisplacementAt(scene, at)) {
            const auto* use = std::get_if<DisplacementUse>(&displacement->kind);
            if (!use) return at;
            at = displacementPath(use->name);
        } else {
            return findFieldAt(scene, at) ? at : "";
        }
    }
    return "";
}

void editObjectAt(Scene& scene, const NodePath& path, const std::function<void(Object&)>& change) {
    editAt<Object>(scene, path, "object", change);
}
void editTransferAt(Scene& scene, const NodePath& path, const std::function<void(Transfer&)>& change) {
    editAt<Transfer>(scene, path, "transfer", change);
}
void editDisplacementAt(Scene& scene, const NodePath& path, const std::function<void(Displacement&)>& change) {
    editAt<Displacement>(scene, path, "displacement", change);
}
void editFieldAt(Scene& scene, const NodePath& path, const std::function<void(Field&)>& change) {
    editAt<Field>(scene, path, "scalar field", change);
}

}  // namespace voledit
