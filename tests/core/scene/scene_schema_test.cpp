// resources/scene.schema.json covers the whole contract, and JsonSchema reads it as an independent validator does.
// GCC 12 with sanitizers takes the std::function in <regex>, which valijson uses, for uninitialised.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include <gmock/gmock.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/scene/json_schema.h"

namespace voledit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const ordered_json& schemaText() {
    static const ordered_json text = ordered_json::parse(std::ifstream(resourceFolder() / "scene.schema.json"));
    return text;
}

/// The two validators of one schema.
struct Judges {
    JsonSchema ours{schemaText()};
    valijson::Schema theirs;

    Judges() {
        const json schema = schemaText();
        valijson::SchemaParser(valijson::SchemaParser::kDraft7)
            .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), theirs);
    }
    bool theirVerdict(const json& value) const {
        valijson::Validator validator(valijson::Validator::kStrongTypes);
        return validator.validate(theirs, valijson::adapters::NlohmannJsonAdapter(value), nullptr);
    }
    std::string ourMessage(const json& value) const {
        const auto mistake = ours.check(value);
        return mistake ? mistake->pointer + ": " + mistake->what + "; " + mistake->remedy : "";
    }
};

const Judges& judges() {
    static const Judges both;
    return both;
}

json withRoot(const std::string& object) {
    return {{"voledit", 1}, {"root", json::parse(object)}};
}
json withTransfer(const std::string& stf) {
    json scene = withRoot(R"({"type": "transfer", "by": [], "of": {"use": "a"}})");
    scene["root"]["by"].push_back(json::parse(stf));
    return scene;
}
json withDisplacement(const std::string& sd) {
    json scene = withRoot(R"({"use": "a"})");
    scene["displacements"]["d"] = json::parse(sd);
    return scene;
}
json withField(const std::string& field) {
    return withRoot(R"({"type": "fields", "opacity": )" + field + R"(, "color": [1, 1, 1]})");
}
json withMember(const std::string& member, const std::string& value) {
    json scene = withRoot(R"({"use": "a"})");
    scene[member] = json::parse(value);
    return scene;
}

