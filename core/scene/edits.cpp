#include "core/scene/edits.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/transfers_in_scene.h"

namespace voledit {

namespace {

std::string uniqueName(const Scene& scene, const std::string& wanted) {
    const std::string base = wanted.empty() ? "transfer" : wanted;
    std::string name = base;
    for (int n = 2; findTransfer(scene, name); ++n) name = base + " " + std::to_string(n);
    return name;
}

FfdTransfer& latticeIn(Transfer& transfer, const std::string& name) {
    if (auto* ffd = std::get_if<FfdTransfer>(&transfer.kind)) return *ffd;
    throw Error("transfer \"" + name + "\"", "it is not a lattice", "choose a transfer of type ffd");
}

void editLattice(Scene& scene, const std::string& name, const std::function<void(FfdTransfer&)>& change) {
    editTransfer(scene, name, [&](Transfer& transfer) { change(latticeIn(transfer, name)); });
}

void checkPoint(const FfdTransfer& ffd, const std::string& name, std::size_t point) {
    const auto count = std::size_t(ffd.points.x) * std::size_t(ffd.points.y) * std::size_t(ffd.points.z);
    if (point >= count)
        throw Error("lattice \"" + name + "\"", "it has no control point " + std::to_string(point),
                    "its " + std::to_string(count) + " points are counted from 0");
}

/// Names in `transfers` that `name` goes by: itself, and aliases that use it.
std::vector<std::string> aliasesOf(const Scene& scene, const std::string& name) {
    std::vector<std::string> names{name};
    for (std::size_t i = 0; i < names.size(); ++i)
        for (const auto& [key, transfer] : scene.transfers)
            if (const auto* use = std::get_if<TransferUse>(&transfer->kind); use && use->name == names[i])
                if (std::find(names.begin(), names.end(), key) == names.end()) names.push_back(key);
    return names;
}

}  // namespace

Scene sceneOfVolume(const std::string& assetPath, const std::string& name, const std::string& preset) {
    Scene scene;
    scene.assets[name] = {AssetKind::Volume, assetPath};
    VolumeObject volume;
    volume.asset = name;
    volume.appearance.preset = preset;
    scene.objects[name] = Object{volume};
    scene.root = Object{ObjectUse{name}};
    return scene;
}

std::string addLattice(Scene& scene, const std::string& name, const FfdTransfer& lattice, const Frame& frame) {
    const std::string unique = uniqueName(scene, name);
    Transfer transfer;
    transfer.kind = lattice;
    transfer.frame = frame;
    scene.transfers[unique] = transfer;

    Transfer use;
    use.kind = TransferUse{unique};
    if (std::holds_alternative<TransferObject>(scene.root->kind)) {
        std::get<TransferObject>(scene.root.edit().kind).by.emplace_back(use);
    } else {
        TransferObject wrapped;
        wrapped.by.emplace_back(use);
        wrapped.of = scene.root;
        scene.root = Object{wrapped};
    }
    return unique;
}

void removeTransfer(Scene& scene, const std::string& name) {
    if (!findTransfer(scene, name))
        throw Error("transfer \"" + name + "\"", "the scene has none of this name", "it may have been removed");
    std::string key = name;
    if (!scene.transfers.contains(name))
        for (const auto& [entry, transfer] : scene.transfers)
            if (transfer->name == name) key = entry;
    const bool named = scene.transfers.contains(key);
    const std::vector<std::string> names = named ? aliasesOf(scene, key) : std::vector<std::string>{};
    const auto gone = [&](const SharedValue<Transfer>& by) {
        if (const auto* use = std::get_if<TransferUse>(&by->kind))
            return std::find(names.begin(), names.end(), use->name) != names.end();
        return !named && by->name == name;
    };
    rewriteObjects(scene, [&](const Object& object) -> std::optional<Object> {
        const auto* transfers = std::get_if<TransferObject>(&object.kind);
        if (!transfers || std::none_of(transfers->by.begin(), transfers->by.end(), gone)) return std::nullopt;
        TransferObject edited = *transfers;
        std::erase_if(edited.by, gone);
        if (edited.by.empty()) return *edited.of;
        return Object{std::move(edited)};
    });
    for (const auto& alias : names) scene.transfers.erase(alias);
}

std::vector<std::string> latticeNames(const Scene& scene) {
    std::vector<std::string> names;
    forEachTransfer(scene, [&](const std::string& name, const Transfer& transfer) {
        if (std::holds_alternative<FfdTransfer>(transfer.kind) && !name.empty()) names.push_back(name);
    });
    return names;
}

const Transfer* findTransfer(const Scene& scene, const std::string& name) {
    if (const auto found = scene.transfers.find(name); found != scene.transfers.end()) return &*found->second;
    for (const auto& [key, transfer] : scene.transfers)
        if (!name.empty() && transfer->name == name) return &*transfer;
    const Transfer* found = nullptr;
    forEachTransfer(scene, [&](const std::string& own, const Transfer& transfer) {
        if (!found && !name.empty() && own == name) found = &transfer;
    });
    return found;
}

Vec3 controlPoint(const Scene& scene, const std::string& name, std::size_t point, const Frame& frame) {
    const Transfer* transfer = findTransfer(scene, name);
    const auto* ffd = transfer ? std::get_if<FfdTransfer>(&transfer->kind) : nullptr;
    if (!ffd) throw Error("lattice \"" + name + "\"", "the scene has none of this name", "it may have been removed");
    checkPoint(*ffd, name, point);
    return latticeOf(*ffd, transfer->frame.value_or(frame)).control[point];
}

void moveControlPoints(Scene& scene, const std::string& name, const std::vector<std::size_t>& points,
                       const Vec3& offset) {
    editLattice(scene, name, [&](FfdTransfer& ffd) {
        for (const std::size_t point : points) {
            checkPoint(ffd, name, point);
            auto& move = ffd.moves[point];
            move.vector = *move.vector + offset;
            if (!move.absolute && *move.vector == Vec3(0)) ffd.moves.erase(point);
        }
    });
}

void setControlPoint(Scene& scene, const std::string& name, std::size_t point, const Vec3& position) {
    editLattice(scene, name, [&](FfdTransfer& ffd) {
        checkPoint(ffd, name, point);
        ffd.moves[point] = {position, true};
    });
}

void resetLattice(Scene& scene, const std::string& name, const std::vector<std::size_t>& points) {
    editLattice(scene, name, [&](FfdTransfer& ffd) {
        if (points.empty()) ffd.moves.clear();
        for (const std::size_t point : points) {
            checkPoint(ffd, name, point);
            ffd.moves.erase(point);
        }
    });
}

void setTransferEnabled(Scene& scene, const std::string& name, bool enabled) {
    editTransfer(scene, name, [&](Transfer& transfer) { transfer.enabled = enabled; });
}

void setTransferAmount(Scene& scene, const std::string& name, double amount) {
    if (!(amount >= 0 && amount <= 1))
        throw Error("transfer \"" + name + "\"", "amount " + std::to_string(amount), "give one from 0 to 1");
    editTransfer(scene, name, [&](Transfer& transfer) { transfer.amount = amount; });
}

void setTransferOutside(Scene& scene, const std::string& name, Outside outside) {
    editTransfer(scene, name, [&](Transfer& transfer) { transfer.outside = outside; });
}

void setAppearance(Scene& scene, const std::string& asset, const Appearance& appearance) {
    if (!findAppearance(scene, asset))
        throw Error("asset \"" + asset + "\"", "no volume object shows it", "name an asset that one shows");
    rewriteObjects(scene, [&](const Object& object) -> std::optional<Object> {
        const auto* volume = std::get_if<VolumeObject>(&object.kind);
        if (!volume || volume->asset != asset) return std::nullopt;
        VolumeObject edited = *volume;
        edited.appearance = appearance;
        return Object{std::move(edited)};
    });
}

const Appearance* findAppearance(const Scene& scene, const std::string& asset) {
    const Appearance* found = nullptr;
    forEachObject(scene, [&](const Object& object) {
        const auto* volume = std::get_if<VolumeObject>(&object.kind);
        if (!found && volume && volume->asset == asset) found = &volume->appearance;
    });
    return found;
}

void setCamera(Scene& scene, const Camera& camera) {
    scene.camera = camera;
}

void setRenderSettings(Scene& scene, const RenderSettings& settings) {
    scene.render = settings;
}

void setOpacityDistance(Scene& scene, double distance) {
    if (!(distance > 0)) throw Error("opacityDistance", std::to_string(distance), "give a length above 0");
    scene.opacityDistance = distance;
}

}  // namespace voledit
