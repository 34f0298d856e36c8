#pragma once
// Four floats in one register.

#include <cstring>

#include "core/base/types.h"

namespace voledit {

/// By lanes: + − · /, comparisons, and the choice between two.
using Quad = float __attribute__((vector_size(16)));

inline Quad quadOf(const Vec4f& v) {
    Quad q;
    std::memcpy(&q, &v, sizeof q);
    return q;
}
inline Quad quadOf(float all) {
    return Quad{all, all, all, all};
}
inline Quad quadOf(const Vec3& v) {
    return Quad{float(v.x), float(v.y), float(v.z), 0};
}
inline Vec3 vec3Of(Quad q) {
    return {double(q[0]), double(q[1]), double(q[2])};
}
/// Rounded towards 0, each |lane| < 2³¹.
inline Index3 index3Of(Quad q) {
    return {int(q[0]), int(q[1]), int(q[2])};
}
inline Quad lower(Quad a, Quad b) {
    return a < b ? a : b;
}
inline Quad higher(Quad a, Quad b) {
    return a > b ? a : b;
}

}  // namespace voledit