/// A valid scene for every type and form of the contract.
std::vector<json> corpus() {
    std::vector<json> all;
    for (const char* object : {
             R"({"use": "skull"})",
             R"({"type": "volume", "asset": "head", "channel": 2, "interpolation": "cubic",
                 "appearance": {"preset": "ct-bone", "gradientOpacity": [[0, 0], [10, 1]]}})",
             R"({"type": "volume", "asset": "head", "appearance": {"color": [[0, 0, 0, 0], [1, 1, 0.5, 0]],
                 "opacity": [[0, 0], [1, 1]]}})",
             R"({"type": "volume", "asset": "head"})",
             R"({"type": "solid", "shape": {"sphere": {"center": [0, 0, 0], "radius": 1}}, "color": [1, 0, 0],
                 "opacity": 0.5, "falloff": 0.1})",
             R"({"type": "solid", "shape": {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}, "color": [1, 0, 0],
                 "opacity": "clamp(-d, 0, 1) * 0.9"})",
             R"({"type": "solid", "shape": {"cylinder": {"from": [0, 0, 0], "to": [0, 0, 1], "radius": 1}},
                 "color": [1, 0, 0], "opacity": {"expression": "r"}})",
             R"({"type": "solid", "shape": {"capsule": {"from": [0, 0, 0], "to": [0, 0, 1], "radius": 1}},
                 "color": [1, 0, 0], "opacity": {"keys": [[0, 0], [1, 1]]}})",
             R"({"type": "solid", "shape": {"torus": {"center": [0, 0, 0], "axis": [0, 0, 1], "major": 2, "minor": 1}},
                 "color": {"keys": [[0, [1, 0, 0]]]}, "opacity": 1})",
             R"({"type": "solid", "shape": {"text": {"string": "abc", "height": 2, "depth": 1}}, "color": [1, 0, 0],
                 "opacity": 1})",
             R"({"type": "solid", "shape": {"expression": {"d": "length(x) - 1",
                 "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]}}}, "color": [1, 0, 0], "opacity": 1})",
             R"({"type": "fields", "opacity": {"expression": "x"}, "color": [1, {"expression": "y"}, 0],
                 "bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}, "heat": {"expression": "z"}, "density": 3})",
             R"({"type": "volume", "asset": "head", "appearance": {
                 "color": {"keys": [[0, [[0, 0, 0, 0], [1, 1, 1, 1]]], [1, [[0, 0, 0, 0], [2, 1, 1, 1]]]]},
                 "opacity": [[0, {"keys": [[0, 0], [1, 1]]}], {"keys": [[0, [1, 0.5]]], "interpolation": "step"}],
                 "gradientOpacity": [[{"keys": [[0, 0]]}, 1]]}})",
             R"({"type": "solid", "shape": {"box": {"min": {"keys": [[0, [0, 0, 0]]]}, "max": [1, 1,
                 {"keys": [[0, 1], [1, 2]]}]}}, "color": [{"keys": [[0, 0.5]]}, 0, 0], "opacity": 1,
                 "falloff": {"keys": [[0, 0.1]]}})",
             R"({"type": "place", "scale": {"keys": [[0, 1], [1, 2]]}, "rotate": [{"keys": [[0, 1]]}, 0, 0],
                 "of": {"use": "a"}})",
             R"({"type": "place", "matrix": [1, 0, 0, {"keys": [[0, 1]]}, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
                 "of": {"use": "a"}})",
             R"({"type": "recolor", "opacity": {"keys": [[0, [[0, 1], [1, 0]]]]}, "of": {"use": "a"}})",
             R"({"type": "images", "asset": "film"})",
             R"({"type": "union", "of": [{"use": "a"}, {"use": "b"}, {"use": "c"}]})",
             R"({"type": "intersection", "of": [{"use": "a"}, {"use": "b"}]})",
             R"({"type": "difference", "of": [{"use": "a"}, {"use": "b"}]})",
             R"({"type": "merge", "of": [{"use": "a"}, {"use": "b"}]})",
             R"({"type": "cap", "of": [{"use": "a"}, {"use": "b"}]})",
             R"({"type": "trim", "of": [{"use": "a"}, {"type": "volume", "asset": "b"}]})",
             R"({"type": "blend", "of": [{"use": "a"}, {"use": "b"}], "weight": 0.5})",
             R"({"type": "transfer", "by": {"use": "pull"}, "of": {"use": "a"}, "combine": "merge"})",
             R"({"type": "transfer", "by": [{"use": "pull"}, {"type": "affine"}], "of": {"use": "a"}})",
             R"({"type": "displace", "by": {"use": "d"}, "of": {"use": "a"}})",
             R"({"type": "place", "translate": [1, 2, 3], "rotate": [90, 0, 0], "scale": 2, "of": {"use": "a"}})",
             R"({"type": "place", "scale": [1, 2, 3], "of": {"use": "a"}})",
             R"({"type": "place", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "of": {"use": "a"}})",
             R"({"type": "recolor", "from": "heat", "color": [[0, 0, 0, 0]], "opacity": [[0, 1]], "of": {"use": "a"}})",
             R"({"type": "actor", "of": {"use": "a"}, "motion": "walk", "mode": "connected",
                 "skeleton": {"motion": "walk", "fit": {"scale": 0.1, "rotate": [90, 0, 0], "translate": [0, 0, 1]},
                 "limbs": [{"name": "arm", "from": "shoulder", "to": "elbow", "size": [1, 2], "roll": 10,
                            "pad": [0, 0.5], "of": {"use": "b"}}]}})",
             R"({"type": "actor", "of": {"use": "a"}, "disjoint": ["knee"], "skeleton": {"joints": [
                 {"name": "hip", "parent": null, "at": [0, 0, 0]},
                 {"name": "knee", "parent": "hip", "at": [0, 0, -1],
                  "rotate": {"keys": [[0, [0, 0, 0]], [1, [90, 0, 0]]], "interpolation": "smooth"},
                  "translate": {"keys": [[0, [0, 0, 0]]]}}]}})",
             R"({"type": "actor", "name": "walker", "of": {"use": "a"}, "motion": "walk", "mode": "disjoint",
                 "motionMap": {"hip": "Hips", "knee": null}, "motionFit": {"scale": 2, "translate": [0, 0, 1]},
                 "inPlace": true, "cells": [2, 2, 8], "miterLimit": 1.5, "smooth": false, "preserveVolume": true,
                 "poses": {"sit": {"knee": [90, 0, 0]}, "rest": {}}, "skeleton": {"motion": "walk",
                 "pose": [{"name": "hip", "rotate": [0, 0, {"keys": [[0, 0, "step"], [1, 2]]}],
                           "translate": [0, 0, 0], "limits": {"min": [-1, -1, -1], "max": [1, 1, 1]}}],
                 "limbs": [{"name": "arm", "from": "a", "to": "b", "size": {"keys": [[0, [1, 2], "smooth"]]},
                            "offset": [0, {"keys": [[0, 1]]}], "roll": {"keys": [[0, 1, "linear"]]}}]}})",
             R"({"type": "actor", "of": {"use": "a"}, "skeleton": {"joints": [
                 {"name": "hip", "parent": null, "at": {"keys": [[0, [0, 0, 0], "step"], [1, [0, 0, 1]]]},
                  "limits": {"min": [0, 0, 0], "max": [0, 0, 0]}}]}})",
         })
        all.push_back(withRoot(object));
    for (
        const char* stf : {
            R"({"type": "split", "axis": "x", "at": 0.5, "gap": 0.2, "name": "cut", "enabled": false, "amount": 0.5,
                 "outside": "keep", "frame": {"min": [0, 0, 0], "max": [1, 1, 1]}})",
            R"({"type": "dissect", "axes": ["x", "z"], "gap": 0.3,
                 "frame": {"corner": [0, 0, 0], "x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}})",
            R"({"type": "open", "axis": "x", "hinge": "z", "at": 0.5, "width": 0.2, "profile": 2})",
            R"({"type": "insideOut", "line": {"point": [0, 0, 0], "direction": [0, 0, 1]}, "radius": 5})",
            R"({"type": "squeeze", "axis": "z", "at": 0.5, "strength": 0.5, "sigma": 0.25})",
            R"({"type": "twist", "axis": "z", "angle": {"keys": [[0, 0], [2, 180]]}, "at": 0.5})",
            R"({"type": "taper", "axis": "z", "scale": [1, 0.5]})",
            R"({"type": "bend", "axis": "z", "toward": "x", "angle": 90, "range": [0.2, 0.8]})",
            R"({"type": "rotationalSweep", "line": {"point": [0, 0, 0], "direction": [0, 0, 1]}, "start": [1, 0, 0],
                 "from": 0, "to": 270})",
            R"({"type": "deflect", "center": [0, 0, 0], "radius": 3, "translate": [1, 0, 0], "rotate": [0, 0, 10],
                 "scale": 1.5})",
            R"({"type": "affine", "translate": [1, 2, 3], "rotate": [0, 0, 30], "scale": [1, 1, 2]})",
            R"({"type": "affine", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})",
            R"({"type": "expression", "x": "x + a", "y": "y", "z": "z", "undefined": "x < 0", "let": [["a", "y * 2"]],
                 "space": "world", "image": {"min": [0, 0, 0], "max": [1, 1, 1]}})",
            R"({"type": "fields", "x": 1, "y": {"expression": "y"}, "z": {"asset": "v", "channel": 2},
                 "displacement": true})",
            R"({"type": "fields", "asset": "warp"})",
            R"({"type": "ffd"})",
            R"({"type": "ffd", "basis": "bezier", "degree": [1, 2, 9], "cells": [8, 8, 8],
                 "move": [{"point": [0, 1, 2], "by": [1, 2, 3]},
                          {"point": [0, 0, 0], "to": {"keys": [[0, [0, 0, 0]]]}}]})",
            R"({"type": "ffd", "basis": "bspline", "points": [4, 5, 6], "control": [[0, 0, 0]]})",
            R"({"type": "sweep", "path": [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], "up": [0, 1, 0],
                 "direction": "tangent", "scale": {"keys": [[0, 1], [1, 2]]}, "association": "stretch",
                 "size": [1, 1], "along": "z"})",
            R"({"type": "sweep", "path": [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], "up": [0, 1, 0],
                 "direction": [1, 0, 0], "association": {"repeat": {"times": 3}}, "size": [1, 1]})",
            R"({"type": "sweep", "path": [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], "up": [0, 1, 0],
                 "direction": [1, 0, 0], "association": {"sections": [[0, 0], [1, 1]]}, "size": [1, 1]})",
            R"({"type": "skeleton", "skeleton": {"motion": "walk"}, "motion": "walk", "limb": "arm"})",
            R"({"type": "mapped", "points": [[0, 0, 0]], "source": [[0, 0, 0]], "cells": [[0, 0, 0, 0, 0, 0, 0, 0]]})",
            R"({"type": "mapped", "points": {"keys": [[0, [[0, 0, 0]]], [1, [[1, 1, 1]]]]}, "source": [[0, 0, 0]],
                 "cells": []})",
            R"({"type": "sequence", "of": [{"use": "p"}, {"type": "ffd"}]})",
            R"({"type": "transferred", "by": {"use": "p"}, "of": {"type": "ffd"}})",
            R"({"type": "ripple", "height": 3, "where": [1, 2, 3], "axis": "x", "amount": 0.5})",
            R"({"type": {"file": "ripple.stf"}, "height": {"keys": [[0, 0]]}})",
            R"({"type": "ripple", "height": {"keys": [[0, [1, 2]], [1, [2, 3]]], "interpolation": "smooth"},
                 "where": [1, {"keys": [[0, 1]]}], "axes": ["x", "y"],
                 "line": {"point": [0, 0, 0], "direction": {"keys": [[0, [0, 0, 1]]]}}})",
            R"({"type": "twist", "axis": "z", "angle": {"keys": [[0, 0], [1, 90]]}, "amount": {"keys": [[0, 0], [1, 1]]},
                 "frame": {"min": [0, 0, 0], "max": {"keys": [[0, [1, 1, 1]], [1, [2, 2, 2]]]}}})",
            R"({"type": "dissect", "axes": ["y"], "gap": {"keys": [[0, 0], [1, 0.5]]}})",
            R"({"type": "taper", "axis": "z", "scale": {"keys": [[0, [1, 1]], [1, [1, 2]]]}})",
            R"({"type": "squeeze", "axis": "z", "strength": {"keys": [[0, 0], [1, 0.5]]}})",
            R"({"type": "ffd", "degree": [1, 1, 1], "control": {"keys": [[0, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0],
                 [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]]]]}})",
        })
        all.push_back(withTransfer(stf));
    for (const char* sd : {
             R"({"use": "e"})",
             R"({"type": "of", "transfer": {"type": "twist", "axis": "z", "angle": 30}})",
             R"({"type": "scale", "by": {"expression": "x"}, "of": {"use": "e"}})",
             R"({"type": "sum", "of": [{"use": "e"}, {"use": "f"}]})",
             R"({"type": "union", "of": [{"use": "e"}, {"use": "f"}]})",
             R"({"type": "intersection", "of": [{"use": "e"}, {"use": "f"}]})",
             R"({"type": "blend", "weight": 0.5, "of": [{"use": "e"}, {"use": "f"}]})",
             R"({"type": "fields", "x": 1, "y": {"expression": "y"}, "z": 0})",
         })
        all.push_back(withDisplacement(sd));
    for (const char* field : {
             "0.5",
             R"({"keys": [[0, 0], [1, 1]], "interpolation": "step"})",
             R"({"expression": "sin(x) + 1"})",
             R"({"component": "x", "of": {"use": "stf"}})",
             R"({"component": "y", "of": {"type": "sum", "of": [{"use": "e"}]}})",
             R"({"component": "z", "of": {"type": "bend", "axis": "z", "toward": "x", "angle": 30}})",
             R"({"attribute": "heat", "of": {"use": "a"}})",
             R"({"asset": "v", "channel": 1})",
             R"({"map": [[0, 1], [1, 0]], "of": {"expression": "x"}})",
         })
        all.push_back(withField(field));
    const std::pair<const char*, const char*> members[] = {
        {"assets", R"({"a": {"kind": "volume", "path": "a.nrrd"}, "b": {"kind": "motion", "path": "b.bvh"},
                       "c": {"kind": "images", "path": "c_%03d.png"}})"},
        {"objects", R"({"a": {"use": "b"}})"},
        {"transfers", R"({"a": {"type": "ffd"}})"},
        {"opacityDistance", "2.5"},
        {"opacityDistance", R"({"keys": [[0, 1], [1, 2]]})"},
        {"camera", "{}"},
        {"camera", R"({"eye": [0, -400, 80], "target": [0, 0, 0], "up": [0, 0, 1], "fovY": 30})"},
        {"camera", R"({"eye": {"keys": [[0, [0, 1, 2]], [1, [3, 4, 5]]]}, "target": [0, {"keys": [[0, 1]]}, 0]})"},
        {"render", "{}"},
        {"render", R"({"background": [0, 0, 0], "step": 0.5, "shading": true, "ambient": 0.3, "diffuse": 0.7,
                       "specular": 0.2, "shininess": 20, "light": "headlight"})"},
        {"render", R"({"light": [1, 0, 1]})"},
        {"timeline", R"({"fps": 29.97, "start": -5, "end": 48})"}};
    for (const auto& [member, value] : members) all.push_back(withMember(member, value));
    return all;
}

