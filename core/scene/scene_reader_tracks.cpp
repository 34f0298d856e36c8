// Numbers, vectors and lists of a scene file, with their tracks.
#include <algorithm>

#include "core/scene/json_schema.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

Track::Interpolation interpolationOf(const std::string& word) {
    static const std::vector<std::string> words{"step", "linear", "smooth"};
    return Track::Interpolation(std::find(words.begin(), words.end(), word) - words.begin());
}

}  // namespace

Track SceneReader::track(const JsonView& view, Shape shape) const {
    Track result;
    const JsonView keys = view["keys"];
    result.keys.reserve(keys.value.size());
    for (std::size_t k = 0; k < keys.value.size(); ++k) {
        const JsonView key = keys[k];
        const JsonView value = key[1];
        Numbers flat;
        collect(value, shape, flat, false);
        result.keys.push_back({key.value[0].get<double>(), std::move(flat.values)});
        if (key.value.size() > 2) result.keys.back().interpolation = interpolationOf(key[2].text());
        if (k == 0) continue;
        if (result.keys[k].time < result.keys[k - 1].time)
            fail(key[0].place, "found " + described(key.value[0]) + " after " + described(keys.value[k - 1][0]),
                 "put the keys in the order of their times");
        if (result.keys[k].value.size() != result.keys[0].value.size())
            fail(value.place,
                 "this key's value has " + std::to_string(result.keys[k].value.size()) + " numbers, the first key's " +
                     std::to_string(result.keys[0].value.size()),
                 "give every key a value of one length");
    }
    if (view.has("interpolation")) result.interpolation = interpolationOf(view["interpolation"].text());
    return result;
}

/// Appends the numbers of `view`, which the schema knows to have `shape`, and their tracks. `whole`: it is all of the
/// value.
void SceneReader::collect(const JsonView& view, Shape shape, Numbers& numbers, bool whole) const {
    if (view.value.is_object()) {
        Track found = track(view, shape);
        const auto& first = found.keys[0].value;
        const int part = whole ? PartTrack::kWhole : int(numbers.values.size());
        numbers.values.insert(numbers.values.end(), first.begin(), first.end());
        numbers.tracks.push_back({part, std::move(found)});
    } else if (view.value.is_array()) {
        for (std::size_t i = 0; i < view.value.size(); ++i) collect(view[i], shape.subspan(1), numbers, false);
    } else {
        numbers.values.push_back(view.value.get<double>());
    }
}

template <class T>
Tracked<T> SceneReader::tracked(const JsonView& view, std::initializer_list<int> shape) const {
    Numbers numbers;
    collect(view, Shape(shape.begin(), shape.size()), numbers, true);
    T value;
    setNumbers(value, numbers.values);
    Tracked<T> result(std::move(value));
    result.setTracks(std::move(numbers.tracks));
    return result;
}

Tracked<double> SceneReader::number(const JsonView& view) const {
    if (view.value.is_number()) return view.value.get<double>();
    return tracked<double>(view, {});
}

Tracked<Vec2> SceneReader::pair(const JsonView& view) const {
    return tracked<Vec2>(view, {2});
}

Tracked<Rotation> SceneReader::rotation(const JsonView& view) const {
    return tracked<Rotation>(view, {3});
}

Tracked<Vec3> SceneReader::vector(const JsonView& view) const {
    return tracked<Vec3>(view, {3});
}

Tracked<Vec3> SceneReader::numberOrThree(const JsonView& view) const {
    if (view.value.is_number()) return Vec3(view.value.get<double>());
    if (view.value.is_array() || view["keys"].value[0][1].is_array()) return vector(view);
    Track ofOne = track(view, {});
    for (auto& key : ofOne.keys) key.value.assign(3, key.value[0]);
    Tracked<Vec3> result;
    result.setTracks({{PartTrack::kWhole, std::move(ofOne)}});
    return result;
}

Tracked<Mat4> SceneReader::matrix(const JsonView& view) const {
    return tracked<Mat4>(view, {16});
}

Tracked<std::vector<Vec3>> SceneReader::vectors(const JsonView& view) const {
    return tracked<std::vector<Vec3>>(view, {kAny, 3});
}

Tracked<std::vector<double>> SceneReader::numbers(const JsonView& view) const {
    return tracked<std::vector<double>>(view, {kAny});
}

Tracked<PiecewiseLinear> SceneReader::piecewiseLinear(const JsonView& view) const {
    auto table = tracked<PiecewiseLinear>(view, {kAny, 2});
    checkAscending(view, numbersOf(*table), 2);
    return table;
}

Tracked<ColorTable> SceneReader::colorTable(const JsonView& view) const {
    auto table = tracked<ColorTable>(view, {kAny, 4});
    checkAscending(view, numbersOf(*table), 4);
    return table;
}

/// The first number of every row of `columns` does not decrease. (Where tracks make them, `sceneAt` holds it up.)
void SceneReader::checkAscending(const JsonView& table, const std::vector<double>& numbers, std::size_t columns) const {
    for (std::size_t i = columns; i < numbers.size(); i += columns) {
        if (numbers[i] >= numbers[i - columns]) continue;
        const bool isList = table.value.is_array();
        fail(isList ? table[i / columns].place : table.place, "the table's values decrease here",
             "sort its rows by their first number");
    }
}

}  // namespace voledit
