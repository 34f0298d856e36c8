// Numbers, vectors, tables and settings of a scene file.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/scene/appearance.h"
#include "core/scene/json_schema.h"
#include "core/scene/scene_reader.h"

namespace voledit {

void SceneReader::fail(const JsonPlace& place, const std::string& what, const std::string& remedy) const {
    throw Error(file_ + ": " + place.pointer(), what, remedy);
}

void SceneReader::notBuilt(const JsonPlace& place, const std::string& what, const std::string& remedy) const {
    fail(place, what + " are not built yet in this version of voledit", remedy);
}

void SceneReader::failUnknown(const JsonView& name, const std::string& what, const std::vector<std::string>& known,
                              const std::string& otherwise) const {
    const std::string nearest = nearestName(name.text(), known);
    fail(name.place, what, nearest.empty() ? otherwise : "did you mean \"" + nearest + "\"?");
}

namespace {

/// Before any key, and at every key of any of `values`: where a bad value is likely to show.
template <class... Values>
std::vector<double> timesOf(const Values&... values) {
    std::vector<double> times{-kInfinity};
    const auto add = [&](const auto& value) {
        for (const PartTrack& part : value.tracks())
            for (const auto& key : part.track.keys) times.push_back(key.time);
    };
    (add(values), ...);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// " at 1.5 s", for messages about tracks.
std::string atTime(double t) {
    if (t == -kInfinity) return "";
    std::string number = std::to_string(t);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return " at " + number + " s";
}

/// The rig of a name that the schema allows.
LightRig rigNamed(const std::string& name) {
    return name == "key-fill-rim" ? LightRig::KeyFillRim
           : name == "soft"       ? LightRig::Soft
           : name == "dramatic"   ? LightRig::Dramatic
                                  : LightRig::Headlight;
}

}  // namespace

Tracked<Vec3> SceneReader::direction(const JsonView& view) const {
    const Tracked<Vec3> v = vector(view);
    for (const double t : timesOf(v))
        if (v.at(t) == Vec3(0))
            fail(view.place, "found the vector 0" + atTime(t) + ", expected a direction", "give it a length");
    return v;
}

TrackedBox SceneReader::box(const JsonView& view, const char* what) const {
    TrackedBox result;
    result.min = vector(view["min"]);
    result.max = vector(view["max"]);
    for (const double t : timesOf(result.min, result.max))
        for (int a = 0; a < 3; ++a)
            if (!(result.max.at(t)[a] > result.min.at(t)[a]))
                fail(view.place, std::string(what) + "'s max is not above its min along " + "xyz"[a] + atTime(t),
                     "give it a size on every axis");
    return result;
}

Index3 SceneReader::indices(const JsonView& view) const {
    return {view.value[0].get<int>(), view.value[1].get<int>(), view.value[2].get<int>()};
}

TrackedFrame SceneReader::frame(const JsonView& view) const {
    TrackedFrame result;
    std::vector<double> times;
    if (view.has("min")) {
        const TrackedBox form = box(view, "the frame");
        result = TrackedFrame(form);
        times = timesOf(form.min, form.max);
    } else {
        const TrackedFrame::Oblique form{vector(view["corner"]),
                                         {vector(view["x"]), vector(view["y"]), vector(view["z"])}};
        result = TrackedFrame(form);
        times = timesOf(form.corner, form.edge[0], form.edge[1], form.edge[2]);
    }
    for (const double t : times) {
        const auto edge = result.at(t).edge;
        const double volume = std::abs(glm::determinant(Mat3(edge[0], edge[1], edge[2])));
        const double lengths = glm::length(edge[0]) * glm::length(edge[1]) * glm::length(edge[2]);
        if (!std::isfinite(lengths))
            fail(view.place, "the frame is too large to compute with" + atTime(t), "give it a smaller size");
        if (!(volume > 1e-12 * lengths))
            fail(view.place, "the frame is flat: its edges do not span space" + atTime(t),
                 "give it three independent edges");
    }
    return result;
}

Placement SceneReader::placement(const JsonView& view) const {
    Placement result;
    if (view.has("translate")) result.translate = vector(view["translate"]);
    if (view.has("rotate")) result.rotate = vector(view["rotate"]);
    if (view.has("scale")) result.scale = numberOrThree(view["scale"]);
    if (view.has("matrix")) result.matrix = matrix(view["matrix"]);
    const auto times = result.matrix ? timesOf(*result.matrix) : timesOf(result.scale);
    for (const double t : times) {
        Placement now;
        now.scale = result.scale.at(t);
        now.rotate = *result.rotate;
        if (result.matrix) {
            const Mat4 m = result.matrix->at(t);
            if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
                fail(view["matrix"].place, "the matrix's last row is not 0, 0, 0, 1" + atTime(t),
                     "write an affine matrix, row by row, q to p");
            now.matrix = m;
        }
        const double determinant = glm::determinant(Mat3(worldFromRest(now)));
        if (!std::isfinite(determinant) || determinant == 0)
            fail(view.place, "this placement flattens space and cannot be inverted" + atTime(t),
                 result.matrix ? "write a matrix with a determinant other than 0" : "make every scale other than 0");
    }
    return result;
}

Appearance SceneReader::appearance(const JsonView& view) const {
    Appearance result;
    if (view.has("preset")) {
        const JsonView preset = view["preset"];
        result.preset = preset.value.get<std::string>();
        std::vector<std::string> known;
        std::string list;
        for (const Preset& one : presets()) {
            known.push_back(one.name);
            list += (list.empty() ? "" : ", ") + one.name;
        }
        if (std::find(known.begin(), known.end(), result.preset) == known.end())
            failUnknown(preset, "there is no appearance preset " + described(preset.value), known,
                        "choose one of: " + list);
    }
    if (view.has("color")) result.color = colorTable(view["color"]);
    if (view.has("opacity")) result.opacity = piecewiseLinear(view["opacity"]);
    if (view.has("gradientOpacity")) result.gradientOpacity = piecewiseLinear(view["gradientOpacity"]);
    return result;
}

TrackedCamera SceneReader::camera(const JsonView& view) const {
    TrackedCamera camera(Camera{{0, -400, 80}, {0, 0, 0}, {0, 0, 1}, 30});
    if (view.has("eye")) camera.eye = vector(view["eye"]);
    if (view.has("target")) camera.target = vector(view["target"]);
    if (view.has("up")) camera.up = direction(view["up"]);
    if (view.has("fovY")) camera.fovY = number(view["fovY"]);
    for (const double t : timesOf(camera.eye, camera.target))
        if (camera.eye.at(t) == camera.target.at(t))
            fail(view.place, "the camera's eye and target are one point" + atTime(t), "move one of them");
    return camera;
}

TrackedRender SceneReader::renderSettings(const JsonView& view) const {
    TrackedRender settings;
    if (view.has("background")) settings.background = vector(view["background"]);
    if (view.has("step")) settings.step = number(view["step"]);
    if (view.has("shading")) settings.shading = view["shading"].value.get<bool>();
    if (view.has("ambient")) settings.ambient = number(view["ambient"]);
    if (view.has("diffuse")) settings.diffuse = number(view["diffuse"]);
    if (view.has("specular")) settings.specular = number(view["specular"]);
    if (view.has("shininess")) settings.shininess = number(view["shininess"]);
    if (view.has("light")) {
        if (view.value["light"].is_string())
            settings.rig = rigNamed(view.value["light"].get<std::string>());
        else
            settings.light = direction(view["light"]);
    }
    if (view.has("shadows")) settings.shadows = number(view["shadows"]);
    if (view.has("occlusion")) settings.occlusion = number(view["occlusion"]);
    if (view.has("occlusionRadius")) settings.occlusionRadius = number(view["occlusionRadius"]);
    if (view.has("toneMapping"))
        settings.toneMapping =
            view["toneMapping"].value.get<std::string>() == "filmic" ? ToneMapping::Filmic : ToneMapping::None;
    if (view.has("exposure")) settings.exposure = number(view["exposure"]);
    if (view.has("transparent")) settings.transparent = view["transparent"].value.get<bool>();
    return settings;
}

Timeline SceneReader::timeline(const JsonView& view) const {
    Timeline timeline;
    if (view.has("fps")) timeline.fps = view.value["fps"].get<double>();
    if (view.has("start")) timeline.start = view.value["start"].get<int>();
    if (view.has("end")) timeline.end = view.value["end"].get<int>();
    if (timeline.end <= timeline.start)
        fail(view.place,
             "it ends at frame " + std::to_string(timeline.end) + ", not after its start at " +
                 std::to_string(timeline.start),
             "`end` is exclusive: make it at least start + 1");
    return timeline;
}

}  // namespace voledit