/// Pointers of every value within `value`, itself first.
std::vector<json::json_pointer> placesIn(const json& value, const json::json_pointer& here = json::json_pointer()) {
    std::vector<json::json_pointer> all{here};
    const auto add = [&](const json& part, const json::json_pointer& at) {
        const auto inner = placesIn(part, at);
        all.insert(all.end(), inner.begin(), inner.end());
    };
    if (value.is_object())
        for (const auto& item : value.items()) add(item.value(), here / item.key());
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) add(value[i], here / i);
    return all;
}

TEST(SceneSchema, AcceptsEveryTypeOfTheContract) {
    for (const json& scene : corpus()) {
        EXPECT_EQ(judges().ourMessage(scene), "") << scene;
        EXPECT_TRUE(judges().theirVerdict(scene)) << scene;
    }
}

TEST(SceneSchema, AcceptsTheExampleOfTheContract) {
    const json scene = json::parse(R"({
      "voledit": 1,
      "assets": {
        "head": { "kind": "volume", "path": "ct-head.nrrd" },
        "walk": { "kind": "motion", "path": "walk.bvh" }
      },
      "objects": { "skull": { "type": "volume", "asset": "head", "appearance": { "preset": "ct-bone" } } },
      "transfers": { "pull": { "type": "ffd", "degree": [3, 3, 3], "move": [ { "point": [3, 3, 3], "by": [20, 0, 10] } ] } },
      "root": { "type": "transfer", "by": [ { "use": "pull" } ], "of": { "use": "skull" } },
      "opacityDistance": 1.0,
      "camera": { "eye": [0, -400, 80], "target": [0, 0, 0], "up": [0, 0, 1], "fovY": 30 },
      "render": { "background": [0, 0, 0], "step": 0.5, "shading": true, "ambient": 0.3, "diffuse": 0.7, "specular": 0.2, "shininess": 20, "light": "headlight" },
      "timeline": { "fps": 24, "start": 0, "end": 48 }
    })");
    EXPECT_EQ(judges().ourMessage(scene), "");
    EXPECT_TRUE(judges().theirVerdict(scene));
}

