#include "app/cli/arguments.h"

#include <CLI/App.hpp>
#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

void CommonArguments::apply() const {
    if (threads < 0 || threads > 4096) throw UsageError("--threads: give a number from 1 to 4096");
    setThreadCount(threads);
    if (!memoryLimit.empty()) setMemoryLimit(parseBytes(memoryLimit, "--memory-limit"));
}

OpenOptions InputArguments::options() const {
    OpenOptions options;
    options.scene.allowOutside = allowOutside;
    if (!raw.empty()) {
        try {
            options.read.raw = parseRawFormat(raw);
        } catch (const std::exception& error) {
            throw UsageError(error.what());
        }
    }
    if (!spacing.empty()) options.read.spacing = parseSpacing(spacing, "--spacing");
    // Headerless voxels may be given theirs by either flag.
    if (options.read.raw && options.read.spacing && options.read.raw->spacing == Vec3(1))
        options.read.raw->spacing = *options.read.spacing;
    return options;
}

void addCommonArguments(CLI::App& command, CommonArguments& arguments) {
    command.add_flag("--quiet", arguments.quiet, "Only errors and warnings on standard error");
    command.add_flag("--verbose", arguments.verbose, "Say what is done and how long it took");
    command.add_option("--threads", arguments.threads, "Threads to use (all cores)")->type_name("N");
    command.add_option("--memory-limit", arguments.memoryLimit, "Memory that reading a file may take, e.g. 2G")
        ->type_name("SIZE");
}

void addInputArguments(CLI::App& command, InputArguments& arguments, const std::string& name) {
    command.add_option(name, arguments.file, "A scene (.voledit), a volume file, a folder or a numbered pattern")
        ->required();
    command.add_flag("--allow-outside", arguments.allowOutside, "Let a scene name files outside its folder");
    command.add_option("--raw", arguments.raw, "Read as headerless voxels: SIZE,TYPE[,SPACING][,endian]")
        ->type_name("FORMAT");
    command.add_option("--spacing", arguments.spacing, "Spacing of a picture stack that carries none: S or X,Y,Z")
        ->type_name("S");
}

OpenedScene open(IoClient& io, const InputArguments& input, const CommonArguments& common) {
    OpenedScene opened;
    const OpenOptions options = input.options();
    withProgress("Reading " + input.file, common.verbosity(),
                 [&](Progress* progress) { opened = openFile(io, input.file, options, progress); });
    printWarnings(opened.warnings);
    return opened;
}

MotionFile readMotionFile(IoClient& io, const std::string& path, const CommonArguments& common) {
    MotionFile file;
    withProgress("Reading " + path, common.verbosity(),
                 [&](Progress* progress) { file = io.readMotion(path, progress); });
    printWarnings(file.warnings);
    return file;
}

namespace {

void refuseMotion(const std::string& path) {
    if (isMotionFile(path))
        throw Error(path, "holds a motion, where a volume is needed", "name a volume; motions are for voledit pose");
}

}  // namespace

VolumeFile readVolumeFile(IoClient& io, const InputArguments& input, const CommonArguments& common) {
    refuseMotion(input.file);
    const OpenOptions options = input.options();
    VolumeFile file;
    withProgress("Reading " + input.file, common.verbosity(),
                 [&](Progress* progress) { file = io.readVolume(input.file, options.read, progress); });
    printWarnings(file.warnings);
    return file;
}

std::variant<VolumeFile, MeshFile> readVolumeOrMeshFile(IoClient& io, const InputArguments& input,
                                                        const CommonArguments& common) {
    refuseMotion(input.file);
    const OpenOptions options = input.options();
    std::variant<VolumeFile, MeshFile> file;
    withProgress("Reading " + input.file, common.verbosity(),
                 [&](Progress* progress) { file = io.readVolumeOrMesh(input.file, options.read, progress); });
    std::visit([](const auto& any) { printWarnings(any.warnings); }, file);
    return file;
}

CompiledScene compileAt(const OpenedScene& opened, const InputArguments& input, double time, double aspect) {
    const Timeline& timeline = opened.scene.timeline;
    try {
        CompiledScene compiled = compile(opened.scene, opened.assets,
                                         std::isnan(time) ? timeline.start / timeline.fps : time, nullptr, aspect);
        printWarnings(compiled.warnings);
        return compiled;
    } catch (const Error& error) {
        throw Error(input.file + ": " + error.what());
    }
}

namespace {

std::optional<double> number(std::string_view text) {
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto at = text.find_first_of(separators);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

std::vector<int> wholeNumbers(const std::string& text, std::size_t count, int largest, const std::string& flag) {
    std::vector<int> values;
    for (const auto part : split(text, "xX,")) {
        const auto value = number(part);
        if (!value || *value != std::floor(*value) || *value < 1 || *value > largest) {
            values.clear();
            break;
        }
        values.push_back(static_cast<int>(*value));
    }
    if (values.size() != count)
        throw UsageError(flag + " " + text + ": give " + std::to_string(count) +
                         " whole numbers joined by x, each from 1 to " + std::to_string(largest));
    return values;
}

}  // namespace

Index2 parseSize2(const std::string& text, const std::string& flag) {
    const auto v = wholeNumbers(text, 2, 16384, flag);
    return {v[0], v[1]};
}

Index3 parseSize3(const std::string& text, const std::string& flag) {
    const auto v = wholeNumbers(text, 3, 65536, flag);
    return {v[0], v[1], v[2]};
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& flag) {
    std::vector<double> values;
    for (const auto part : split(text, ",")) {
        const auto value = number(part);
        if (!value) throw UsageError(flag + " " + text + ": \"" + std::string(part) + "\" is not a finite number");
        values.push_back(*value);
    }
    if (values.size() != count)
        throw UsageError(flag + " " + text + ": give " + std::to_string(count) + " numbers separated by commas");
    return values;
}

Vec3 parseSpacing(const std::string& text, const std::string& flag) {
    const auto parts = split(text, "xX,");
    Vec3 spacing;
    for (int a = 0; a < 3; ++a) {
        const auto value = number(parts[parts.size() == 3 ? std::size_t(a) : 0]);
        if (!value || *value <= 0 || (parts.size() != 1 && parts.size() != 3))
            throw UsageError(flag + " " + text + ": give one positive number, or three joined by x or commas");
        spacing[a] = *value;
    }
    return spacing;
}

std::size_t parseBytes(const std::string& text, const std::string& flag) {
    const auto letters = text.find_first_not_of("0123456789.");
    const auto value = number(text.substr(0, letters));
    std::string unit = letters == std::string::npos ? "" : text.substr(letters);
    for (const std::string tail : {"iB", "ib", "B", "b"})
        if (unit.size() >= tail.size() && unit.ends_with(tail)) {
            unit.resize(unit.size() - tail.size());
            break;
        }
    const std::string units = "kmgt";
    const auto power = unit.empty() ? 0 : units.find(static_cast<char>(std::tolower(unit[0]))) + 1;
    if (!value || *value <= 0 || unit.size() > 1 || (!unit.empty() && power == 0) || power > units.size())
        throw UsageError(flag + " " + text + ": give a size such as 800M or 2G");
    return static_cast<std::size_t>(*value * std::pow(1024.0, static_cast<double>(power)));
}

}  // namespace voledit
