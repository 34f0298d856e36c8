#include "core/scene/scene_walk.h"

#include <set>

#include "core/base/error.h"
#include "core/scene/scene_children.h"

namespace voledit {

namespace {

class Walk {
public:
    using Visit = std::function<void(const NodePath&, const NodePointer&)>;
    Walk(const Scene& scene, const Visit& visit) : scene_(scene), visit_(visit) {}

    void run() {
        walk(scene_.root, kRootPath);
        for (const auto& entry : scene_.objects) enter(scene_.objects, objectPath, entry.first);
        for (const auto& entry : scene_.transfers) enter(scene_.transfers, transferPath, entry.first);
        for (const auto& entry : scene_.displacements) enter(scene_.displacements, displacementPath, entry.first);
    }

private:
    template <class Node>
    void walk(const SharedValue<Node>& node, const NodePath& path) {
        visit_(path, &*node);
        follow(*node);
        if (walkedBackwards(*node, path)) return;
        visitChildren(*node, [&](const ChildStep& step, const auto& child) { walk(child, childPath(path, step)); });
    }

    /// Lists of STFs, the last first.
    bool walkedBackwards(const Object& node, const NodePath& path) {
        const auto* transfer = std::get_if<TransferObject>(&node.kind);
        if (!transfer) return false;
        for (std::size_t i = transfer->by.size(); i-- > 0;) walk(transfer->by[i], childPath(path, {"by", i}));
        walk(transfer->of, childPath(path, {"of"}));
        return true;
    }
    bool walkedBackwards(const Transfer& node, const NodePath& path) {
        const auto* sequence = std::get_if<SequenceTransfer>(&node.kind);
        if (!sequence) return false;
        for (std::size_t i = sequence->of.size(); i-- > 0;) walk(sequence->of[i], childPath(path, {"of", i}));
        return true;
    }
    bool walkedBackwards(const Displacement&, const NodePath&) { return false; }
    bool walkedBackwards(const Field&, const NodePath&) { return false; }

    void follow(const Object& node) {
        if (const auto* use = std::get_if<ObjectUse>(&node.kind)) enter(scene_.objects, objectPath, use->name);
    }
    void follow(const Transfer& node) {
        if (const auto* use = std::get_if<TransferUse>(&node.kind)) enter(scene_.transfers, transferPath, use->name);
    }
    void follow(const Displacement& node) {
        if (const auto* use = std::get_if<DisplacementUse>(&node.kind))
            enter(scene_.displacements, displacementPath, use->name);
    }
    void follow(const Field&) {}

    template <class Map>
    void enter(const Map& named, NodePath (*pathOf)(const std::string&), const std::string& name) {
        const auto found = named.find(name);
        if (found == named.end() || !seen_.insert(&found->first).second) return;
        walk(found->second, pathOf(name));
    }

    const Scene& scene_;
    const Visit& visit_;
    std::set<const std::string*> seen_;  // keys of the entries that were entered
};

}  // namespace

void forEachNode(const Scene& scene, const std::function<void(const NodePath&, const NodePointer&)>& visit) {
    Walk(scene, visit).run();
}

void forEachObject(const Scene& scene, const std::function<void(const Object&)>& visit) {
    forEachNode(scene, [&](const NodePath&, const NodePointer& node) {
        if (const auto* object = std::get_if<const Object*>(&node)) visit(**object);
    });
}

void forEachTransfer(const Scene& scene, const std::function<void(const std::string&, const Transfer&)>& visit) {
    std::map<const Transfer*, std::string> entries;
    for (const auto& [name, transfer] : scene.transfers) entries[&*transfer] = name;
    forEachNode(scene, [&](const NodePath&, const NodePointer& node) {
        const auto* transfer = std::get_if<const Transfer*>(&node);
        if (!transfer) return;
        const auto entry = entries.find(*transfer);
        visit(entry == entries.end() ? (*transfer)->name : entry->second, **transfer);
    });
}

NodePath pathOfTransfer(const Scene& scene, const std::string& name) {
    if (name.empty()) return "";
    if (scene.transfers.contains(name)) return transferPath(name);
    for (const auto& [key, transfer] : scene.transfers)
        if (transfer->name == name) return transferPath(key);
    NodePath found;
    forEachNode(scene, [&](const NodePath& path, const NodePointer& node) {
        const auto* transfer = std::get_if<const Transfer*>(&node);
        if (found.empty() && transfer && (*transfer)->name == name) found = path;
    });
    return found;
}

void editTransfer(Scene& scene, const std::string& name, const std::function<void(Transfer&)>& change) {
    const NodePath path = pathOfTransfer(scene, name);
    if (path.empty())
        throw Error("transfer \"" + name + "\"", "the scene has none of this name", "it may have been removed");
    editTransferAt(scene, path, change);
}

}  // namespace voledit
