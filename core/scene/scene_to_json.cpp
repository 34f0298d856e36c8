// A scene as text, members in the order of scene-format.md.
#include "core/scene/scene_to_json.h"

#include "core/scene/json_text.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;
using voledit::toJson;

ordered_json toJson(const ObjectUse& use) {
    return {{"use", use.name}};
}

ordered_json toJson(const VolumeObject& volume) {
    static constexpr const char* words[] = {"linear", "nearest", "cubic"};
    ordered_json result{{"type", "volume"}, {"asset", volume.asset}};
    if (volume.channel != 0) result["channel"] = volume.channel;
    if (volume.interpolation != Interpolation::Linear)
        result["interpolation"] = words[std::size_t(volume.interpolation)];
    if (volume.appearance != Appearance{}) result["appearance"] = toJson(volume.appearance);
    return result;
}

ordered_json shapeToJson(const SolidSphere& s) {
    return {{"sphere", {{"center", toJson(s.center)}, {"radius", toJson(s.radius)}}}};
}
ordered_json shapeToJson(const SolidBox& s) {
    return {{"box", toJson(s.box)}};
}
ordered_json shapeToJson(const SolidCylinder& s) {
    return {{"cylinder", {{"from", toJson(s.from)}, {"to", toJson(s.to)}, {"radius", toJson(s.radius)}}}};
}
ordered_json shapeToJson(const SolidCapsule& s) {
    return {{"capsule", {{"from", toJson(s.from)}, {"to", toJson(s.to)}, {"radius", toJson(s.radius)}}}};
}
ordered_json shapeToJson(const SolidTorus& s) {
    return {{"torus",
             {{"center", toJson(s.center)},
              {"axis", toJson(s.axis)},
              {"major", toJson(s.major)},
              {"minor", toJson(s.minor)}}}};
}
ordered_json shapeToJson(const SolidText& s) {
    return {{"text", {{"string", s.string}, {"height", toJson(s.height)}, {"depth", toJson(s.depth)}}}};
}
ordered_json shapeToJson(const SolidFormula& s) {
    ordered_json shape{{"d", s.d}};
    if (s.bounds != TrackedBox{}) shape["bounds"] = toJson(s.bounds);
    return {{"expression", std::move(shape)}};
}

ordered_json toJson(const SolidObject& solid) {
    ordered_json result{{"type", "solid"}};
    result["shape"] = std::visit([](const auto& shape) { return shapeToJson(shape); }, solid.shape);
    result["color"] = toJson(solid.color);
    if (const auto* formula = std::get_if<std::string>(&solid.opacity))
        result["opacity"] = *formula;
    else
        result["opacity"] = toJson(std::get<Tracked<double>>(solid.opacity));
    if (solid.falloff != Tracked<double>(0)) result["falloff"] = toJson(solid.falloff);
    return result;
}

ordered_json toJson(const FieldsObject& fields) {
    ordered_json result{{"type", "fields"}, {"opacity", toJson(*fields.opacity)}};
    ordered_json& color = result["color"] = ordered_json::array();
    for (const FieldRef& channel : fields.color) color.push_back(toJson(*channel));
    if (fields.bounds != TrackedBox{}) result["bounds"] = toJson(fields.bounds);
    for (const auto& [name, field] : fields.attributes) result[name] = toJson(*field);
    return result;
}

ordered_json toJson(const CvgObject& object) {
    static constexpr const char* words[] = {"union", "intersection", "difference", "merge", "cap", "trim", "blend"};
    ordered_json result{{"type", words[std::size_t(object.by)]}, {"of", listToJson(object.of)}};
    if (object.by == CvgOperator::Blend) result["weight"] = toJson(*object.weight);
    return result;
}

ordered_json toJson(const TransferObject& transfer) {
    static constexpr const char* words[] = {"union", "merge", "intersection", "first"};
    ordered_json result{{"type", "transfer"}, {"by", listToJson(transfer.by)}, {"of", toJson(*transfer.of)}};
    if (transfer.combine != Combine::Union) result["combine"] = words[std::size_t(transfer.combine)];
    return result;
}