/// Where any member may stand: maps of names, an actor's joints by name, formula files' parameters, named attributes.
bool takesAnyMember(const json& object, const json::json_pointer& at) {
    static const std::vector<std::string> maps{"assets", "objects", "transfers", "displacements"};
    if (!at.empty() && at.parent_pointer().empty() && std::find(maps.begin(), maps.end(), at.back()) != maps.end())
        return true;
    if (!at.empty() && at.back() == "motionMap") return true;
    return (object.contains("type") && (object["type"] == "ripple" || object["type"].is_object()));
}

TEST(SceneSchema, RefusesAMisspeltMemberEverywhereAndSaysWhere) {
    std::size_t tried = 0;
    for (const json& scene : corpus())
        for (const auto& at : placesIn(scene)) {
            if (!scene[at].is_object() || takesAnyMember(scene[at], at)) continue;
            json wrong = scene;
            wrong[at]["mistake"] = "text";
            ++tried;
            const auto mistake = judges().ours.check(wrong);
            ASSERT_TRUE(mistake) << wrong;
            EXPECT_EQ(mistake->pointer, (at / "mistake").to_string()) << mistake->what;
            EXPECT_FALSE(judges().theirVerdict(wrong)) << wrong;
        }
    EXPECT_GT(tried, 300u);
}

