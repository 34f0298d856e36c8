// Numbers, vectors, tables and their tracks as JSON.
#include <algorithm>

#include "core/scene/scene_to_json.h"

namespace voledit {

namespace {

using nlohmann::ordered_json;
using voledit::toJson;
/// Extents of lists within lists; none for a single number.
using Shape = std::span<const std::size_t>;

std::size_t countOf(Shape shape) {
    std::size_t count = 1;
    for (const std::size_t extent : shape) count *= extent;
    return count;
}

ordered_json plain(std::span<const double> numbers, Shape shape) {
    if (shape.empty()) return numbers[0];
    ordered_json list = ordered_json::array();
    const std::size_t inner = countOf(shape.subspan(1));
    for (std::size_t n = 0; n < shape[0]; ++n)
        list.push_back(plain(numbers.subspan(n * inner, inner), shape.subspan(1)));
    return list;
}

ordered_json toJson(const Track& track, Shape shape) {
    static constexpr const char* words[] = {"step", "linear", "smooth"};
    ordered_json keys = ordered_json::array();
    for (const auto& key : track.keys) {
        keys.push_back({key.time, plain(key.value, shape)});
        if (key.interpolation) keys.back().push_back(words[std::size_t(*key.interpolation)]);
    }
    ordered_json result{{"keys", std::move(keys)}};
    if (track.interpolation != Track::Interpolation::Linear)
        result["interpolation"] = words[std::size_t(track.interpolation)];
    return result;
}

/// Numbers from `first` on with the tracks of parts among them.
ordered_json withParts(std::span<const double> numbers, Shape shape, std::size_t first,
                       std::span<const PartTrack> tracks) {
    const std::size_t count = countOf(shape);
    const auto startsAt = [](const PartTrack& track, std::size_t n) { return std::size_t(track.part) < n; };
    const auto mine = std::lower_bound(tracks.begin(), tracks.end(), first, startsAt);
    const auto end = std::lower_bound(mine, tracks.end(), first + count, startsAt);
    const std::span<const PartTrack> within(mine, end);
    if (within.empty()) return plain(numbers.subspan(first, count), shape);
    const bool all = std::size_t(within[0].part) == first && within[0].track.keys[0].value.size() == count;
    if (all) return toJson(within[0].track, shape);
    ordered_json list = ordered_json::array();
    const std::size_t inner = countOf(shape.subspan(1));
    for (std::size_t n = 0; n < shape[0]; ++n)
        list.push_back(withParts(numbers, shape.subspan(1), first + n * inner, within));
    return list;
}

/// A list, or its track, or one with tracks within.
ordered_json toJson(std::span<const double> numbers, const std::vector<PartTrack>& tracks,
                    const std::vector<std::size_t>& shape) {
    if (tracks.empty()) return plain(numbers, shape);
    if (tracks[0].part == PartTrack::kWhole) return toJson(tracks[0].track, shape);
    ordered_json list = ordered_json::array();
    const std::size_t inner = countOf(Shape(shape).subspan(1));
    for (std::size_t n = 0; n < shape[0]; ++n)
        list.push_back(withParts(numbers, Shape(shape).subspan(1), n * inner, tracks));
    return list;
}

/// True if every three numbers of the value and of its tracks are equal: a scale that one number says.
bool uniform(const Tracked<Vec3>& value) {
    const auto same = [](const std::vector<double>& v) { return v.size() == 3 && v[0] == v[1] && v[1] == v[2]; };
    if (!value.animated()) return same(numbersOf(*value));
    if (value.tracks()[0].part != PartTrack::kWhole) return false;
    const auto& keys = value.tracks()[0].track.keys;
    return std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return same(key.value); });
}

ordered_json scaleToJson(const Tracked<Vec3>& scale) {
    if (!uniform(scale)) return toJson(scale);
    Tracked<double> number = scale->x;
    auto tracks = scale.tracks();
    for (auto& part : tracks)
        for (auto& key : part.track.keys) key.value.resize(1);
    number.setTracks(std::move(tracks));
    return toJson(number);
}

ordered_json toJson(const TrackedFrame::Oblique& frame) {
    return {{"corner", toJson(frame.corner)},
            {"x", toJson(frame.edge[0])},
            {"y", toJson(frame.edge[1])},
            {"z", toJson(frame.edge[2])}};
}

}  // namespace

ordered_json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}
ordered_json toJson(const Index3& v) {
    return {v.x, v.y, v.z};
}

ordered_json toJson(const Tracked<double>& value) {
    return value.animated() ? toJson(value.tracks()[0].track, Shape{}) : ordered_json(*value);
}
ordered_json toJson(const Tracked<Vec2>& value) {
    return toJson(numbersOf(*value), value.tracks(), {2});
}
ordered_json toJson(const Tracked<Rotation>& value) {
    return toJson(numbersOf(*value), value.tracks(), {3});
}
ordered_json toJson(const Tracked<Vec3>& value) {
    return toJson(numbersOf(*value), value.tracks(), {3});
}
ordered_json toJson(const Tracked<Mat4>& value) {
    return toJson(numbersOf(*value), value.tracks(), {16});
}
ordered_json toJson(const Tracked<std::vector<double>>& value) {
    if (value->size() == 1)
        return value.animated() ? toJson(value.tracks()[0].track, Shape{}) : ordered_json(value->front());
    return toJson(*value, value.tracks(), {value->size()});
}
ordered_json toJson(const Tracked<std::vector<Vec3>>& value) {
    return toJson(numbersOf(*value), value.tracks(), {value->size(), 3});
}
ordered_json toJson(const Tracked<PiecewiseLinear>& table) {
    return toJson(numbersOf(*table), table.tracks(), {table->points.size(), 2});
}
ordered_json toJson(const Tracked<ColorTable>& table) {
    return toJson(numbersOf(*table), table.tracks(), {table->points.size(), 4});
}

ordered_json toJson(const TrackedBox& box) {
    return {{"min", toJson(box.min)}, {"max", toJson(box.max)}};
}

ordered_json toJson(const TrackedFrame& frame) {
    return std::visit([](const auto& form) { return toJson(form); }, formOf(frame));
}

ordered_json toJson(const Appearance& appearance) {
    ordered_json result = ordered_json::object();
    if (!appearance.preset.empty()) result["preset"] = appearance.preset;
    if (appearance.color) result["color"] = toJson(*appearance.color);
    if (appearance.opacity) result["opacity"] = toJson(*appearance.opacity);
    if (appearance.gradientOpacity) result["gradientOpacity"] = toJson(*appearance.gradientOpacity);
    return result;
}

void add(ordered_json& object, const Placement& placement) {
    const Placement none;
    if (placement.translate != none.translate) object["translate"] = toJson(placement.translate);
    if (placement.rotate != none.rotate) object["rotate"] = toJson(placement.rotate);
    if (placement.scale != none.scale) object["scale"] = scaleToJson(placement.scale);
    if (placement.matrix) object["matrix"] = toJson(*placement.matrix);
}

}  // namespace voledit
