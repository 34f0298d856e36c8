#include "app/cli/bench_pictures.h"

#include "app/cli/bench_measure.h"
#include "core/eval/ray_caster.h"
#include "core/eval/term_path.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

std::vector<WorkTime> framesOf(Drawing& drawing, CompiledScene scene, Index2 size, int repeats) {
    std::vector<WorkTime> times;
    for (int i = 0; i <= repeats; ++i) {
        scene.camera = orbited(scene.camera, 1);
        times.push_back(timeOf([&] { drawing.draw(scene, size, nullptr); }));
    }
    times.erase(times.begin());
    return times;
}

/// Seen from the mouse: the edit, the compilation and the finished picture.
void addEdits(Json& json, Drawing& drawing, const OpenedScene& opened, Index2 size, int repeats) {
    Scene scene = opened.scene;
    const double aspect = double(size.x) / size.y;
    CompiledScene compiled = compile(scene, opened.assets, 0, nullptr, aspect);
    scene.camera = compiled.camera;
    drawing.draw(compiled, size, nullptr);
    std::vector<WorkTime> total, compiling, drawn;
    for (int i = 0; i <= repeats; ++i) {
        const WorkTime c = timeOf([&] {
            nudgeOutermost(scene, compiled.unitStep * (i % 2 ? -1 : 2));
            compiled = compile(scene, opened.assets, 0, &compiled, aspect);
        });
        const WorkTime d = timeOf([&] { drawing.draw(compiled, size, nullptr); });
        if (i == 0) continue;  // the first one warms caches
        compiling.push_back(c);
        drawn.push_back(d);
        total.push_back({c.wall + d.wall, c.cpu + d.cpu});
    }
    addTimes(json, "edit_to_pixel", total);
    addTimes(json, "compile", compiling);
    addTimes(json, "draw", drawn);
}

}  // namespace

Json benchPictures(Drawing& drawing, const OpenedScene& opened, Index2 size, int repeats) {
    Json json;
    const double aspect = double(size.x) / size.y;
    const CompiledScene scene = compile(opened.scene, opened.assets, 0, nullptr, aspect);
    addTimes(json, "frame", framesOf(drawing, scene, size, repeats));
    const OutermostTransfer outermost = outermostTransfer(*scene.root);
    if (outermost.list.empty()) return json;
    CompiledScene rest = scene;
    rest.root = outermost.list.back()->of;
    addTimes(json, "rest_frame", framesOf(drawing, rest, size, repeats));
    json["deformed_over_rest"] = json["frame_cpu_ms"].get<double>() / json["rest_frame_cpu_ms"].get<double>();
    addEdits(json, drawing, opened, size, repeats);
    return json;
}

Picture referencePicture(const CompiledScene& scene, Index2 size) {
    CompiledScene fine = scene;
    fine.render.step = 1.0 / 16;
    return castRays(fine, size);
}

}  // namespace voledit