TEST(SceneSchema, BothValidatorsJudgeMutilatedScenesAlike) {
    const std::vector<json> others{nullptr,
                                   true,
                                   -1,
                                   0,
                                   0.5,
                                   1'000'000'000,
                                   "x",
                                   "volume",
                                   "ffd",
                                   json::array(),
                                   json::object(),
                                   {1, 2, 3},
                                   {{"use", "a"}},
                                   {{"keys", {{0, 1}}}},
                                   {{"type", "affine"}}};
    std::mt19937 random(5);
    std::size_t refused = 0, accepted = 0;
    for (const json& scene : corpus())
        for (const auto& at : placesIn(scene)) {
            if (at.empty()) continue;
            std::vector<json> wrongs(1, scene);
            json& parent = wrongs[0][at.parent_pointer()];
            if (parent.is_array())
                parent.erase(std::size_t(std::stoul(at.back())));
            else
                parent.erase(at.back());
            for (int n = 0; n < 4; ++n) {
                wrongs.push_back(scene);
                wrongs.back()[at] = others[random() % others.size()];
            }
            for (const json& wrong : wrongs) {
                const std::string message = judges().ourMessage(wrong);
                ASSERT_EQ(message.empty(), judges().theirVerdict(wrong)) << message << "\n" << wrong;
                ++(message.empty() ? accepted : refused);
            }
        }
    EXPECT_GT(refused, 3000u);
    EXPECT_GT(accepted, 300u);
}