ordered_json toJson(const DisplaceObject& displace) {
    return {{"type", "displace"}, {"by", toJson(*displace.by)}, {"of", toJson(*displace.of)}};
}

ordered_json toJson(const PlaceObject& place) {
    ordered_json result{{"type", "place"}};
    add(result, place.placement);
    result["of"] = toJson(*place.of);
    return result;
}

ordered_json toJson(const RecolorObject& recolor) {
    ordered_json result{{"type", "recolor"}};
    if (recolor.from != RecolorObject{}.from) result["from"] = recolor.from;
    if (recolor.color) result["color"] = toJson(*recolor.color);
    if (recolor.opacity) result["opacity"] = toJson(*recolor.opacity);
    result["of"] = toJson(*recolor.of);
    return result;
}

ordered_json toJson(const ActorObject& actor) {
    ordered_json result{{"type", "actor"}};
    if (!actor.name.empty()) result["name"] = actor.name;
    result["of"] = toJson(*actor.of);
    add(result, actor.rig);
    return result;
}

ordered_json toJson(const Asset& asset) {
    static constexpr const char* kinds[] = {"volume", "motion", "images"};
    return {{"kind", kinds[std::size_t(asset.kind)]}, {"path", asset.path}};
}

ordered_json toJson(const TrackedCamera& camera) {
    return {{"eye", toJson(camera.eye)},
            {"target", toJson(camera.target)},
            {"up", toJson(camera.up)},
            {"fovY", toJson(camera.fovY)}};
}

ordered_json toJson(const TrackedRender& settings) {
    static constexpr const char* rigs[] = {"headlight", "key-fill-rim", "soft", "dramatic"};
    static constexpr const char* toneMappings[] = {"none", "filmic"};
    const TrackedRender usual;
    ordered_json json{
        {"background", toJson(settings.background)},
        {"step", toJson(settings.step)},
        {"shading", settings.shading},
        {"ambient", toJson(settings.ambient)},
        {"diffuse", toJson(settings.diffuse)},
        {"specular", toJson(settings.specular)},
        {"shininess", toJson(settings.shininess)},
        {"light", settings.light ? toJson(*settings.light) : ordered_json(rigs[std::size_t(settings.rig)])}};
    // Only what differs from the defaults: earlier programs know none of these.
    const auto add = [&](const char* member, const auto& value, const auto& ofUsual) {
        if (value != ofUsual) json[member] = toJson(value);
    };
    add("shadows", settings.shadows, usual.shadows);
    add("occlusion", settings.occlusion, usual.occlusion);
    add("occlusionRadius", settings.occlusionRadius, usual.occlusionRadius);
    if (settings.toneMapping != usual.toneMapping)
        json["toneMapping"] = toneMappings[std::size_t(settings.toneMapping)];
    add("exposure", settings.exposure, usual.exposure);
    if (settings.transparent) json["transparent"] = true;
    return json;
}

/// A map of named values (plain or shared) under `member`, unless it is empty.
template <class Map, class Value>
void addEntries(ordered_json& json, const char* member, const Map& map, const Value& value) {
    if (map.empty()) return;
    ordered_json& entries = json[member] = ordered_json::object();
    for (const auto& [name, entry] : map) entries[name] = toJson(value(entry));
}

}  // namespace

ordered_json toJson(const Object& object) {
    return std::visit([](const auto& kind) { return toJson(kind); }, object.kind);
}

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
    addEntries(json, "displacements", scene.displacements, shared);
    json["root"] = toJson(*scene.root);
    if (scene.opacityDistance) json["opacityDistance"] = toJson(*scene.opacityDistance);
    if (scene.camera) json["camera"] = toJson(*scene.camera);
    json["render"] = toJson(scene.render);
    json["timeline"] = {{"fps", scene.timeline.fps}, {"start", scene.timeline.start}, {"end", scene.timeline.end}};
    return printJson(json);
}

}  // namespace voledit
