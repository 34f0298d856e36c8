#include "core/scene/tracked.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace voledit {

namespace {

/// Slope of number n at key k, seen from the segment that ends (`before`) or starts there.
double slopeAt(const Track& track, std::size_t k, std::size_t n, bool before) {
    const auto& keys = track.keys;
    std::size_t from = k, to = k;
    if (k > 0 && (before || track.joined(k))) from = k - 1;
    if (k + 1 < keys.size() && (!before || track.joined(k + 1))) to = k + 1;
    return (keys[to].value[n] - keys[from].value[n]) / (keys[to].time - keys[from].time);
}

/// Number n on the cubic Hermite segment from key k, at fraction f of it.
double smoothAt(const Track& track, std::size_t k, std::size_t n, double f) {
    const auto& keys = track.keys;
    const double length = keys[k + 1].time - keys[k].time;
    const double a = keys[k].value[n], b = keys[k + 1].value[n];
    const double slopeA = slopeAt(track, k, n, false) * length, slopeB = slopeAt(track, k + 1, n, true) * length;
    const double g = 1 - f;
    return a + f * f * (3 - 2 * f) * (b - a) + f * g * g * slopeA - f * f * g * slopeB;
}

}  // namespace

std::optional<Track::Place> Track::placeOf(double t) const {
    assert(!keys.empty());
    const auto after =
        std::upper_bound(keys.begin(), keys.end(), t, [](double time, const Key& key) { return time < key.time; });
    if (after == keys.begin()) return std::nullopt;
    const auto k = std::size_t(after - keys.begin()) - 1;
    if (after == keys.end()) return Place{k, 0};
    return Place{k, (t - keys[k].time) / (keys[k + 1].time - keys[k].time)};
}

std::vector<double> Track::at(double t) const {
    const auto place = placeOf(t);
    if (!place) return keys.front().value;
    const auto [k, f] = *place;
    const Interpolation how = interpolationFrom(k);
    if (f == 0 || how == Interpolation::Step) return keys[k].value;
    std::vector<double> result(keys[k].value.size());
    for (std::size_t n = 0; n < result.size(); ++n)
        result[n] = how == Interpolation::Smooth ? smoothAt(*this, k, n, f)
                                                 : keys[k].value[n] + f * (keys[k + 1].value[n] - keys[k].value[n]);
    return result;
}

std::vector<double> numbersOf(double value) {
    return {value};
}
std::vector<double> numbersOf(const Vec2& value) {
    return {value.x, value.y};
}
std::vector<double> numbersOf(const Vec3& value) {
    return {value.x, value.y, value.z};
}
std::vector<double> numbersOf(const Mat4& value) {
    std::vector<double> numbers(16);
    for (int n = 0; n < 16; ++n) numbers[std::size_t(n)] = value[n % 4][n / 4];
    return numbers;
}
std::vector<double> numbersOf(const std::vector<double>& value) {
    return value;
}
std::vector<double> numbersOf(const std::vector<Vec3>& value) {
    std::vector<double> numbers;
    numbers.reserve(3 * value.size());
    for (const Vec3& v : value) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    return numbers;
}
std::vector<double> numbersOf(const PiecewiseLinear& value) {
    std::vector<double> numbers;
    numbers.reserve(2 * value.points.size());
    for (const Vec2& point : value.points) numbers.insert(numbers.end(), {point.x, point.y});
    return numbers;
}
std::vector<double> numbersOf(const ColorTable& value) {
    std::vector<double> numbers;
    numbers.reserve(4 * value.points.size());
    for (const auto& point : value.points)
        numbers.insert(numbers.end(), {point.value, point.color.r, point.color.g, point.color.b});
    return numbers;
}

void setNumbers(double& value, std::span<const double> numbers) {
    assert(numbers.size() == 1);
    value = numbers[0];
}
void setNumbers(Vec2& value, std::span<const double> numbers) {
    assert(numbers.size() == 2);
    value = {numbers[0], numbers[1]};
}
void setNumbers(Vec3& value, std::span<const double> numbers) {
    assert(numbers.size() == 3);
    value = {numbers[0], numbers[1], numbers[2]};
}
void setNumbers(Mat4& value, std::span<const double> numbers) {
    assert(numbers.size() == 16);
    for (int n = 0; n < 16; ++n) value[n % 4][n / 4] = numbers[std::size_t(n)];
}
void setNumbers(std::vector<double>& value, std::span<const double> numbers) {
    value.assign(numbers.begin(), numbers.end());
}
void setNumbers(std::vector<Vec3>& value, std::span<const double> numbers) {
    assert(numbers.size() % 3 == 0);
    value.clear();
    value.reserve(numbers.size() / 3);
    for (std::size_t n = 0; n < numbers.size(); n += 3) value.emplace_back(numbers[n], numbers[n + 1], numbers[n + 2]);
}
void setNumbers(PiecewiseLinear& value, std::span<const double> numbers) {
    assert(numbers.size() % 2 == 0);
    value.points.clear();
    value.points.reserve(numbers.size() / 2);
    for (std::size_t n = 0; n < numbers.size(); n += 2) value.points.emplace_back(numbers[n], numbers[n + 1]);
}
void setNumbers(ColorTable& value, std::span<const double> numbers) {
    assert(numbers.size() % 4 == 0);
    value.points.clear();
    value.points.reserve(numbers.size() / 4);
    for (std::size_t n = 0; n < numbers.size(); n += 4)
        value.points.push_back({numbers[n], {numbers[n + 1], numbers[n + 2], numbers[n + 3]}});
}

std::vector<double> withTracksAt(std::vector<double> numbers, const std::vector<PartTrack>& tracks, double t) {
    for (const auto& [part, track] : tracks) {
        std::vector<double> now = track.at(t);
        if (part == PartTrack::kWhole) {
            numbers = std::move(now);
            continue;
        }
        assert(std::size_t(part) + now.size() <= numbers.size());
        std::copy(now.begin(), now.end(), numbers.begin() + part);
    }
    return numbers;
}

void setKeysAt(std::vector<PartTrack>& tracks, const std::vector<double>& numbers, double t) {
    for (auto& [part, track] : tracks) {
        const auto first = numbers.begin() + std::max(part, 0);
        const auto count = part == PartTrack::kWhole ? numbers.size() : track.keys[0].value.size();
        const std::vector<double> value(first, first + std::ptrdiff_t(count));
        const auto after = std::upper_bound(track.keys.begin(), track.keys.end(), t,
                                            [](double time, const Track::Key& key) { return time < key.time; });
        if (after == track.keys.begin()) {
            track.keys.insert(after, {t, value, {}});
        } else if (const auto before = after - 1; before->time == t) {
            before->value = value;  // of a jump, what holds from then on
        } else {
            const auto interpolation = before->interpolation;
            track.keys.insert(after, {t, value, interpolation});
        }
    }
}

}  // namespace voledit
