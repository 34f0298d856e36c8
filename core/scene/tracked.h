#pragma once
// Values that may change over time: tracks of keys (scene-format.md §1, Tracks; definitions.md §5).

#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/types.h"
#include "core/fields/transfer_function.h"

namespace voledit {

/// Keys over time, held beyond the ends. Two keys of one time make a jump: the first's value holds up to it, the
/// second's from it on.
struct Track {
    enum class Interpolation : std::uint8_t { Step, Linear, Smooth };
    struct Key {
        double time = 0;            // seconds
        std::vector<double> value;  // one number, or all of a list's, lists within lists laid flat
        std::optional<Interpolation> interpolation = {};  // to the next key, where it is not the track's
        bool operator==(const Key&) const = default;
    };
    std::vector<Key> keys;  // at least one, times not decreasing, values of one length
    Interpolation interpolation = Interpolation::Linear;

    bool operator==(const Track&) const = default;
    /// The value at t seconds, any t. Smooth is Catmull–Rom over the keys' own times: a cubic through both keys whose
    /// slope at a key is that of the line through its neighbours, at the ends and at jumps (two keys of one time,
    /// steps) that of the one segment.
    std::vector<double> at(double t) const;

    /// From key k to the next.
    Interpolation interpolationFrom(std::size_t k) const { return keys[k].interpolation.value_or(interpolation); }
    /// The last key at or before t, and how far t is from it to the next, in [0, 1); nullopt before the first.
    struct Place {
        std::size_t key = 0;
        double fraction = 0;  // 0 at and beyond the last key
    };
    std::optional<Place> placeOf(double t) const;
    /// Whether the value runs on without a jump from key k − 1 to key k.
    bool joined(std::size_t k) const {
        return keys[k - 1].time < keys[k].time && interpolationFrom(k - 1) != Interpolation::Step;
    }
};

/// The track of a whole value, or of one number or vector in it.
struct PartTrack {
    static constexpr int kWhole = -1;
    /// Index of the first number that it sets, lists within lists laid flat; it sets as many as its keys have. kWhole:
    /// all of them, and how many there are.
    int part = kWhole;
    Track track;
    bool operator==(const PartTrack&) const = default;
};

/// The numbers of a value as tracks count them: lists within lists laid flat, matrices row by row.
std::vector<double> numbersOf(double value);
std::vector<double> numbersOf(const Vec2& value);
std::vector<double> numbersOf(const Vec3& value);
std::vector<double> numbersOf(const Mat4& value);
std::vector<double> numbersOf(const std::vector<double>& value);
std::vector<double> numbersOf(const std::vector<Vec3>& value);
std::vector<double> numbersOf(const PiecewiseLinear& value);
std::vector<double> numbersOf(const ColorTable& value);
/// Makes `value` of its numbers: the inverse of `numbersOf`. There must be as many as the type needs.
void setNumbers(double& value, std::span<const double> numbers);
void setNumbers(Vec2& value, std::span<const double> numbers);
void setNumbers(Vec3& value, std::span<const double> numbers);
void setNumbers(Mat4& value, std::span<const double> numbers);
void setNumbers(std::vector<double>& value, std::span<const double> numbers);
void setNumbers(std::vector<Vec3>& value, std::span<const double> numbers);
void setNumbers(PiecewiseLinear& value, std::span<const double> numbers);
void setNumbers(ColorTable& value, std::span<const double> numbers);

/// `numbers` with what `tracks` say at t seconds in its place.
std::vector<double> withTracksAt(std::vector<double> numbers, const std::vector<PartTrack>& tracks, double t);

/// The same for a value of a type, which may have an interpolation of its own.
template <class T>
std::vector<double> numbersAtTime(const T& value, const std::vector<PartTrack>& tracks, double t) {
    return withTracksAt(numbersOf(value), tracks, t);
}

/// Puts `numbers` into the keys at t seconds of every track: those there are, or new ones, which go on as the key
/// before does.
void setKeysAt(std::vector<PartTrack>& tracks, const std::vector<double>& numbers, double t);

/// A T that may have tracks. Reads as a T; assigning a T drops its tracks. Copies share the tracks.
template <class T>
class Tracked {
public:
    Tracked(T value = T{}) : value_(std::move(value)) {}  // NOLINT: implicit, as values are
    /// T{a, b, …}: for vectors.
    template <class... A>
    requires(sizeof...(A) > 1 && std::is_constructible_v<T, A...>) Tracked(A... a)
        : value_(a...) {}  // NOLINT: implicit, as values are

    /// The value without tracks; with them, that of their first keys. (`at`, or `sceneAt`, gives the value at a time.)
    const T& operator*() const { return value_; }
    const T* operator->() const { return &value_; }
    operator const T&() const { return value_; }  // NOLINT: reads as a T

    bool animated() const { return tracks_ != nullptr; }
    /// Empty where it does not change over time.
    const std::vector<PartTrack>& tracks() const {
        static const std::vector<PartTrack> none;
        return tracks_ ? *tracks_ : none;
    }
    /// One track of the whole, or tracks of parts that do not overlap, in ascending order, within the value.
    void setTracks(std::vector<PartTrack> tracks) {
        if (!tracks.empty()) setNumbers(value_, withTracksAt(numbersOf(value_), tracks, -kInfinity));
        tracks_ = tracks.empty() ? nullptr : std::make_shared<const std::vector<PartTrack>>(std::move(tracks));
    }
    /// The value from now on; with a time and tracks, only at the key of that time, which is made if need be.
    void set(T value, std::optional<double> time) {
        std::vector<PartTrack> changed = time ? tracks() : std::vector<PartTrack>{};
        if (time) setKeysAt(changed, numbersOf(value), *time);
        value_ = std::move(value);
        setTracks(std::move(changed));
    }
    /// The value at t seconds.
    T at(double t) const {
        if (!tracks_) return value_;
        T result;
        setNumbers(result, numbersAtTime(value_, *tracks_, t));
        return result;
    }

private:
    T value_;
    std::shared_ptr<const std::vector<PartTrack>> tracks_;  // null, or not empty
};

/// By value. (A template, so that a Tracked<double> can still be compared with a number.)
template <class T>
bool operator==(const Tracked<T>& a, const Tracked<T>& b) {
    return *a == *b && (&a.tracks() == &b.tracks() || a.tracks() == b.tracks());
}
/// A plain value equals a tracked one without tracks. (Numbers compare as numbers, by their first keys.)
template <class T>
requires std::is_class_v<T>
bool operator==(const Tracked<T>& a, const std::type_identity_t<T>& b) {
    return !a.animated() && *a == b;
}

}  // namespace voledit
