// Tracks of rotations.
#include "core/scene/scene_actors.h"

#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace voledit {

namespace {

/// The rotation vector (axis times angle in radians, at most π) of a unit quaternion.
Vec3 logOf(Quat q) {
    if (q.w < 0) q = -q;  // the shorter way round
    const Vec3 v(q.x, q.y, q.z);
    const double sine = glm::length(v);
    return sine > 0 ? v * (2 * std::atan2(sine, q.w) / sine) : Vec3(0);
}

Quat expOf(const Vec3& rotation) {
    const double angle = glm::length(rotation);
    // sin(x/2)/x, by its series where the quotient would lose all digits.
    const double factor = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5;
    const Vec3 v = factor * rotation;
    return {std::cos(angle / 2), v.x, v.y, v.z};
}

Quat keyOf(const Track& track, std::size_t k) {
    const auto& value = track.keys[k].value;
    return quatOfDegrees({value[0], value[1], value[2]});
}

/// Rotation from key k to the next, in the axes of either (it leaves its own axis where it is).
Vec3 stepFrom(const Track& track, std::size_t k) {
    return logOf(glm::conjugate(keyOf(track, k)) * keyOf(track, k + 1));
}

/// Angular velocity at key k, in its own axes, seen from the segment that ends (`before`) or starts there.
Vec3 velocityAt(const Track& track, std::size_t k, bool before) {
    const auto& keys = track.keys;
    Vec3 turned(0);
    double time = 0;
    if (k > 0 && (before || track.joined(k))) {
        turned += stepFrom(track, k - 1);
        time += keys[k].time - keys[k - 1].time;
    }
    if (k + 1 < keys.size() && (!before || track.joined(k + 1))) {
        turned += stepFrom(track, k);
        time += keys[k + 1].time - keys[k].time;
    }
    return turned / time;
}

/// The Hermite curve of unit quaternions from key k at fraction f: q₀ ∏ exp(ωᵢ B̃ᵢ(f)), B̃ᵢ the cumulative cubic
/// Bernstein polynomials [Kim, Kim, Shin 1995, §4.2].
Quat smoothAt(const Track& track, std::size_t k, double f) {
    const double length = track.keys[k + 1].time - track.keys[k].time;
    const Vec3 first = velocityAt(track, k, false) * (length / 3), last = velocityAt(track, k + 1, true) * (length / 3);
    const Quat from = keyOf(track, k), to = keyOf(track, k + 1);
    const Vec3 middle = logOf(expOf(-first) * (glm::conjugate(from) * to) * expOf(-last));
    const double g = 1 - f;
    return from * expOf(first * (1 - g * g * g)) * expOf(middle * (f * f * (3 - 2 * f))) * expOf(last * (f * f * f));
}

std::vector<double> rotationAt(const Track& track, double t) {
    const auto place = track.placeOf(t);
    if (!place) return track.keys.front().value;
    const auto [k, f] = *place;
    const Track::Interpolation how = track.interpolationFrom(k);
    if (f == 0 || how == Track::Interpolation::Step) return track.keys[k].value;
    const Quat now =
        how == Track::Interpolation::Smooth ? smoothAt(track, k, f) : keyOf(track, k) * expOf(stepFrom(track, k) * f);
    return numbersOf(degreesOf(now));
}

}  // namespace

std::vector<double> numbersOf(const Rotation& value) {
    return numbersOf(value.degrees);
}

void setNumbers(Rotation& value, std::span<const double> numbers) {
    setNumbers(value.degrees, numbers);
}

std::vector<double> numbersAtTime(const Rotation& value, const std::vector<PartTrack>& tracks, double t) {
    const bool whole = tracks.size() == 1 && tracks[0].track.keys[0].value.size() == 3;
    return whole ? rotationAt(tracks[0].track, t) : withTracksAt(numbersOf(value), tracks, t);
}

}  // namespace voledit
