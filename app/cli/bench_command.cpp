// `voledit bench`: edit to pixels, frames and start-up, as JSON. Figures of one run are to be compared with each other
// and with peers run in the same minutes; these are wall-clock times.

#include <unistd.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/bench_actor.h"
#include "app/cli/bench_formulas.h"
#include "app/cli/commands.h"
#include "app/cli/drawing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/paths.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
    InputArguments input;
    std::string size = "512x512", renderer, gl = "auto";
    int repeats = 5;
};

Json summary(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    return {{"median", times[times.size() / 2]}, {"min", times.front()}, {"max", times.back()}};
}

/// Seen from the mouse: the edit, the compilation and the finished picture.
Json benchEdits(Drawing& drawing, const OpenedScene& opened, Index2 size, int repeats) {
    Scene scene = opened.scene;
    const double aspect = double(size.x) / size.y;
    CompiledScene compiled = compile(scene, opened.assets, 0, nullptr, aspect);
    scene.camera = compiled.camera;
    drawing.draw(compiled, size, nullptr);
    std::vector<double> total, compiling, drawn;
    for (int i = 0; i <= repeats; ++i) {
        const double c = millisecondsOf([&] {
            nudgeOutermost(scene, compiled.unitStep * (i % 2 ? -1 : 2));
            compiled = compile(scene, opened.assets, 0, &compiled, aspect);
        });
        const double d = millisecondsOf([&] { drawing.draw(compiled, size, nullptr); });
        if (i == 0) continue;  // the first one warms caches
        compiling.push_back(c);
        drawn.push_back(d);
        total.push_back(c + d);
    }
    return {{"edit_to_pixel_ms", summary(total)}, {"compile_ms", summary(compiling)}, {"draw_ms", summary(drawn)}};
}

Json benchFrames(Drawing& drawing, CompiledScene scene, Index2 size, int repeats) {
    std::vector<double> times;
    for (int i = 0; i <= repeats; ++i) {
        scene.camera = orbited(scene.camera, 1);
        times.push_back(millisecondsOf([&] { drawing.draw(scene, size, nullptr); }));
    }
    times.erase(times.begin());
    return summary(times);
}

/// A new process renders the scene's first picture; what a user waits for after the double click.
Json benchStart(const BenchArguments& a, const std::string& renderer) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("voledit-bench-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const auto quoted = [](const std::string& text) {
        std::string q = "'";
        for (const char c : text) q += c == '\'' ? std::string("'\\''") : std::string(1, c);
        return q + "'";
    };
    const std::string command = quoted((programFolder() / "voledit").string()) + " render " + quoted(a.input.file) +
                                (a.input.allowOutside ? " --allow-outside" : "") + " --quiet --size " + a.size +
                                " --renderer " + renderer + " --gl " + a.gl + " -o " +
                                quoted((folder / "first.png").string());
    std::vector<double> times;
    for (int i = 0; i < a.repeats; ++i) {
        int status = 0;
        times.push_back(millisecondsOf([&] { status = std::system(command.c_str()); }));
        if (status != 0) throw Error("bench: \"" + command + "\" failed; run it by itself to see why");
    }
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return summary(times);
}

int bench(BenchArguments a, const CommonArguments& common) {
    if (a.repeats < 1 || a.repeats > 1000) throw UsageError("--repeats: give a number from 1 to 1000");
    const Index2 size = parseSize2(a.size, "--size");
    if (a.input.file.empty()) a.input.file = (resourceFolder() / "scenes" / "welcome.voledit").string();
    IoClient io;
    Json json;
    OpenedScene opened;
    const double reading = millisecondsOf([&] { opened = open(io, a.input, common); });
    json["scene"] = std::filesystem::path(a.input.file).filename().string();
    json["size"] = {size.x, size.y};
    json["threads"] = threadCount();
    json["read_ms"] = reading;
    const CompiledScene compiled = compileAt(opened, a.input, 0, double(size.x) / size.y);
    for (const std::string renderer : {"slices", "rays"}) {
        if (!a.renderer.empty() && a.renderer != renderer) continue;
        const auto drawing = makeDrawing(renderer, a.gl);
        Json part;
        if (!drawing->gl().empty()) part["gl"] = drawing->gl();
        part["frame_ms"] = benchFrames(*drawing, compiled, size, a.repeats);
        if (std::holds_alternative<TransferTerm>(compiled.root->node))
            part.update(benchEdits(*drawing, opened, size, a.repeats));
        if (!compiled.actors.empty()) part["playing"] = benchPlaying(*drawing, opened, size, std::max(a.repeats, 5));
        part["start_to_first_picture_ms"] = benchStart(a, renderer);
        json[renderer] = part;
    }
    json["formulas"] = benchFormulas(std::max(a.repeats, 9));
    json["peak_mib"] = peakMebibytes();
    std::cout << json.dump(2) << "\n";
    return 0;
}

}  // namespace

Command addBenchCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<BenchArguments>();
    command.add_option("scene", a->input.file, "Scene or volume to measure with (the welcome scene)");
    command.add_flag("--allow-outside", a->input.allowOutside, "Let a scene name files outside its folder");
    command.add_option("--size", a->size, "Width and height in pixels")->capture_default_str()->type_name("WxH");
    command.add_option("--repeats", a->repeats, "Counted repeats; medians are to be quoted")->capture_default_str();
    command.add_option("--renderer", a->renderer, "Only slices or only rays (both)");
    command.add_option("--gl", a->gl, "osmesa, egl or auto")->capture_default_str();
    return [a, &common] { return bench(*a, common); };
}

}  // namespace voledit
