// Objects of a scene file.
#include <algorithm>

#include "core/scene/json_schema.h"
#include "core/scene/limits.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

/// Index of `word`, which the schema knows to be there, in `words`.
template <class Enum>
Enum choice(const std::string& word, const std::vector<std::string>& words) {
    return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

}  // namespace

Object SceneReader::object(const JsonView& view) {
    if (view.has("use") && !view.has("type")) {
        objectUses_.push_back({view["use"].text(), view["use"].place.pointer()});
        return {ObjectUse{objectUses_.back().name}};
    }
    static const std::vector<std::string> operators{"union", "intersection", "difference", "merge",
                                                    "cap",   "trim",         "blend"};
    const std::string& type = view["type"].text();
    if (type == "volume") return {volume(view)};
    if (type == "solid") return {solid(view)};
    if (type == "fields") return {fieldsObject(view)};
    if (type == "transfer") return {transferObject(view)};
    if (type == "displace") return {DisplaceObject{displacement(view["by"]), object(view["of"])}};
    if (type == "place") return {PlaceObject{placement(view), object(view["of"])}};
    if (type == "recolor") return {recolor(view)};
    if (type == "actor") return {actor(view)};
    if (std::find(operators.begin(), operators.end(), type) != operators.end())
        return {cvgObject(view, choice<CvgOperator>(type, operators))};
    notBuilt(view.place, "objects of type \"" + type + "\"", "use other types");
}

VolumeObject SceneReader::volume(const JsonView& view) {
    VolumeObject result;
    result.asset = volumeAsset(view["asset"]);
    if (view.has("channel")) result.channel = view.value["channel"].get<int>();
    if (view.has("interpolation"))
        result.interpolation = choice<Interpolation>(view["interpolation"].text(), {"linear", "nearest", "cubic"});
    if (view.has("appearance")) result.appearance = appearance(view["appearance"]);
    return result;
}

SolidObject SceneReader::solid(const JsonView& view) {
    SolidObject result;
    const JsonView shapes = view["shape"];
    const std::string kind = shapes.value.begin().key();
    const JsonView shape = shapes[kind.c_str()];
    const auto ends = [&](auto rod) {
        rod.from = vector(shape["from"]);
        rod.to = vector(shape["to"]);
        rod.radius = number(shape["radius"]);
        if (!rod.from.animated() && !rod.to.animated() && *rod.from == *rod.to)
            fail(shape.place, "the " + kind + "'s ends are one point", "move one of them");
        return rod;
    };
    if (kind == "sphere") {
        result.shape = SolidSphere{vector(shape["center"]), number(shape["radius"])};
    } else if (kind == "box") {
        result.shape = SolidBox{box(shape, "the box")};
    } else if (kind == "cylinder") {
        result.shape = ends(SolidCylinder{});
    } else if (kind == "capsule") {
        result.shape = ends(SolidCapsule{});
    } else if (kind == "torus") {
        result.shape = SolidTorus{vector(shape["center"]), direction(shape["axis"]), number(shape["major"]),
                                  number(shape["minor"])};
    } else if (kind == "text") {
        result.shape = SolidText{shape["string"].text(), number(shape["height"]), number(shape["depth"])};
    } else {
        SolidFormula of{formula(shape["d"], "xyz"), {}};
        if (shape.has("bounds")) of.bounds = box(shape["bounds"], "the bounds");
        result.shape = std::move(of);
    }
    result.color = vector(view["color"]);
    const JsonView opacity = view["opacity"];
    if (opacity.value.is_string())
        result.opacity = formula(opacity, "xyzrd");
    else if (opacity.value.is_object() && opacity.has("expression"))
        result.opacity = formula(opacity["expression"], "xyzrd");
    else
        result.opacity = number(opacity);
    if (view.has("falloff")) result.falloff = number(view["falloff"]);
    return result;
}

FieldsObject SceneReader::fieldsObject(const JsonView& view) {
    FieldsObject result;
    for (auto member = view.value.begin(); member != view.value.end(); ++member) {
        const std::string& name = member.key();
        const JsonView value{member.value(), view.place.at(name)};
        if (name == "opacity") {
            result.opacity = field(value);
        } else if (name == "color") {
            for (std::size_t c = 0; c < 3; ++c) result.color[c] = field(value[c]);
        } else if (name == "bounds") {
            result.bounds = box(value, "the bounds");
        } else if (name != "type") {
            result.attributes[name] = field(value);
        }
    }
    return result;
}

CvgObject SceneReader::cvgObject(const JsonView& view, CvgOperator by) {
    CvgObject result;
    result.by = by;
    const JsonView of = view["of"];
    for (std::size_t i = 0; i < of.value.size(); ++i) result.of.emplace_back(object(of[i]));
    if (by == CvgOperator::Blend) result.weight = field(view["weight"]);
    return result;
}

TransferObject SceneReader::transferObject(const JsonView& view) {
    TransferObject result;
    const JsonView by = view["by"];
    if (by.value.is_array())
        result.by = transferList(by);
    else
        result.by.emplace_back(transfer(by));
    if (view.has("combine"))
        result.combine = choice<Combine>(view["combine"].text(), {"union", "merge", "intersection", "first"});
    result.of = object(view["of"]);
    return result;
}

RecolorObject SceneReader::recolor(const JsonView& view) {
    RecolorObject result;
    if (view.has("from")) result.from = view["from"].text();
    if (view.has("color")) result.color = colorTable(view["color"]);
    if (view.has("opacity")) result.opacity = piecewiseLinear(view["opacity"]);
    result.of = object(view["of"]);
    return result;
}

}  // namespace voledit
