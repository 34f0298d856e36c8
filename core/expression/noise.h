#pragma once
// The noise of formulas: gradient noise on the integer lattice, the same on CPU and GPU (README.md). Internal to
// core/expression.

#include <array>
#include <cstdint>

namespace voledit {

/// Noise at (x, y, z), differentiated order[0] times by x, order[1] times by y, order[2] times by z.
double noise(double x, double y, double z, const std::array<int, 3>& order);

/// A bound of the absolute value of `noise` of that order, everywhere.
double noiseBound(const std::array<int, 3>& order);

/// Orders packed into a node's payload and back.
inline std::array<int, 3> noiseOrder(std::uint64_t payload) {
    return {int(payload & 255), int(payload >> 8 & 255), int(payload >> 16 & 255)};
}
inline std::uint64_t noisePayload(const std::array<int, 3>& order) {
    return std::uint64_t(order[0]) | std::uint64_t(order[1]) << 8 | std::uint64_t(order[2]) << 16;
}

}  // namespace voledit
