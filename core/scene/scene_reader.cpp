// A scene file as a whole: its named entries and settings, and the names that they use.
#include "core/scene/scene_reader.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/json_schema.h"
#include "core/scene/limits.h"
#include "core/scene/scene_json.h"

namespace voledit {

using nlohmann::json;

Scene SceneReader::read(const json& value) {
    const JsonView view{value, {}};
    Scene scene;
    const auto forEachEntry = [&](const char* member, const auto& entry) {
        if (!view.has(member)) return;
        const JsonView entries = view[member];
        for (auto item = entries.value.begin(); item != entries.value.end(); ++item)
            entry(item.key(), JsonView{item.value(), entries.place.at(item.key())});
    };
    forEachEntry("assets", [&](const auto& name, const JsonView& e) { scene.assets[name] = asset(e); });
    forEachEntry("transfers", [&](const auto& name, const JsonView&) { namesOfTransfers_.insert(name); });
    forEachEntry("displacements", [&](const auto& name, const JsonView&) { namesOfDisplacements_.insert(name); });
    forEachEntry("objects", [&](const auto& name, const JsonView& e) { scene.objects[name] = object(e); });
    forEachEntry("transfers", [&](const auto& name, const JsonView& e) { scene.transfers[name] = transfer(e); });
    forEachEntry("displacements",
                 [&](const auto& name, const JsonView& e) { scene.displacements[name] = displacement(e); });
    scene.root = object(view["root"]);
    if (view.has("opacityDistance")) scene.opacityDistance = number(view["opacityDistance"]);
    if (view.has("camera")) scene.camera = camera(view["camera"]);
    if (view.has("render")) scene.render = renderSettings(view["render"]);
    if (view.has("timeline")) scene.timeline = timeline(view["timeline"]);
    checkReferences(scene);
    checkGraph(scene, file_);
    return scene;
}

Asset SceneReader::asset(const JsonView& view) const {
    Asset result;
    const std::string& kind = view["kind"].text();
    result.kind = kind == "volume" ? AssetKind::Volume : kind == "motion" ? AssetKind::Motion : AssetKind::Images;
    result.path = view["path"].text();
    checkPath(view["path"]);
    return result;
}

void SceneReader::checkPath(const JsonView& path) const {
    const std::string wrong = checkAssetPath_(path.text());
    if (!wrong.empty())
        throw OutsideFolderError(file_ + ": " + path.place.pointer(), described(path.value) + " " + wrong,
                                 "move the file beside the scene, or open the scene with --allow-outside");
}

void SceneReader::checkReferences(const Scene& scene) const {
    const auto check = [&](const std::vector<Reference>& uses, const auto& named, const std::string& kind,
                           const std::string& member) {
        for (const auto& [name, pointer] : uses) {
            if (named.contains(name)) continue;
            std::vector<std::string> names;
            for (const auto& entry : named) names.push_back(entry.first);
            const std::string nearest = nearestName(name, names);
            throw Error(file_ + ": " + pointer, "there is no " + kind + " " + described(json(name)),
                        nearest.empty() ? "define it in `" + member + "`" : "did you mean \"" + nearest + "\"?");
        }
    };
    check(objectUses_, scene.objects, "object", "objects");
    check(transferUses_, scene.transfers, "transfer", "transfers");
    check(displacementUses_, scene.displacements, "displacement", "displacements");
    check(assetUses_, scene.assets, "asset", "assets");
    check(motionUses_, scene.assets, "asset", "assets");
    checkKinds(scene, assetUses_, AssetKind::Volume, "volume");
    checkKinds(scene, motionUses_, AssetKind::Motion, "motion");
}

void SceneReader::checkKinds(const Scene& scene, const std::vector<Reference>& uses, AssetKind kind,
                             const char* word) const {
    for (const auto& [name, pointer] : uses)
        if (scene.assets.at(name).kind != kind)
            throw Error(file_ + ": " + pointer, "asset " + described(json(name)) + " is not of kind \"" + word + "\"",
                        "name one that is");
}

}  // namespace voledit
