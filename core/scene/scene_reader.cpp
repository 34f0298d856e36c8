// Objects and transfers of a scene file.
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
    forEachEntry("displacements", [&](const auto&, const JsonView& e) {
        notBuilt(e.place, "displacements", "use transfers of type affine or ffd");
    });
    forEachEntry("objects", [&](const auto& name, const JsonView& e) { scene.objects[name] = object(e); });
    forEachEntry("transfers", [&](const auto& name, const JsonView& e) { scene.transfers[name] = transfer(e); });
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
    const auto& kind = view.value["kind"].get_ref<const std::string&>();
    result.kind = kind == "volume" ? AssetKind::Volume : kind == "motion" ? AssetKind::Motion : AssetKind::Images;
    result.path = view.value["path"].get<std::string>();
    const std::string wrong = checkAssetPath_(result.path);
    if (!wrong.empty())
        throw OutsideFolderError(file_ + ": " + view["path"].place.pointer(),
                                 described(view.value["path"]) + " " + wrong,
                                 "move the file beside the scene, or open the scene with --allow-outside");
    return result;
}

Object SceneReader::object(const JsonView& view) {
    if (view.has("use")) {
        objectUses_.push_back({view.value["use"].get<std::string>(), view["use"].place.pointer()});
        return {ObjectUse{objectUses_.back().name}};
    }
    const auto& type = view.value["type"].get_ref<const std::string&>();
    if (type == "volume") return {volume(view)};
    if (type == "transfer") return {transferObject(view)};
    if (type == "place") {
        PlaceObject place;
        place.placement = placement(view);
        place.of = object(view["of"]);
        return {std::move(place)};
    }
    notBuilt(view.place, "objects of type \"" + type + "\"", "use volume, place and transfer");
}

VolumeObject SceneReader::volume(const JsonView& view) {
    VolumeObject result;
    const JsonView asset = view["asset"];
    result.asset = asset.value.get<std::string>();
    assetUses_.push_back({result.asset, asset.place.pointer()});
    if (view.has("channel")) result.channel = view.value["channel"].get<int>();
    if (view.has("interpolation") && view.value["interpolation"] != "linear")
        notBuilt(view["interpolation"].place, "volumes of interpolation " + described(view.value["interpolation"]),
                 "use \"linear\"");
    if (view.has("appearance")) result.appearance = appearance(view["appearance"]);
    return result;
}

TransferObject SceneReader::transferObject(const JsonView& view) {
    TransferObject result;
    const JsonView by = view["by"];
    if (by.value.is_array() && by.value.size() > kDeepestNesting)
        fail(by.place,
             "found " + described(by.value) + "; a transfer applies at most " + std::to_string(kDeepestNesting),
             "join some of them");
    if (by.value.is_array())
        for (std::size_t i = 0; i < by.value.size(); ++i) result.by.emplace_back(transfer(by[i]));
    else
        result.by.emplace_back(transfer(by));
    if (view.has("combine")) {
        static const std::vector<std::string> words{"union", "merge", "intersection", "first"};
        const auto word = std::find(words.begin(), words.end(), view.value["combine"].get<std::string>());
        result.combine = static_cast<Combine>(word - words.begin());
    }
    result.of = object(view["of"]);
    return result;
}

Transfer SceneReader::transfer(const JsonView& view) {
    Transfer result;
    if (view.has("use") && !view.has("type")) {
        transferUses_.push_back({view.value["use"].get<std::string>(), view["use"].place.pointer()});
        result.kind = TransferUse{transferUses_.back().name};
        return result;
    }
    const JsonView type = view["type"];
    if (type.value == "affine") {
        result.kind = AffineTransfer{placement(view)};
    } else if (type.value == "ffd") {
        result.kind = lattice(view);
    } else if (type.value.is_object()) {
        notBuilt(type.place, "formula files", "use transfers of type affine or ffd");
    } else {
        static const std::vector<std::string> contract{
            "split", "dissect",         "open",    "insideOut", "squeeze",    "twist",  "taper",
            "bend",  "rotationalSweep", "deflect", "affine",    "expression", "fields", "ffd",
            "sweep", "skeleton",        "mapped",  "sequence",  "transferred"};
        const auto& word = type.value.get_ref<const std::string&>();
        if (std::find(contract.begin(), contract.end(), word) != contract.end())
            notBuilt(type.place, "transfers of type \"" + word + "\"", "use affine or ffd");
        const std::string nearest = nearestName(word, contract);
        fail(type.place, "found " + described(type.value) + ", which is no type of transfer that voledit knows",
             nearest.empty() ? "use affine or ffd" : "did you mean \"" + nearest + "\"?");
    }
    if (view.has("name")) result.name = view.value["name"].get<std::string>();
    if (view.has("frame")) result.frame = frame(view["frame"]);
    if (view.has("outside")) result.outside = view.value["outside"] == "keep" ? Outside::Keep : Outside::Hide;
    if (view.has("enabled")) result.enabled = view.value["enabled"].get<bool>();
    if (view.has("amount")) result.amount = number(view["amount"]);
    return result;
}

