#include "core/scene/transfers_in_scene.h"

#include <set>

#include "core/base/error.h"

namespace voledit {

namespace {

const ObjectRef* innerOf(const Object& object) {
    if (const auto* place = std::get_if<PlaceObject>(&object.kind)) return &place->of;
    if (const auto* transfer = std::get_if<TransferObject>(&object.kind)) return &transfer->of;
    return nullptr;
}

class ObjectWalk {
public:
    ObjectWalk(const Scene& scene, const std::function<void(const Object&)>& visit) : scene_(scene), visit_(visit) {}

    void walk(const Object& object) {
        visit_(object);
        if (const auto* use = std::get_if<ObjectUse>(&object.kind)) walkNamed(use->name);
        if (const ObjectRef* inner = innerOf(object)) walk(**inner);
    }
    void walkNamed(const std::string& name) {
        const auto found = scene_.objects.find(name);
        if (found != scene_.objects.end() && seen_.insert(name).second) walk(*found->second);
    }

private:
    const Scene& scene_;
    const std::function<void(const Object&)>& visit_;
    std::set<std::string> seen_;
};

ObjectRef rewritten(const ObjectRef& ref, const std::function<std::optional<Object>(const Object&)>& change) {
    ObjectRef result = ref;
    if (const ObjectRef* inner = innerOf(*ref)) {
        const ObjectRef changed = rewritten(*inner, change);
        if (!changed.sharesWith(*inner)) {
            Object& object = result.edit();
            if (auto* place = std::get_if<PlaceObject>(&object.kind)) place->of = changed;
            if (auto* transfer = std::get_if<TransferObject>(&object.kind)) transfer->of = changed;
        }
    }
    if (auto replacement = change(*result)) return ObjectRef(std::move(*replacement));
    return result;
}

}  // namespace

void forEachObject(const Scene& scene, const std::function<void(const Object&)>& visit) {
    ObjectWalk walk(scene, visit);
    walk.walk(*scene.root);
    for (const auto& entry : scene.objects) walk.walkNamed(entry.first);
}

void rewriteObjects(Scene& scene, const std::function<std::optional<Object>(const Object&)>& change) {
    scene.root = rewritten(scene.root, change);
    for (auto& [name, object] : scene.objects) object = rewritten(object, change);
}

void forEachTransfer(const Scene& scene, const std::function<void(const std::string&, const Transfer&)>& visit) {
    std::set<std::string> seen;
    const std::function<void(const std::string&, const Transfer&)> walk = [&](const std::string& key,
                                                                              const Transfer& transfer) {
        visit(key.empty() ? transfer.name : key, transfer);
        const auto* use = std::get_if<TransferUse>(&transfer.kind);
        if (!use) return;
        const auto found = scene.transfers.find(use->name);
        if (found != scene.transfers.end() && seen.insert(use->name).second) walk(use->name, *found->second);
    };
    forEachObject(scene, [&](const Object& object) {
        if (const auto* transfer = std::get_if<TransferObject>(&object.kind))
            for (auto by = transfer->by.rbegin(); by != transfer->by.rend(); ++by) walk("", **by);
    });
    for (const auto& [name, transfer] : scene.transfers)
        if (seen.insert(name).second) walk(name, *transfer);
}

void editTransfer(Scene& scene, const std::string& name, const std::function<void(Transfer&)>& change) {
    if (const auto found = scene.transfers.find(name); found != scene.transfers.end()) {
        change(found->second.edit());
        return;
    }
    for (auto& [key, transfer] : scene.transfers) {
        if (transfer->name != name) continue;
        change(transfer.edit());
        return;
    }
    bool done = false;
    rewriteObjects(scene, [&](const Object& object) -> std::optional<Object> {
        const auto* transfers = std::get_if<TransferObject>(&object.kind);
        for (std::size_t i = 0; transfers && !done && i < transfers->by.size(); ++i) {
            if (transfers->by[i]->name != name) continue;
            TransferObject edited = *transfers;
            change(edited.by[i].edit());
            done = true;
            return Object{std::move(edited)};
        }
        return std::nullopt;
    });
    if (!done) throw Error("transfer \"" + name + "\"", "the scene has none of this name", "it may have been removed");
}

}  // namespace voledit
