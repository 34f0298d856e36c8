// Numbers, vectors, tables and settings of a scene file.
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

double SceneReader::number(const JsonView& view) const {
    if (view.value.is_object()) notBuilt(view.place, "tracks", "write a plain value in place of the keys");
    return view.value.get<double>();
}

Vec3 SceneReader::vector(const JsonView& view) const {
    if (view.value.is_object()) notBuilt(view.place, "tracks", "write a plain vector in place of the keys");
    return {number(view[0]), number(view[1]), number(view[2])};
}

Vec3 SceneReader::direction(const JsonView& view) const {
    const Vec3 v = vector(view);
    if (v == Vec3(0)) fail(view.place, "found the vector 0, expected a direction", "give it a length");
    return v;
}

Vec3 SceneReader::numberOrThree(const JsonView& view) const {
    return view.value.is_array() ? vector(view) : Vec3(number(view));
}

Index3 SceneReader::indices(const JsonView& view) const {
    return {view.value[0].get<int>(), view.value[1].get<int>(), view.value[2].get<int>()};
}

Frame SceneReader::frame(const JsonView& view) const {
    Frame result;
    if (view.has("min")) {
        const Box3 box{vector(view["min"]), vector(view["max"])};
        for (int a = 0; a < 3; ++a)
            if (!(box.max[a] > box.min[a]))
                fail(view.place, "the frame's max is not above its min along " + std::string(1, "xyz"[a]),
                     "give it a size on every axis");
        result = frameOf(box);
    } else {
        result = {vector(view["corner"]), {vector(view["x"]), vector(view["y"]), vector(view["z"])}};
    }
    const auto& edge = result.edge;
    const double volume = std::abs(glm::determinant(Mat3(edge[0], edge[1], edge[2])));
    const double box = glm::length(edge[0]) * glm::length(edge[1]) * glm::length(edge[2]);
    if (!std::isfinite(box)) fail(view.place, "the frame is too large to compute with", "give it a smaller size");
    if (!(volume > 1e-12 * box))
        fail(view.place, "the frame is flat: its edges do not span space", "give it three independent edges");
    return result;
}

Placement SceneReader::placement(const JsonView& view) const {
    Placement result;
    if (view.has("translate")) result.translate = vector(view["translate"]);
    if (view.has("rotate")) result.rotate = vector(view["rotate"]);
    if (view.has("scale")) result.scale = numberOrThree(view["scale"]);
    if (view.has("matrix")) {
        const JsonView matrix = view["matrix"];
        if (matrix.value.is_object()) notBuilt(matrix.place, "tracks", "write 16 numbers in place of the keys");
        Mat4 m;
        for (int n = 0; n < 16; ++n) m[n % 4][n / 4] = number(matrix[std::size_t(n)]);
        if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
            fail(matrix.place, "the matrix's last row is not 0, 0, 0, 1", "write an affine matrix, row by row, q to p");
        result.matrix = m;
    }
    const double determinant = glm::determinant(Mat3(worldFromRest(result)));
    if (!std::isfinite(determinant) || determinant == 0)
        fail(view.place, "this placement flattens space and cannot be inverted",
             result.matrix ? "write a matrix with a determinant other than 0" : "make every scale other than 0");
    return result;
}

PiecewiseLinear SceneReader::piecewiseLinear(const JsonView& view) const {
    PiecewiseLinear table;
    table.points.reserve(view.value.size());
    for (std::size_t i = 0; i < view.value.size(); ++i) {
        const JsonView row = view[i];
        table.points.emplace_back(number(row[0]), number(row[1]));
        if (i > 0 && table.points[i].x < table.points[i - 1].x)
            fail(row.place, "the table's values decrease here", "sort its rows by their first number");
    }
    return table;
}

ColorTable SceneReader::colorTable(const JsonView& view) const {
    ColorTable table;
    table.points.reserve(view.value.size());
    for (std::size_t i = 0; i < view.value.size(); ++i) {
        const JsonView row = view[i];
        table.points.push_back({number(row[0]), {number(row[1]), number(row[2]), number(row[3])}});
        if (i > 0 && table.points[i].value < table.points[i - 1].value)
            fail(row.place, "the table's values decrease here", "sort its rows by their first number");
    }
    return table;
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
        if (std::find(known.begin(), known.end(), result.preset) == known.end()) {
            const std::string nearest = nearestName(result.preset, known);
            fail(preset.place, "there is no appearance preset " + described(preset.value),
                 nearest.empty() ? "choose one of: " + list : "did you mean \"" + nearest + "\"?");
        }
    }
    if (view.has("color")) result.color = colorTable(view["color"]);
    if (view.has("opacity")) result.opacity = piecewiseLinear(view["opacity"]);
    if (view.has("gradientOpacity")) result.gradientOpacity = piecewiseLinear(view["gradientOpacity"]);
    return result;
}

Camera SceneReader::camera(const JsonView& view) const {
    Camera camera{{0, -400, 80}, {0, 0, 0}, {0, 0, 1}, 30};
    if (view.has("eye")) camera.eye = vector(view["eye"]);
    if (view.has("target")) camera.target = vector(view["target"]);
    if (view.has("up")) camera.up = direction(view["up"]);
    if (view.has("fovY")) camera.fovY = number(view["fovY"]);
    if (camera.eye == camera.target) fail(view.place, "the camera's eye and target are one point", "move one of them");
    return camera;
}

RenderSettings SceneReader::renderSettings(const JsonView& view) const {
    RenderSettings settings;
    if (view.has("background")) settings.background = vector(view["background"]);
    if (view.has("step")) settings.step = number(view["step"]);
    if (view.has("shading")) settings.shading = view["shading"].value.get<bool>();
    if (view.has("ambient")) settings.ambient = number(view["ambient"]);
    if (view.has("diffuse")) settings.diffuse = number(view["diffuse"]);
    if (view.has("specular")) settings.specular = number(view["specular"]);
    if (view.has("shininess")) settings.shininess = number(view["shininess"]);
    if (view.has("light") && !view.value["light"].is_string()) settings.light = direction(view["light"]);
    return settings;
}

Timeline SceneReader::timeline(const JsonView& view) const {
    Timeline timeline;
    if (view.has("fps")) timeline.fps = number(view["fps"]);
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