struct Refusal {
    json scene;
    const char* pointer;
    const char* found;
    const char* remedy;
};

TEST(SceneSchema, MessagesAreLocalAndSuggestNames) {
    const Refusal refusals[] = {
        {withTransfer(R"({"type": "ffd", "degre": [3, 3, 3]})"), "/root/by/0/degre", "an ffd has basis, degree",
         "did you mean \"degree\"?"},
        {withTransfer(R"({"type": "ffd", "basis": "bspline"})"), "/root/by/0", "\"points\" is missing", "add it"},
        {withTransfer(R"({"type": "ffd", "basis": "bspline", "degree": [3, 3, 3], "points": [4, 4, 4]})"),
         "/root/by/0/degree", "unknown member", "remove it"},
        {withTransfer(R"({"type": "ffd", "basis": "bezir"})"), "/root/by/0/basis", "\"bezier\", \"bspline\"",
         "did you mean \"bezier\"?"},
        {withTransfer(R"({"type": "ffd", "degree": [3, 3]})"), "/root/by/0/degree", "expected three degrees", ""},
        {withTransfer(R"({"type": "ffd", "degree": [3, 3, 2.5]})"), "/root/by/0/degree/2", "found 2.5", ""},
        {withTransfer(R"({"type": "ffd", "cells": [0, 1, 1]})"), "/root/by/0/cells/0", "found 0", ""},
        {withTransfer(R"({"type": "ffd", "move": [{"point": [0, 0, 0]}]})"), "/root/by/0/move/0",
         "exactly one of: by, to", ""},
        {withTransfer(R"({"type": "ffd", "amount": 1.5})"), "/root/by/0/amount", "expected a number from 0 to 1", ""},
        {withTransfer(R"({"type": "split", "axis": "x"})"), "/root/by/0", "\"gap\" is missing", ""},
        {withTransfer(R"({"type": "split", "axis": "w", "gap": 1})"), "/root/by/0/axis", "expected one of \"x\"", ""},
        {withTransfer(R"({"name": "x"})"), "/root/by/0", "\"type\" is missing", ""},
        {withTransfer("3"), "/root/by/0", "found 3, expected an STF", ""},
        {withRoot(R"({"type": "volum", "asset": "a"})"), "/root/type", "expected one of", "did you mean \"volume\"?"},
        {withRoot(R"({"type": "place", "of": 3})"), "/root/of", "found 3, expected an object", ""},
        {withRoot(R"({"use": "a", "of": 3})"), "/root/of", "a reference { use } has use", ""},
        {withRoot(R"({"type": "union", "of": [{"use": "a"}]})"), "/root/of", "two or more objects", ""},
        {withField(R"({"expresion": "x"})"), "/root/opacity", "exactly one of: keys, expression", ""},
        {withMember("camera", R"({"eye": [0, 1]})"), "/camera/eye", "found a list of 2, expected a vector", ""},
        {withMember("camera", R"({"fovY": 180})"), "/camera/fovY", "below 180 degrees", ""},
        {withMember("camera", R"({"eye": {"keys": [[0, [1, 2]]]}})"), "/camera/eye/keys/0/1", "expected a vector", ""},
        {withMember("render", R"({"light": "sun"})"), "/render/light", "expected one of \"headlight\"", ""},
        {withMember("render", R"({"shading": 1})"), "/render/shading", "expected true or false", ""},
        {withMember("opacityDistance", R"({"keys": [[0, 1], [1, 0]]})"), "/opacityDistance/keys/1/1",
         "expected a number above 0", ""},
        {withTransfer(R"({"type": "ffd", "amount": {"keys": [[0, 2]]}})"), "/root/by/0/amount/keys/0/1",
         "expected a number from 0 to 1", ""},
        {withTransfer(R"({"type": "ripple", "height": [1]})"), "/root/by/0/height", "expected a list of two or more",
         ""},
        {withTransfer(R"({"type": "ripple", "height": {"keys": [[0, "x"]]}})"), "/root/by/0/height/keys/0/1",
         "a number, or a list", ""},
        {withRoot(R"({"type": "recolor", "of": {"use": "a"}, "opacity": [{"keys": [[0, [1]]]}]})"),
         "/root/opacity/0/keys/0/1", "a row [value, opacity]", ""},
        {withMember("timeline", R"({"fps": 0})"), "/timeline/fps", "above 0", ""},
        {withMember("opacityDistance", "-1"), "/opacityDistance", "found -1, expected a number above 0", ""},
        {withMember("transfer", "{}"), "/transfer", "a voledit scene has voledit, assets",
         "did you mean \"transfers\"?"},
        {withMember("objects", R"({"": {"use": "a"}})"), "/objects/", "a name is empty", ""},
    };
    for (const auto& [scene, pointer, found, remedy] : refusals) {
        const auto mistake = judges().ours.check(scene);
        ASSERT_TRUE(mistake) << scene;
        EXPECT_EQ(mistake->pointer, pointer) << mistake->what;
        EXPECT_THAT(mistake->what, testing::HasSubstr(found)) << pointer;
        EXPECT_THAT(mistake->remedy, testing::HasSubstr(remedy)) << pointer;
        EXPECT_FALSE(judges().theirVerdict(scene)) << scene;
    }
}

