#include "core/scene/appearance.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/fields/statistics.h"

namespace voledit {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

PiecewiseLinear piecewiseLinear(const json& rows) {
    PiecewiseLinear table;
    for (const auto& row : rows) table.points.emplace_back(row.at(0).get<double>(), row.at(1).get<double>());
    return table;
}

ColorTable colorTable(const json& rows) {
    ColorTable table;
    for (const auto& row : rows)
        table.points.push_back(
            {row.at(0).get<double>(), {row.at(1).get<double>(), row.at(2).get<double>(), row.at(3).get<double>()}});
    return table;
}

Preset readPreset(const fs::path& path) {
    try {
        std::ifstream file(path);
        const json contents = json::parse(file);
        Preset preset;
        preset.name = path.stem().string();
        preset.title = contents.at("title").get<std::string>();
        preset.description = contents.at("description").get<std::string>();
        preset.relative = contents.value("relative", false);
        preset.tables.color = colorTable(contents.at("color"));
        preset.tables.opacity = piecewiseLinear(contents.at("opacity"));
        if (contents.contains("gradientOpacity"))
            preset.tables.gradientOpacity = piecewiseLinear(contents.at("gradientOpacity"));
        return preset;
    } catch (const json::exception& error) {
        throw Error(path.string(), std::string("not an appearance preset (") + error.what() + ")",
                    "a preset has title, description, color [[value, r, g, b], …] and opacity [[value, o], …]");
    }
}

std::vector<Preset> readPresets() {
    const fs::path folder = resourceFolder() / "appearances";
    std::error_code failure;
    std::vector<Preset> all;
    for (const auto& entry : fs::directory_iterator(folder, failure))
        if (entry.path().extension() == ".json") all.push_back(readPreset(entry.path()));
    if (failure) throw Error(folder.string(), failure.message(), "set VOLEDIT_RESOURCES to voledit's resources");
    std::sort(all.begin(), all.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
    return all;
}

/// A relative preset's tables laid over min … max.
TransferFunction stretched(TransferFunction tables, double min, double max) {
    const double range = max - min;
    for (auto& point : tables.color.points) point.value = min + range * point.value;
    for (auto& point : tables.opacity.points) point.x = min + range * point.x;
    for (auto& point : tables.gradientOpacity.points) point.x *= range;
    return tables;
}

}  // namespace

const std::vector<Preset>& presets() {
    static const std::vector<Preset> all = readPresets();
    return all;
}

const Preset& presetNamed(const std::string& name) {
    std::string known;
    for (const Preset& preset : presets()) {
        if (preset.name == name) return preset;
        known += (known.empty() ? "" : ", ") + preset.name;
    }
    throw Error("appearance preset \"" + name + "\"", "there is none of this name", "choose one of: " + known);
}

TransferFunction resolve(const Appearance& appearance, const Volume& volume) {
    return resolve(appearance, Interval{volume.statistics().min, volume.statistics().max});
}

TransferFunction resolve(const Appearance& appearance, const Interval& range) {
    TransferFunction tables = greyRamp(range.low, range.high);
    if (!appearance.preset.empty()) {
        const Preset& preset = presetNamed(appearance.preset);
        tables = preset.relative ? stretched(preset.tables, range.low, range.high) : preset.tables;
    }
    if (appearance.color) tables.color = *appearance.color;
    if (appearance.opacity) tables.opacity = *appearance.opacity;
    if (appearance.gradientOpacity) tables.gradientOpacity = *appearance.gradientOpacity;
    return tables;
}

namespace {

/// Share of the samples on the box's faces that are denser than air, for a CT in Hounsfield units; every fourth row.
double faceShareOfTissue(const Volume& volume) {
    constexpr double kDenserThanAir = -300;
    const Index3 n = volume.grid().size;
    std::size_t tissue = 0, all = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side)
            for (int j = 0; j < n[v]; j += 4)
                for (int i = 0; i < n[u]; ++i) {
                    Index3 at;
                    at[axis] = side ? n[axis] - 1 : 0;
                    at[u] = i;
                    at[v] = j;
                    tissue += volume.at(at) > kDenserThanAir;
                    ++all;
                }
    }
    return double(tissue) / double(all);
}

}  // namespace

std::string suggestedPreset(const Volume& volume) {
    const auto& statistics = volume.statistics();
    if (!(statistics.max > statistics.min)) return "";
    const bool real = volume.type() == VoxelType::Float || volume.type() == VoxelType::Double;
    const bool mayBeHounsfield = real || volume.type() == VoxelType::Int16 || volume.type() == VoxelType::Int32;
    // Air of −1000 HU gives CT away; what scanners pad with lies lower still.
    // A scan cut out of a body shows no skin, only the cut: there vessels and bones are worth seeing.
    if (mayBeHounsfield && statistics.min <= -900 && statistics.min >= -9000 && statistics.max >= 200)
        return faceShareOfTissue(volume) > 0.3 ? "ct-angiography" : "ct-skin";
    // A fog volume: densities from 0, most of the box clear air.
    if (!real || statistics.min != 0) return "grey";
    const auto histogram = countedStatistics(volume).histogram;
    const auto count = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t(0));
    return !histogram.empty() && histogram.front() > count / 2 ? "smoke" : "grey";
}

}  // namespace voledit
