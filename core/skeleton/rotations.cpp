// Rotations of joints: degrees, slerp, the arc between two directions.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/skeleton/skeleton.h"

namespace voledit {
namespace {

/// The same angle within [−180, 180], degrees.
double wrapped(double degrees) {
    return std::remainder(degrees, 360.0);
}

/// A unit vector across `v` (not 0).
Vec3 across(const Vec3& v) {
    const Vec3 size = glm::abs(v);
    const int least = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
    Vec3 axis(0);
    axis[least] = 1;
    return glm::normalize(glm::cross(v, axis));
}

}  // namespace

Quat quatOfDegrees(const Vec3& degrees) {
    const Vec3 half = degrees * (kPi / 360);
    const Quat x(std::cos(half.x), std::sin(half.x), 0, 0), y(std::cos(half.y), 0, std::sin(half.y), 0),
        z(std::cos(half.z), 0, 0, std::sin(half.z));
    return z * y * x;
}

Vec3 degreesOf(const Quat& q) {
    // With a, b, c the angles about x, y, z: w + y and x − z are (cos b/2 + sin b/2) times the cosine and the sine of
    // (a − c)/2, and w − y and x + z are (cos b/2 − sin b/2) times those of (a + c)/2. No arcsine, so nothing is lost
    // near b = ±90°, where only one of sum and difference is left and c is taken for 0.
    const double toDegrees = 180 / kPi;
    const double plus = std::hypot(q.w + q.y, q.x - q.z), minus = std::hypot(q.w - q.y, q.x + q.z);
    const double b = 2 * std::atan2(plus, minus) * toDegrees - 90;
    constexpr double kGimbalLock = 1e-12;
    const double difference = 2 * std::atan2(q.x - q.z, q.w + q.y) * toDegrees;
    const double sum = 2 * std::atan2(q.x + q.z, q.w - q.y) * toDegrees;
    if (minus < kGimbalLock) return {wrapped(difference), b, 0};
    if (plus < kGimbalLock) return {wrapped(sum), b, 0};
    return {wrapped((sum + difference) / 2), b, wrapped((sum - difference) / 2)};
}

Quat slerped(const Quat& a, const Quat& b, double s) {
    const Quat to = glm::dot(a, b) < 0 ? -b : b;
    const Quat apart = to + -a, middle = to + a;
    // Not the arccosine, which loses half the digits of small angles.
    const double angle = 2 * std::atan2(glm::length(apart), glm::length(middle));
    if (angle == 0 || s == 0) return a;
    if (s == 1) return to;
    return glm::normalize((a * std::sin((1 - s) * angle) + to * std::sin(s * angle)) / std::sin(angle));
}

Quat shortestArc(const Vec3& a, const Vec3& b) {
    const Vec3 from = glm::normalize(a), to = glm::normalize(b);
    const double cosine = glm::length(from + to) / 2, sine = glm::length(to - from) / 2;  // of half the angle
    Vec3 axis = glm::cross(from, to);
    const double size = glm::length(axis);
    if (size == 0 && sine < cosine) return Quat(1, 0, 0, 0);
    // Nearly opposite directions leave no digits of the plane they turn in; any one across `from` serves.
    if (size < 1e-12 && cosine < sine) {
        axis = across(from);
    } else {
        axis /= size;
        axis = glm::normalize(axis - from * glm::dot(axis, from));
    }
    return glm::normalize(Quat(cosine, axis * sine));
}

}  // namespace voledit
