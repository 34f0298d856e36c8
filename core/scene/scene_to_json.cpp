// A scene as text, members in the order of scene-format.md.
#include <nlohmann/json.hpp>

#include "core/scene/json_text.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;

ordered_json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}
ordered_json toJson(const Index3& v) {
    return {v.x, v.y, v.z};
}

ordered_json toJson(const PiecewiseLinear& table) {
    ordered_json rows = ordered_json::array();
    for (const Vec2& point : table.points) rows.push_back({point.x, point.y});
    return rows;
}

ordered_json toJson(const ColorTable& table) {
    ordered_json rows = ordered_json::array();
    for (const auto& point : table.points) rows.push_back({point.value, point.color.r, point.color.g, point.color.b});
    return rows;
}

ordered_json toJson(const Appearance& appearance) {
    ordered_json result = ordered_json::object();
    if (!appearance.preset.empty()) result["preset"] = appearance.preset;
    if (appearance.color) result["color"] = toJson(*appearance.color);
    if (appearance.opacity) result["opacity"] = toJson(*appearance.opacity);
    if (appearance.gradientOpacity) result["gradientOpacity"] = toJson(*appearance.gradientOpacity);
    return result;
}

/// As a box where that gives the very same frame back.
ordered_json toJson(const Frame& frame) {
    const Vec3 size{frame.edge[0].x, frame.edge[1].y, frame.edge[2].z};
    const Box3 box{frame.corner, frame.corner + size};
    if (size.x > 0 && size.y > 0 && size.z > 0 && frameOf(box) == frame)
        return {{"min", toJson(box.min)}, {"max", toJson(box.max)}};
    return {{"corner", toJson(frame.corner)},
            {"x", toJson(frame.edge[0])},
            {"y", toJson(frame.edge[1])},
            {"z", toJson(frame.edge[2])}};
}

void add(ordered_json& object, const Placement& placement) {
    const Placement none;
    if (placement.translate != none.translate) object["translate"] = toJson(placement.translate);
    if (placement.rotate != none.rotate) object["rotate"] = toJson(placement.rotate);
    const Vec3& scale = placement.scale;
    if (scale != none.scale)
        object["scale"] = scale.x == scale.y && scale.y == scale.z ? ordered_json(scale.x) : toJson(scale);
    if (!placement.matrix) return;
    ordered_json& matrix = object["matrix"] = ordered_json::array();
    for (int n = 0; n < 16; ++n) matrix.push_back((*placement.matrix)[n % 4][n / 4]);
}

/// `control` where every point has a position of its own, else `move` for those that are not at rest.
void addPoints(ordered_json& object, const FfdTransfer& ffd) {
    const auto count = std::size_t(ffd.points.x) * std::size_t(ffd.points.y) * std::size_t(ffd.points.z);
    bool positions = ffd.moves.size() == count;
    for (const auto& [point, move] : ffd.moves) positions = positions && move.absolute;
    ordered_json list = ordered_json::array();
    for (const auto& [point, move] : ffd.moves) {
        if (positions) {
            list.push_back(toJson(move.vector));
            continue;
        }
        const auto nx = std::size_t(ffd.points.x), ny = std::size_t(ffd.points.y);
        list.push_back({{"point", {point % nx, point / nx % ny, point / nx / ny}},
                        {move.absolute ? "to" : "by", toJson(move.vector)}});
    }
    if (!list.empty()) object[positions ? "control" : "move"] = std::move(list);
}

