#include "app/cli/bench_work.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/matrix.hpp>
#include <random>

#include "app/cli/bench_measure.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/paths.h"
#include "core/eval/term_path.h"
#include "core/eval/voxelise.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kMebibyte = 1 << 20;

void addVoxelising(Json& json, const CompiledScene& scene, const VolumeTerm& source, int repeats) {
    VoxeliseRequest request;
    request.grid = source.volume->grid();
    // Placed volumes stand elsewhere than their files say: the grid goes with them.
    Mat4 worldFromVolume(1.0);
    for (const Term* term = scene.root.get(); const auto* transfer = std::get_if<TransferTerm>(&term->node);
         term = transfer->of.get())
        if (const auto affine = transfer->by->affine()) worldFromVolume = worldFromVolume * glm::inverse(*affine);
    request.grid.worldFromIndex = worldFromVolume * request.grid.worldFromIndex;
    request.what = VoxeliseWhat::Scalar;
    request.type = source.volume->type();
    std::vector<WorkTime> times;
    for (int i = 0; i <= repeats; ++i) times.push_back(timeOf([&] { voxelise(scene, request); }));
    times.erase(times.begin());
    addTimes(json, "voxelise", times);
    json["voxelise_msamples_per_s"] =
        double(request.grid.sampleCount()) / json["voxelise_ms"]["median"].get<double>() / 1000;
}

/// Million points a second that `cells` places, with `threads` threads.
double locating(const MappedCells& cells, const std::vector<Vec3>& p, int threads, int repeats) {
    const int before = threadCount();
    setThreadCount(threads);
    std::vector<Vec3> q(p.size());
    cells.map(p, q);  // builds what location needs
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(timeOf([&] { cells.map(p, q); }).wall);
    setThreadCount(before);
    return double(p.size()) / medianOf(times) / 1000;
}

void addLocating(Json& json, const MappedCells& cells, int repeats) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> p(1000000);
    const Box3 box = cells.bounds();
    for (Vec3& v : p) v = box.min + box.size() * Vec3(unit(random), unit(random), unit(random));
    json["tetrahedra"] = cells.tetrahedra().size();
    json["locate_mqueries_per_s"] = locating(cells, p, threadCount(), repeats);
    json["locate_one_thread_mqueries_per_s"] = locating(cells, p, 1, repeats);
}

std::string quoted(const std::string& text) {
    std::string q = "'";
    for (const char c : text) q += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return q + "'";
}

/// A folder that goes when this does.
struct TemporaryFolder {
    fs::path path = fs::temp_directory_path() / ("voledit-bench-" + std::to_string(::getpid()));
    TemporaryFolder() { fs::create_directories(path); }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

}  // namespace

Json benchWork(const OpenedScene& opened, int repeats) {
    Json json;
    const CompiledScene scene = compile(opened.scene, opened.assets, 0, nullptr);
    const Term* source = oneSourceOf(*scene.root);
    const auto* volume = source ? std::get_if<VolumeTerm>(&source->node) : nullptr;
    if (volume) addVoxelising(json, scene, *volume, repeats);
    for (const TransferTerm* transfer : outermostTransfer(*scene.root).list)
        if (const MappedCells* cells = transfer->by->cells()) {
            addLocating(json, *cells, repeats);
            break;
        }
    return json;
}

Json benchReading(const OpenedScene& opened, double readMilliseconds, int repeats) {
    double bytes = 0;
    for (const auto& [name, volume] : opened.assets.volumes) bytes += double(volume->voxels().size());
    std::vector<fs::path> files;
    for (const auto& [name, asset] : opened.scene.assets) files.push_back(opened.folder / fs::path(asset.path));
    std::vector<double> times;
    std::vector<char> buffer(std::size_t(8) << 20);
    for (int i = 0; i <= repeats; ++i)
        times.push_back(timeOf([&] {
                            for (const fs::path& path : files) {
                                std::ifstream file(path, std::ios::binary);
                                while (file.read(buffer.data(), std::streamsize(buffer.size()))) {
                                }
                            }
                        }).wall);
    times.erase(times.begin());
    return {{"volume_mib", bytes / kMebibyte}, {"raw_read_ms", summaryOf(times)}, {"read_ms", readMilliseconds}};
}

Json benchStart(const std::string& file, const std::vector<std::string>& flags, int repeats) {
    const TemporaryFolder folder;
    const fs::path statistics = folder.path / "first.json";
    std::string command = quoted((programFolder() / "voledit").string()) + " render " + quoted(file) + " --quiet -o " +
                          quoted((folder.path / "first.png").string()) + " --stats " + quoted(statistics.string());
    for (const std::string& flag : flags) command += " " + quoted(flag);
    std::vector<double> times, firstImage, peak;
    for (int i = 0; i < repeats; ++i) {
        int status = 0;
        times.push_back(timeOf([&] { status = std::system(command.c_str()); }).wall);
        if (status != 0) throw Error("bench: \"" + command + "\" failed; run it by itself to see why");
        const Json json = Json::parse(std::ifstream(statistics));
        firstImage.push_back(json["first_image_ms"].get<double>());
        peak.push_back(json["peak_mib"].get<double>());
    }
    return {{"start_to_first_picture_ms", summaryOf(firstImage)},
            {"start_to_file_written_ms", summaryOf(times)},
            {"peak_mib", medianOf(peak)}};
}

}  // namespace voledit
