// `voledit render`: a scene to a picture, headless.

#include <CLI/App.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/drawing.h"
#include "app/cli/output.h"
#include "app/cli/picture_arguments.h"
#include "core/base/error.h"
#include "core/io/reduced_volumes.h"

namespace voledit {

namespace {

struct RenderArguments {
    InputArguments input;
    PictureArguments picture;
    std::string output, stats;
    double time = kNaN;
    bool report = false;  // progress as lines on standard output, for the editor
    int timeFrames = 0, timeEdits = 0;
};

void checkArguments(const RenderArguments& a) {
    const auto ending = std::filesystem::path(a.output).extension();
    if (ending != ".png" && ending != ".exr") throw UsageError("-o " + a.output + ": name a .png or .exr file");
    if (a.timeFrames < 0 || a.timeEdits < 0 || a.timeFrames > 100000 || a.timeEdits > 100000)
        throw UsageError("--time-frames and --time-edits take a number from 0 to 100000");
    a.picture.check();
}

std::vector<double> timeFrames(Drawing& drawing, CompiledScene scene, Index2 size, int count) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
        scene.camera = orbited(scene.camera, 1);
        times.push_back(millisecondsOf([&] { drawing.draw(scene, size, nullptr); }));
    }
    return times;
}

std::vector<double> timeEdits(Drawing& drawing, const OpenedScene& opened, CompiledScene compiled, Index2 size,
                              int count) {
    std::vector<double> times;
    Scene scene = opened.scene;
    scene.camera = compiled.camera;
    const double aspect = double(size.x) / size.y;
    for (int i = 0; i < count; ++i)
        times.push_back(millisecondsOf([&] {
            nudgeOutermost(scene, compiled.unitStep * (i % 2 ? -1 : 2));
            compiled = compile(scene, opened.assets, compiled.time, &compiled, aspect);
            drawing.draw(compiled, size, nullptr);
        }));
    return times;
}

void writeStatistics(const std::string& path, const Drawing& drawing, Index2 size, double firstImage,
                     const std::vector<double>& frames, const std::vector<double>& edits) {
    const DrawStatistics s = drawing.statistics();
    nlohmann::ordered_json json;
    json["renderer"] = drawing.renderer();
    json["gl"] = drawing.gl();
    json["size"] = {size.x, size.y};
    json["slices"] = s.slices;
    json["samples"] = s.samples;
    json["cells"] = s.cells;
    json["first_image_ms"] = firstImage;
    json["frame_ms"] = frames;
    json["edit_ms"] = edits;
    json["peak_mib"] = peakMebibytes();
    writeTextFile(path, json.dump(2) + "\n");
}

int render(const RenderArguments& a, const CommonArguments& common) {
    checkArguments(a);
    setMayReduceVolumes(true);
    const Index2 size = a.picture.pixels();
    const auto drawing = a.picture.drawing();
    checkWritable(a.output);
    IoClient io;
    OpenedScene opened = open(io, a.input, common);
    a.picture.applyTo(opened.scene);
    const CompiledScene scene = compileAt(opened, a.input, a.time, double(size.x) / size.y);

    Picture picture;
    withProgress(
        "Rendering", common.verbosity(),
        [&](Progress* progress) { picture = drawStill(*drawing, scene, size, a.picture.supersample, progress); },
        a.report);
    const double firstImage = millisecondsSinceStart();
    withProgress("Writing " + a.output, common.verbosity(),
                 [&](Progress*) { io.writePicture(picture, a.output, scene.render.transparent); });
    if (common.verbosity() == Verbosity::Verbose)
        std::fprintf(stderr, "voledit: first image after %.0f ms\n", firstImage);
    const auto frames = timeFrames(*drawing, scene, size, a.timeFrames);
    const auto edits = timeEdits(*drawing, opened, scene, size, a.timeEdits);
    if (!a.stats.empty()) writeStatistics(a.stats, *drawing, size, firstImage, frames, edits);
    return 0;
}

}  // namespace

Command addRenderCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<RenderArguments>();
    addInputArguments(command, a->input, "scene");
    command.add_option("-o,--output", a->output, "Picture to write: .png or .exr")->required()->type_name("OUT");
    command.add_option("--time", a->time, "Time in seconds (the timeline's start)")->type_name("S");
    addPictureArguments(command, a->picture);
    command.add_flag("--report", a->report)->group("");
    command.add_option("--stats", a->stats, "Write measurements as JSON")->type_name("FILE");
    command.add_option("--time-frames", a->timeFrames, "Draw and time N more frames, orbiting")->type_name("N");
    command.add_option("--time-edits", a->timeEdits, "Make and time N small edits of the outermost lattice")
        ->type_name("N");
    return [a, &common] { return render(*a, common); };
}

}  // namespace voledit