FfdTransfer SceneReader::lattice(const JsonView& view) {
    FfdTransfer ffd;
    if (view.has("basis") && view.value["basis"] == "bspline") {
        ffd.basis = LatticeBasis::BSpline;
        ffd.points = indices(view["points"]);
    } else if (view.has("degree")) {
        ffd.points = indices(view["degree"]) + Index3(1);
    }
    if (view.has("cells")) ffd.cells = indices(view["cells"]);
    cells_ += double(ffd.cells.x) * ffd.cells.y * ffd.cells.z;
    if (cells_ > double(kMostCells))
        fail(view.has("cells") ? view["cells"].place : view.place,
             "the scene's lattices have " + std::to_string(std::uint64_t(cells_)) + " cells, more than the " +
                 std::to_string(kMostCells) + " that fit",
             "give fewer cells an axis (16 is the default)");
    controlPoints_ += double(ffd.points.x) * ffd.points.y * ffd.points.z;
    if (controlPoints_ > double(kMostControlPoints))
        fail(view.place,
             "the scene's lattices have more than the " + std::to_string(kMostControlPoints) +
                 " control points that fit",
             "give fewer points an axis");
    if (view.has("control")) readControl(ffd, view["control"]);
    if (view.has("move")) readMoves(ffd, view["move"]);
    return ffd;
}

void SceneReader::readControl(FfdTransfer& ffd, const JsonView& view) const {
    if (view.value.is_object()) notBuilt(view.place, "tracks", "write a plain list in place of the keys");
    const auto count = std::size_t(ffd.points.x) * std::size_t(ffd.points.y) * std::size_t(ffd.points.z);
    if (view.value.size() != count)
        fail(view.place,
             "found " + described(view.value) + "; a lattice of " + std::to_string(ffd.points.x) + " × " +
                 std::to_string(ffd.points.y) + " × " + std::to_string(ffd.points.z) + " control points has " +
                 std::to_string(count),
             "list every control point, i fastest, or use `move`");
    for (std::size_t i = 0; i < count; ++i) ffd.moves[i] = {vector(view[i]), true};
}

void SceneReader::readMoves(FfdTransfer& ffd, const JsonView& view) const {
    for (std::size_t m = 0; m < view.value.size(); ++m) {
        const JsonView move = view[m];
        const JsonView at = move["point"];
        const Index3 point = indices(at);
        for (std::size_t a = 0; a < 3; ++a)
            if (point[int(a)] >= ffd.points[int(a)])
                fail(at[a].place,
                     "found " + std::to_string(point[int(a)]) + "; the lattice has control points 0 to " +
                         std::to_string(ffd.points[int(a)] - 1) + " along " + "xyz"[a],
                     "name a point within it");
        const auto index =
            std::size_t(point.x) +
            std::size_t(ffd.points.x) * (std::size_t(point.y) + std::size_t(ffd.points.y) * std::size_t(point.z));
        const bool absolute = move.has("to");
        if (!ffd.moves.try_emplace(index, FfdTransfer::Move{vector(move[absolute ? "to" : "by"]), absolute}).second)
            fail(move.place, "this control point is moved twice", "join the two moves");
    }
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
    check(assetUses_, scene.assets, "asset", "assets");
    for (const auto& [name, pointer] : assetUses_)
        if (scene.assets.at(name).kind != AssetKind::Volume)
            throw Error(file_ + ": " + pointer, "asset " + described(json(name)) + " is not of kind \"volume\"",
                        "name one that is");
}

}  // namespace voledit
