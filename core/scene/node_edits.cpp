#include "core/scene/node_edits.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/edits.h"
#include "core/scene/scene_children.h"

namespace voledit {

std::string uniqueTransferName(const Scene& scene, const std::string& wanted) {
    const std::string base = wanted.empty() ? "transfer" : wanted;
    std::string name = base;
    // A component's `use` looks in transfers and displacements alike.
    for (int n = 2; findTransfer(scene, name) || scene.displacements.contains(name); ++n)
        name = base + " " + std::to_string(n);
    return name;
}

std::string addTransfer(Scene& scene, const NodePath& object, Transfer transfer, const std::string& name,
                        const std::optional<Frame>& frame) {
    const std::string unique = uniqueTransferName(scene, name);
    Transfer use;
    use.kind = TransferUse{unique};
    editObjectAt(scene, object, [&](Object& target) {
        if (auto* list = std::get_if<TransferObject>(&target.kind)) {
            list->by.emplace_back(use);
            return;
        }
        TransferObject wrapped;
        wrapped.by.emplace_back(use);
        wrapped.of = std::move(target);
        target.kind = std::move(wrapped);
    });
    if (frame) transfer.frame = *frame;
    scene.transfers[unique] = std::move(transfer);
    return unique;
}

void wrapObject(Scene& scene, const NodePath& path, Object outer) {
    editObjectAt(scene, path, [&](Object& inner) {
        ObjectRef* slot = nullptr;
        std::visit(
            [&](auto& kind) {
                if constexpr (requires { kind.by, kind.of.front(); }) {
                    if (kind.of.empty()) kind.of.emplace_back();
                    slot = &kind.of.front();
                } else if constexpr (requires { kind.of; }) {
                    slot = &kind.of;
                }
            },
            outer.kind);
        if (!slot)
            throw Error(path, "nothing can be wrapped in an object that takes no operand",
                        "wrap it in a transfer, a place, a recolor or an operator");
        *slot = std::move(inner);
        inner = std::move(outer);
    });
}

NodePath moveTransferInList(Scene& scene, const NodePath& path, int to) {
    const NodePath parent = parentOf(scene, path);
    const std::size_t slash = path.rfind('/');
    const bool element = findTransferAt(scene, path) && slash > parent.size();
    NodePath result = path;
    const auto move = [&](std::vector<TransferRef>& list) {
        const auto from = std::size_t(std::stoul(path.substr(slash + 1)));
        const auto target = std::size_t(std::clamp(to, 0, int(list.size()) - 1));
        const auto begin = list.begin();
        if (from < target)
            std::rotate(begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(from) + 1,
                        begin + std::ptrdiff_t(target) + 1);
        else
            std::rotate(begin + std::ptrdiff_t(target), begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(from) + 1);
        result = path.substr(0, slash + 1) + std::to_string(target);
    };
    const Object* object = findObjectAt(scene, parent);
    const Transfer* transfer = findTransferAt(scene, parent);
    if (element && object && std::holds_alternative<TransferObject>(object->kind))
        editObjectAt(scene, parent, [&](Object& node) { move(std::get<TransferObject>(node.kind).by); });
    else if (element && transfer && std::holds_alternative<SequenceTransfer>(transfer->kind))
        editTransferAt(scene, parent, [&](Transfer& node) { move(std::get<SequenceTransfer>(node.kind).of); });
    else
        throw Error(path, "it is no transfer of a list", "choose one of a `by` list or a sequence");
    return result;
}

namespace {

/// Renames entry `from` of `named` and every Use of it.
template <class Use, class Kind, class Map>
void renameEntry(Scene& scene, Map Scene::*member, const char* kind, const std::string& from, const std::string& to) {
    Map& named = scene.*member;
    const bool takenElsewhere =
        !std::is_same_v<Use, ObjectUse> && (scene.transfers.contains(to) || scene.displacements.contains(to));
    if (!named.contains(from))
        throw Error(std::string(kind) + " \"" + from + "\"", "the scene has none of this name",
                    "it may have been removed");
    if (from == to) return;
    if (to.empty()) throw Error(std::string(kind) + " \"" + from + "\"", "its new name is empty", "give it a name");
    if (named.contains(to) || takenElsewhere)
        throw Error(std::string(kind) + " \"" + from + "\"", "the name \"" + to + "\" is taken", "choose another");
    auto entry = named.extract(from);
    entry.key() = to;
    named.insert(std::move(entry));
    rewriteNodes(scene, [&]<class Node>(const Node& node) -> std::optional<Node> {
        if constexpr (std::is_same_v<Node, Kind>) {
            const auto* use = std::get_if<Use>(&node.kind);
            if (!use || use->name != from) return std::nullopt;
            Node renamed = node;
            renamed.kind = Use{to};
            return renamed;
        }
        return std::nullopt;
    });
}

}  // namespace

void renameObject(Scene& scene, const std::string& from, const std::string& to) {
    renameEntry<ObjectUse, Object>(scene, &Scene::objects, "object", from, to);
}
void renameTransfer(Scene& scene, const std::string& from, const std::string& to) {
    renameEntry<TransferUse, Transfer>(scene, &Scene::transfers, "transfer", from, to);
}
void renameDisplacement(Scene& scene, const std::string& from, const std::string& to) {
    renameEntry<DisplacementUse, Displacement>(scene, &Scene::displacements, "displacement", from, to);
}

void setArgument(Scene& scene, const NodePath& path, const std::string& name, const LibraryTransfer::Argument& value,
                 std::optional<double> time) {
    editTransferAt(scene, path, [&](Transfer& transfer) {
        auto* library = std::get_if<LibraryTransfer>(&transfer.kind);
        if (!library) throw Error(path, "it has no arguments", "choose a transfer of the library or a formula file");
        const auto [entry, isNew] = library->arguments.try_emplace(name, value);
        if (isNew) return;
        using Numbers = Tracked<std::vector<double>>;
        auto* numbers = std::get_if<Numbers>(&entry->second);
        const auto* newNumbers = std::get_if<Numbers>(&value);
        auto* line = std::get_if<LibraryTransfer::Line>(&entry->second);
        const auto* newLine = std::get_if<LibraryTransfer::Line>(&value);
        if (numbers && newNumbers && !newNumbers->animated() && (*numbers)->size() == (*newNumbers)->size()) {
            numbers->set(**newNumbers, time);
        } else if (line && newLine && !newLine->point.animated() && !newLine->direction.animated()) {
            line->point.set(*newLine->point, time);
            line->direction.set(*newLine->direction, time);
        } else {
            entry->second = value;
        }
    });
}

LibraryTransfer::Argument sceneArgument(const TransferParameter& parameter, const TransferArgument& value) {
    if (const auto* line = std::get_if<LineValue>(&value)) return LibraryTransfer::Line{line->point, line->direction};
    if (const auto* axes = std::get_if<std::vector<int>>(&value))
        return LibraryTransfer::Axes{*axes, parameter.kind == TransferParameter::Kind::Axes};
    return Tracked<std::vector<double>>(std::get<std::vector<double>>(value));
}

TransferArgument definitionArgument(const LibraryTransfer::Argument& argument) {
    if (const auto* line = std::get_if<LibraryTransfer::Line>(&argument))
        return LineValue{line->point, line->direction};
    if (const auto* axes = std::get_if<LibraryTransfer::Axes>(&argument)) return axes->axes;
    return *std::get<Tracked<std::vector<double>>>(argument);
}

}  // namespace voledit