TEST(JsonSchema, RefusesKeywordsAndReferencesItDoesNotKnow) {
    EXPECT_THROW(JsonSchema(ordered_json{{"pattern", "a*"}}), Error);
    EXPECT_THROW(JsonSchema(ordered_json{{"$ref", "#/definitions/none"}}), Error);
    EXPECT_THROW(JsonSchema(ordered_json{{"$ref", "other.json"}}), Error);
}

TEST(JsonSchema, WalksDeepValuesOnALittleStack) {
    json scene = withRoot(R"({"use": "a"})");
    for (int i = 0; i < 495; ++i) scene["root"] = {{"type", "place"}, {"of", std::move(scene["root"])}};
    EXPECT_EQ(judges().ourMessage(scene), "");
}

TEST(NearestName, FindsSlipsAndNothingFar) {
    const std::vector<std::string> names{"degree", "cells", "control", "move"};
    EXPECT_EQ(nearestName("degre", names), "degree");
    EXPECT_EQ(nearestName("dergee", names), "degree");
    EXPECT_EQ(nearestName("moves", names), "move");
    EXPECT_EQ(nearestName("banana", names), "");
    EXPECT_EQ(nearestName("", names), "");
}

TEST(Described, SaysValuesInAFewWords) {
    EXPECT_EQ(described(json("abc")), "\"abc\"");
    EXPECT_EQ(described(json(12)), "12");
    EXPECT_EQ(described(json::array({1, 2, 3, 4})), "a list of 4");
    EXPECT_EQ(described(json{{"use", "a"}}), "an object with use");
    EXPECT_LT(described(json(std::string(10'000, 'x'))).size(), 70u);
}

}  // namespace
}  // namespace voledit
