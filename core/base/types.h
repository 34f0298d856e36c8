#pragma once
// Numbers, vectors and boxes that every layer shares. Core computes in double precision: it is the oracle that the
// GPU's single precision is held against (the reasons stand in core/README.md).

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace voledit {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;
using Quat = glm::dquat;  // made as Quat(w, x, y, z)
using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
using Vec4f = glm::vec4;
using Mat3f = glm::mat3;
using Mat4f = glm::mat4;
using Index2 = glm::ivec2;
using Index3 = glm::ivec3;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 3.14159265358979323846;

/// The point that stands for "undefined": a backward map gives it where nothing is shown.
inline constexpr Vec3 kUndefined{kNaN, kNaN, kNaN};

/// False where a map was undefined (any component NaN).
inline bool isDefined(const Vec3& q) {
    return q.x == q.x && q.y == q.y && q.z == q.z;
}

}  // namespace voledit
