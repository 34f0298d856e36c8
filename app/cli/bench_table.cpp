#include "app/cli/bench_table.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/error.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

struct Column {
    const char* title;
    const char* member;
    const char* format;
};

constexpr Column kPictureColumns[] = {{"frame", "frame_ms", "%.1f"},
                                      {"cpu", "frame_cpu_ms", "%.1f"},
                                      {"rest", "rest_frame_ms", "%.1f"},
                                      {"deformed/rest", "deformed_over_rest", "%.2f"},
                                      {"edit", "edit_to_pixel_ms", "%.1f"},
                                      {"compile", "compile_ms", "%.1f"},
                                      {"start", "start_to_first_picture_ms", "%.0f"},
                                      {"MiB", "peak_mib", "%.0f"},
                                      {"dB", "psnr_db", "%.2f"}};
constexpr Column kWorkColumns[] = {{"MiB", "volume_mib", "%.1f"},
                                   {"raw read", "raw_read_ms", "%.1f"},
                                   {"read", "read_ms", "%.1f"},
                                   {"voxelise", "voxelise_ms", "%.1f"},
                                   {"Msamples/s", "voxelise_msamples_per_s", "%.1f"},
                                   {"Mpoints/s", "locate_mqueries_per_s", "%.1f"},
                                   {"one thread", "locate_one_thread_mqueries_per_s", "%.1f"}};

/// The number of a member: itself, or its median.
std::optional<double> numberOf(const Json& row, const std::string& member) {
    const auto found = row.find(member);
    if (found == row.end()) return std::nullopt;
    if (found->is_number()) return found->get<double>();
    if (found->is_object() && found->contains("median")) return (*found)["median"].get<double>();
    return std::nullopt;
}

std::string textOf(const Json& row, const Column& column) {
    const auto number = numberOf(row, column.member);
    if (!number) return "-";
    char text[32];
    std::snprintf(text, sizeof text, column.format, *number);
    return text;
}

using Lines = std::vector<std::vector<std::string>>;

std::string aligned(const Lines& lines) {
    std::vector<std::size_t> width;
    for (const auto& line : lines)
        for (std::size_t c = 0; c < line.size(); ++c) {
            width.resize(std::max(width.size(), c + 1));
            width[c] = std::max(width[c], line[c].size());
        }
    std::string text;
    for (const auto& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::string room(width[c] - line[c].size(), ' ');
            text += c == 0 ? line[c] + room : "  " + room + line[c];
        }
        text += "\n";
    }
    return text;
}

/// A heading and the rows of `list`, each with its words first.
template <std::size_t N>
std::string tableOf(const Json& list, const std::vector<const char*>& words, const Column (&columns)[N]) {
    Lines lines{{}};
    for (const char* word : words) lines[0].emplace_back(word);
    for (const Column& column : columns) lines[0].emplace_back(column.title);
    for (const Json& row : list) {
        std::vector<std::string> line;
        for (const char* word : words) line.push_back(row.value(word, ""));
        for (const Column& column : columns) line.push_back(textOf(row, column));
        lines.push_back(std::move(line));
        if (!row.contains("earlier_over_now")) continue;
        std::vector<std::string> ratios{"  against the earlier run"};
        ratios.resize(words.size());
        for (const Column& column : columns)
            ratios.push_back(textOf(row["earlier_over_now"], {column.title, column.member, "%.2f"}));
        lines.push_back(std::move(ratios));
    }
    return lines.size() > 1 ? aligned(lines) : "";
}

/// The row of `list` that measured the same as `row`; null where there is none.
const Json* sameRow(const Json& list, const Json& row) {
    for (const Json& other : list) {
        const auto equal = [&](const char* word) { return row.value(word, "") == other.value(word, ""); };
        if (equal("scene") && equal("size") && equal("renderer")) return &other;
    }
    return nullptr;
}

Json ratiosOf(const Json& now, const Json& earlier) {
    Json ratios = Json::object();
    for (const auto& [member, value] : now.items()) {
        const auto a = numberOf(earlier, member), b = numberOf(now, member);
        if (!a || !b) continue;
        const bool rate = member.ends_with("_per_s");
        if (member == "psnr_db")
            ratios[member] = *b - *a;
        else if (rate ? *a > 0 : *b > 0)
            ratios[member] = rate ? *b / *a : *a / *b;
    }
    return ratios;
}

}  // namespace

std::string benchTable(const Json& run) {
    const std::string pictures = tableOf(run["pictures"], {"scene", "size", "renderer"}, kPictureColumns);
    const std::string work = tableOf(run["work"], {"scene"}, kWorkColumns);
    return "Milliseconds (medians), CPU milliseconds of all threads, MiB, dB against rays of 1/16 spacing\n" +
           pictures + (work.empty() ? "" : "\n" + work);
}

void compareRuns(Json& run, const Json& earlier) {
    if (!earlier.is_object() || !earlier.contains("pictures") || !earlier.contains("work"))
        throw Error("--compare", "it is not what `voledit bench` writes",
                    "name a file made by `voledit bench -o FILE`");
    for (const char* list : {"pictures", "work"})
        for (Json& row : run[list])
            if (const Json* other = sameRow(earlier[list], row)) row["earlier_over_now"] = ratiosOf(row, *other);
}

}  // namespace voledit
