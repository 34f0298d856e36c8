#include "core/scene/edits.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/node_edits.h"
#include "core/scene/scene_children.h"
#include "core/scene/scene_walk.h"

namespace voledit {

namespace {

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

/// Adds `offset` at every time.
void shift(Tracked<Vec3>& vector, const Vec3& offset) {
    std::vector<PartTrack> tracks = vector.tracks();
    for (auto& [part, track] : tracks)
        for (auto& key : track.keys)
            for (std::size_t n = 0; n < key.value.size(); ++n) key.value[n] += offset[std::max(part, 0) + int(n)];
    vector = *vector + offset;
    vector.setTracks(std::move(tracks));
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
    Transfer transfer;
    transfer.kind = lattice;
    return addTransfer(scene, kRootPath, std::move(transfer), name, frame);
}

void removeTransfer(Scene& scene, const std::string& name) {
    const NodePath path = pathOfTransfer(scene, name);
    if (path.empty())
        throw Error("transfer \"" + name + "\"", "the scene has none of this name", "it may have been removed");
    removeNode(scene, path);
}

std::vector<std::string> latticeNames(const Scene& scene) {
    std::vector<std::string> names;
    forEachTransfer(scene, [&](const std::string& name, const Transfer& transfer) {
        if (std::holds_alternative<FfdTransfer>(transfer.kind) && !name.empty()) names.push_back(name);
    });
    return names;
}

const Transfer* findTransfer(const Scene& scene, const std::string& name) {
    return findTransferAt(scene, pathOfTransfer(scene, name));
}

Vec3 controlPoint(const Scene& scene, const std::string& name, std::size_t point, const Frame& frame) {
    const Transfer* transfer = findTransfer(scene, name);
    const auto* ffd = transfer ? std::get_if<FfdTransfer>(&transfer->kind) : nullptr;
    if (!ffd) throw Error("lattice \"" + name + "\"", "the scene has none of this name", "it may have been removed");
    checkPoint(*ffd, name, point);
    return latticeOf(*ffd, transfer->frame.value_or(frame)).control[point];
}

void moveControlPoints(Scene& scene, const std::string& name, const std::vector<std::size_t>& points,
                       const Vec3& offset, const When& when) {
    editLattice(scene, name, [&](FfdTransfer& ffd) {
        for (const std::size_t point : points) {
            checkPoint(ffd, name, point);
            auto& move = ffd.moves[point];
            if (when.time)
                setWhen(move.vector, move.vector.at(*when.time) + offset, when);
            else
                shift(move.vector, offset);
            if (!move.absolute && move.vector == Vec3(0)) ffd.moves.erase(point);
        }
    });
}

void setControlPoint(Scene& scene, const std::string& name, std::size_t point, const Vec3& position, const When& when) {
    editLattice(scene, name, [&](FfdTransfer& ffd) {
        checkPoint(ffd, name, point);
        auto& move = ffd.moves[point];
        // Keys that hold displacements would not be positions.
        if (!move.absolute) move = {position, true};
        setWhen(move.vector, position, when);
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

void setTransferAmount(Scene& scene, const std::string& name, double amount, const When& when) {
    if (!(amount >= 0 && amount <= 1))
        throw Error("transfer \"" + name + "\"", "amount " + std::to_string(amount), "give one from 0 to 1");
    editTransfer(scene, name, [&](Transfer& transfer) { setWhen(transfer.amount, amount, when); });
}

void setTransferOutside(Scene& scene, const std::string& name, Outside outside) {
    editTransfer(scene, name, [&](Transfer& transfer) { transfer.outside = outside; });
}

void setAppearance(Scene& scene, const std::string& asset, const Appearance& appearance) {
    if (!findAppearance(scene, asset))
        throw Error("asset \"" + asset + "\"", "no volume object shows it", "name an asset that one shows");
    rewriteNodes(scene, [&]<class Node>(const Node& node) -> std::optional<Node> {
        if constexpr (std::is_same_v<Node, Object>) {
            const auto* volume = std::get_if<VolumeObject>(&node.kind);
            if (!volume || volume->asset != asset || volume->appearance == appearance) return std::nullopt;
            VolumeObject edited = *volume;
            edited.appearance = appearance;
            return Object{std::move(edited)};
        }
        return std::nullopt;
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

namespace {

/// Tracks stay where the value is what they say then, or what their first keys say.
template <class T>
void setUnlessEqual(Tracked<T>& tracked, const T& value, const When& when = {}) {
    const T now = when.time ? tracked.at(*when.time) : *tracked;
    if (now != value) setWhen(tracked, value, when);
}

}  // namespace

void setCamera(Scene& scene, const Camera& camera) {
    if (!scene.camera) scene.camera = camera;
    setUnlessEqual(scene.camera->eye, camera.eye);
    setUnlessEqual(scene.camera->target, camera.target);
    setUnlessEqual(scene.camera->up, camera.up);
    setUnlessEqual(scene.camera->fovY, camera.fovY);
}

void setRenderSettings(Scene& scene, const RenderSettings& settings, const When& when) {
    TrackedRender& render = scene.render;
    setUnlessEqual(render.background, settings.background, when);
    setUnlessEqual(render.step, settings.step, when);
    render.shading = settings.shading;
    setUnlessEqual(render.ambient, settings.ambient, when);
    setUnlessEqual(render.diffuse, settings.diffuse, when);
    setUnlessEqual(render.specular, settings.specular, when);
    setUnlessEqual(render.shininess, settings.shininess, when);
    render.rig = settings.rig;
    setUnlessEqual(render.shadows, settings.shadows, when);
    setUnlessEqual(render.occlusion, settings.occlusion, when);
    setUnlessEqual(render.occlusionRadius, settings.occlusionRadius, when);
    render.toneMapping = settings.toneMapping;
    setUnlessEqual(render.exposure, settings.exposure, when);
    render.transparent = settings.transparent;
    if (!settings.light)
        render.light.reset();
    else if (!render.light)
        render.light = *settings.light;
    else
        setUnlessEqual(*render.light, *settings.light, when);
}

void setOpacityDistance(Scene& scene, double distance, const When& when) {
    if (!(distance > 0)) throw Error("opacityDistance", std::to_string(distance), "give a length above 0");
    if (!scene.opacityDistance) scene.opacityDistance = distance;
    setWhen(*scene.opacityDistance, distance, when);
}

}  // namespace voledit
