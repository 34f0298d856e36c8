#include "app/editor/timeline/dope_rows.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace voledit {

namespace {

constexpr double kSameTime = 1e-6;  // seconds
constexpr const char* kDot = " · ";

void addMark(std::vector<DopeMark>& marks, const KeyRef& key, Track::Interpolation interpolation) {
    const auto at = std::lower_bound(marks.begin(), marks.end(), key.time - kSameTime,
                                     [](const DopeMark& mark, double time) { return mark.time < time; });
    if (at == marks.end() || !sameTime(at->time, key.time)) {
        marks.insert(at, {key.time, {key}, interpolation, false});
        return;
    }
    // Two keys of one time in one value are one jump, moved as one.
    if (!contains(at->keys, key)) at->keys.push_back(key);
    at->mixed |= at->interpolation != interpolation;
}

/// "bend · angle" as what stands for the node and for the value in it.
std::pair<std::string, std::string> partsOf(const std::string& label) {
    const auto dot = label.find(kDot);
    if (dot == label.npos) return {"scene", label};
    return {label.substr(0, dot), label.substr(dot + std::string(kDot).size())};
}

void addValue(std::vector<DopeRow>& rows, const Scene& scene, const KeyableValue& value, bool open) {
    const auto [nodeLabel, label] = partsOf(value.label);
    DopeRow row{.kind = DopeRow::Kind::Value, .id = value.path, .label = label, .marks = {}, .values = {value.path}};
    for (const KeyMark& mark : keysOf(scene, value.path))
        addMark(row.marks, {value.path, mark.time}, mark.interpolation);
    const auto take = [&](DopeRow& into) {
        into.values.push_back(value.path);
        for (const DopeMark& mark : row.marks)
            for (const KeyRef& key : mark.keys) addMark(into.marks, key, mark.interpolation);
    };
    take(rows.front());
    const auto node = std::find_if(rows.rbegin(), rows.rend(),
                                   [](const DopeRow& other) { return other.kind == DopeRow::Kind::Node; });
    if (node != rows.rend()) take(*node);
    if (open) rows.push_back(std::move(row));
}

/// Words of letters and digits, in small letters: "/root/by/0/toAxis" is root, by, 0, toaxis.
std::vector<std::string> wordsIn(const std::string& text) {
    std::vector<std::string> words;
    bool inside = false;
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        // What is not ASCII belongs to words, but for the dot between node and value.
        const bool letter = std::isalnum(u) || c == '_' || c == '-' || (u >= 0x80 && u != 0xC2 && u != 0xB7);
        if (letter && !inside) words.emplace_back();
        if (letter) words.back() += char(std::tolower(u));
        inside = letter;
    }
    return words;
}

bool endsWith(const std::vector<std::string>& words, const std::vector<std::string>& tail) {
    return !tail.empty() && tail.size() <= words.size() && std::equal(tail.rbegin(), tail.rend(), words.rbegin());
}

}  // namespace

bool sameTime(double a, double b) {
    return std::abs(a - b) <= kSameTime;
}

bool contains(const std::vector<KeyRef>& keys, const KeyRef& key) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const KeyRef& other) { return sameTime(other.time, key.time) && other.path == key.path; });
}

std::vector<DopeRow> dopeRows(const Scene& scene, const LoadedAssets& assets, const std::vector<std::string>& closed) {
    std::vector<DopeRow> rows{
        {.kind = DopeRow::Kind::Summary, .id = "", .label = "Summary", .marks = {}, .values = {}}};
    std::string node;
    bool open = true;
    for (const KeyableValue& value : animatedValues(scene)) {
        // The settings have no node: "camera" and "render" stand for theirs.
        const std::string id = value.node.empty() ? partsOf(value.label).first : value.node;
        if (id != node) {
            node = id;
            open = std::find(closed.begin(), closed.end(), node) == closed.end();
            rows.push_back({.kind = DopeRow::Kind::Node,
                            .id = node,
                            .label = partsOf(value.label).first,
                            .marks = {},
                            .values = {},
                            .open = open});
        }
        addValue(rows, scene, value, open);
    }
    for (const auto& [name, motion] : assets.motions)
        if (motion && scene.assets.contains(name))
            rows.push_back({.kind = DopeRow::Kind::Motion,
                            .id = name,
                            .label = name,
                            .marks = {},
                            .values = {},
                            .from = 0,
                            .to = motion->duration()});
    return rows;
}

std::optional<ValuePath> trackNamed(const Scene& scene, const std::string& name) {
    const std::vector<KeyableValue> values = animatedValues(scene);
    for (const KeyableValue& value : values)
        if (value.path == name || value.label == name) return value.path;
    const std::vector<std::string> wanted = wordsIn(name);
    for (const KeyableValue& value : values)
        if (endsWith(wordsIn(value.label), wanted) || endsWith(wordsIn(value.path), wanted)) return value.path;
    return std::nullopt;
}

std::vector<double> keyTimes(const Scene& scene, const std::vector<ValuePath>& values) {
    std::vector<double> times;
    const auto add = [&](const ValuePath& path) {
        for (const KeyMark& mark : keysOf(scene, path)) times.push_back(mark.time);
    };
    if (values.empty())
        for (const KeyableValue& value : animatedValues(scene)) add(value.path);
    for (const ValuePath& path : values) add(path);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end(), sameTime), times.end());
    return times;
}

}  // namespace voledit
