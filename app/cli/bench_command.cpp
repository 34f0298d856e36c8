// `voledit bench`: scenes × renderers × sizes of pictures, as JSON or as a table. Figures of one run are to be compared
// with each other and with peers run in the same minutes.

#include <CLI/App.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/bench_actor.h"
#include "app/cli/bench_formulas.h"
#include "app/cli/bench_measure.h"
#include "app/cli/bench_pictures.h"
#include "app/cli/bench_table.h"
#include "app/cli/bench_work.h"
#include "app/cli/commands.h"
#include "app/cli/drawing.h"
#include "app/cli/output.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/paths.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
    std::vector<std::string> scenes, sizes{"512x512"};
    bool allowOutside = false;
    std::string renderer, gl = "auto", output, compare;
    int repeats = 5;
    bool psnr = false, table = false, noStart = false, noFormulas = false;
};

void checkArguments(const BenchArguments& a) {
    if (a.repeats < 1 || a.repeats > 1000) throw UsageError("--repeats: give a number from 1 to 1000");
    for (const std::string& size : a.sizes) parseSize2(size, "--size");
    checkDrawingNames(a.renderer, a.gl);
    if (!a.output.empty()) checkWritable(a.output);
}

/// One scene drawn by every renderer that was asked for, at every size.
void benchScene(const BenchArguments& a, const InputArguments& input, const OpenedScene& opened, Json& pictures) {
    const std::string name = std::filesystem::path(input.file).filename().string();
    for (const std::string& words : a.sizes) {
        const Index2 size = parseSize2(words, "--size");
        const CompiledScene compiled = compileAt(opened, input, 0, double(size.x) / size.y);
        Picture reference;
        if (a.psnr) reference = referencePicture(compiled, size);
        for (const std::string renderer : {"slices", "rays"}) {
            if (!a.renderer.empty() && a.renderer != renderer) continue;
            const auto drawing = makeDrawing(renderer, a.gl);
            Json row{{"scene", name}, {"size", words}, {"renderer", renderer}};
            if (!drawing->gl().empty()) row["gl"] = drawing->gl();
            row.update(benchPictures(*drawing, opened, size, a.repeats));
            if (a.psnr) row["psnr_db"] = psnr(drawing->draw(compiled, size, nullptr), reference);
            if (!compiled.actors.empty()) row["playing"] = benchPlaying(*drawing, opened, size, std::max(a.repeats, 5));
            if (!a.noStart) {
                std::vector<std::string> flags{"--size", words, "--renderer", renderer, "--gl", a.gl};
                if (a.allowOutside) flags.emplace_back("--allow-outside");
                row.update(benchStart(input.file, flags, a.repeats));
            }
            pictures.push_back(std::move(row));
        }
    }
}

Json measured(const BenchArguments& a, const CommonArguments& common) {
    Json run{{"threads", threadCount()}, {"pictures", Json::array()}, {"work", Json::array()}};
    IoClient io;
    for (const std::string& file : a.scenes) {
        InputArguments input;
        input.file = file;
        input.allowOutside = a.allowOutside;
        OpenedScene opened;
        const double reading = timeOf([&] { opened = open(io, input, common); }).wall;
        benchScene(a, input, opened, run["pictures"]);
        Json work{{"scene", std::filesystem::path(file).filename().string()}};
        work.update(benchReading(opened, reading, a.repeats));
        work.update(benchWork(opened, a.repeats));
        run["work"].push_back(std::move(work));
    }
    if (!a.noFormulas) run["formulas"] = benchFormulas(std::max(a.repeats, 9));
    run["peak_mib"] = peakMebibytes();
    return run;
}

Json readRun(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw Error(path, "cannot be read", "name a file made by `voledit bench -o FILE`");
    Json run = Json::parse(file, nullptr, false);
    if (run.is_discarded()) throw Error(path, "is not JSON", "name a file made by `voledit bench -o FILE`");
    return run;
}

int bench(BenchArguments a, const CommonArguments& common) {
    checkArguments(a);
    if (a.scenes.empty()) a.scenes = {(resourceFolder() / "scenes" / "welcome.voledit").string()};
    Json earlier;
    if (!a.compare.empty()) earlier = readRun(a.compare);
    Json run = measured(a, common);
    if (!a.compare.empty()) compareRuns(run, earlier);
    if (!a.output.empty()) writeTextFile(a.output, run.dump(2) + "\n");
    if (a.table)
        std::cout << benchTable(run);
    else if (a.output.empty())
        std::cout << run.dump(2) << "\n";
    return 0;
}

}  // namespace

Command addBenchCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<BenchArguments>();
    command.add_option("scenes", a->scenes, "Scenes or volumes to measure with (the welcome scene)");
    command.add_flag("--allow-outside", a->allowOutside, "Let scenes name files outside their folders");
    command.add_option("--size", a->sizes, "Widths and heights in pixels; several with commas")
        ->delimiter(',')
        ->capture_default_str()
        ->type_name("WxH");
    command.add_option("--repeats", a->repeats, "Counted repeats; medians are to be quoted")->capture_default_str();
    command.add_option("--renderer", a->renderer, "Only slices or only rays (both)");
    command.add_option("--gl", a->gl, "osmesa, egl or auto")->capture_default_str();
    command.add_flag("--psnr", a->psnr, "Measure faults, too: PSNR against rays of 1/16 of the spacing (slow)");
    command.add_flag("--table", a->table, "Print a table instead of JSON");
    command.add_flag("--no-start", a->noStart, "Leave out starting new processes");
    command.add_flag("--no-formulas", a->noFormulas, "Leave out formulas against code by hand");
    command.add_option("-o,--output", a->output, "Write the JSON to a file")->type_name("FILE");
    command.add_option("--compare", a->compare, "Add ratios to an earlier run's JSON (above 1: better now)")
        ->type_name("FILE");
    return [a, &common] { return bench(*a, common); };
}

}  // namespace voledit