ordered_json toJson(const Transfer& transfer) {
    if (const auto* use = std::get_if<TransferUse>(&transfer.kind)) return {{"use", use->name}};
    const auto* ffd = std::get_if<FfdTransfer>(&transfer.kind);
    ordered_json result{{"type", ffd ? "ffd" : "affine"}};
    if (!transfer.name.empty()) result["name"] = transfer.name;
    if (ffd) {
        const bool bezier = ffd->basis == LatticeBasis::Bezier;
        result["basis"] = bezier ? "bezier" : "bspline";
        result[bezier ? "degree" : "points"] = toJson(bezier ? ffd->points - Index3(1) : ffd->points);
        addPoints(result, *ffd);
        result["cells"] = toJson(ffd->cells);
    } else {
        add(result, std::get<AffineTransfer>(transfer.kind).placement);
    }
    if (transfer.frame) result["frame"] = toJson(*transfer.frame);
    if (transfer.outside) result["outside"] = *transfer.outside == Outside::Keep ? "keep" : "hide";
    if (!transfer.enabled) result["enabled"] = false;
    if (transfer.amount != 1) result["amount"] = transfer.amount;
    return result;
}

ordered_json toJson(const Object& object);

ordered_json toJson(const ObjectUse& use) {
    return {{"use", use.name}};
}

ordered_json toJson(const VolumeObject& volume) {
    ordered_json result{{"type", "volume"}, {"asset", volume.asset}};
    if (volume.channel != 0) result["channel"] = volume.channel;
    if (volume.appearance != Appearance{}) result["appearance"] = toJson(volume.appearance);
    return result;
}

ordered_json toJson(const PlaceObject& place) {
    ordered_json result{{"type", "place"}};
    add(result, place.placement);
    result["of"] = toJson(*place.of);
    return result;
}

ordered_json toJson(const TransferObject& transfer) {
    ordered_json result{{"type", "transfer"}};
    ordered_json& by = result["by"] = ordered_json::array();
    for (const auto& one : transfer.by) by.push_back(toJson(*one));
    result["of"] = toJson(*transfer.of);
    static constexpr const char* words[] = {"union", "merge", "intersection", "first"};
    if (transfer.combine != Combine::Union) result["combine"] = words[std::size_t(transfer.combine)];
    return result;
}

ordered_json toJson(const Object& object) {
    return std::visit([](const auto& kind) { return toJson(kind); }, object.kind);
}

ordered_json toJson(const Asset& asset) {
    static constexpr const char* kinds[] = {"volume", "motion", "images"};
    return {{"kind", kinds[std::size_t(asset.kind)]}, {"path", asset.path}};
}

ordered_json toJson(const Camera& camera) {
    return {{"eye", toJson(camera.eye)},
            {"target", toJson(camera.target)},
            {"up", toJson(camera.up)},
            {"fovY", camera.fovY}};
}

ordered_json toJson(const RenderSettings& settings) {
    return {{"background", toJson(settings.background)},
            {"step", settings.step},
            {"shading", settings.shading},
            {"ambient", settings.ambient},
            {"diffuse", settings.diffuse},
            {"specular", settings.specular},
            {"shininess", settings.shininess},
            {"light", settings.light ? toJson(*settings.light) : ordered_json("headlight")}};
}

/// A map of named values (plain or shared) under `member`, unless it is empty.
template <class Map, class Value>
void addEntries(ordered_json& json, const char* member, const Map& map, const Value& value) {
    if (map.empty()) return;
    ordered_json& entries = json[member] = ordered_json::object();
    for (const auto& [name, entry] : map) entries[name] = toJson(value(entry));
}

}  // namespace

std::string sceneToJson(const Scene& scene) {
    ordered_json json{{"voledit", 1}};
    const auto itself = [](const auto& value) -> const auto& {
        return value;
    };
    const auto shared = [](const auto& value) -> const auto& {
        return *value;
    };
    addEntries(json, "assets", scene.assets, itself);
    addEntries(json, "objects", scene.objects, shared);
    addEntries(json, "transfers", scene.transfers, shared);
    json["root"] = toJson(*scene.root);
    if (scene.opacityDistance) json["opacityDistance"] = *scene.opacityDistance;
    if (scene.camera) json["camera"] = toJson(*scene.camera);
    json["render"] = toJson(scene.render);
    json["timeline"] = {{"fps", scene.timeline.fps}, {"start", scene.timeline.start}, {"end", scene.timeline.end}};
    return printJson(json);
}

}  // namespace voledit
