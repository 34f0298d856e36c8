#pragma once
// What each operation of a formula computes, in one place: constants are folded with these, uniform values and blocks
// of points evaluated; shaders/common/formula.glsl follows them. Internal to core/expression.
//
// NaN in gives NaN out, except where it does not matter (the side that `select` leaves, x^0) and in comparisons, which
// are all false.
//
// `static`: one of the files that include this is compiled for wider vectors, and the linker must not give its copies
// to the others.

#include <cmath>

namespace voledit::scalar {

static inline double sign(double x) {
    return x > 0 ? 1.0 : x < 0 ? -1.0 : x;
}
static inline double fract(double x) {
    return x - std::floor(x);
}
static inline double hermite(double t) {
    return t * t * (3.0 - 2.0 * t);
}
static inline double modulo(double x, double y) {
    return x - y * std::floor(x / y);
}
static inline double minimum(double a, double b) {
    const double least = b < a ? b : a;
    return b == b ? least : b;
}
static inline double maximum(double a, double b) {
    const double most = a < b ? b : a;
    return b == b ? most : b;
}
/// Zeros count as +0, so that the cut below the negative x axis does not depend on their signs.
static inline double arcTangent2(double y, double x) {
    return std::atan2(y + 0.0, x + 0.0);
}
static inline double less(double a, double b) {
    return a < b ? 1.0 : 0.0;
}
static inline double lessEqual(double a, double b) {
    return a <= b ? 1.0 : 0.0;
}
static inline double equal(double a, double b) {
    return a == b ? 1.0 : 0.0;
}
static inline double notEqual(double a, double b) {
    return a < b || a > b ? 1.0 : 0.0;
}
static inline double select(double condition, double a, double b) {
    return condition != 0 ? a : b;
}

/// x multiplied n times by itself in a fixed order, n ≥ 1: squares, the exponent's bits from the highest down.
static inline double integerPower(double x, int n) {
    int bit = 1;
    while (bit <= n / 2) bit *= 2;
    double result = x;
    for (bit /= 2; bit > 0; bit /= 2) {
        result *= result;
        if (n & bit) result *= x;
    }
    return result;
}

inline constexpr int kLargestIntegerPower = 16;

/// True if pow(x, y) is computed by multiplications.
inline bool isIntegerPower(double y) {
    return std::abs(y) <= kLargestIntegerPower && y == std::floor(y);
}

/// pow(x, y) with a y for which isIntegerPower holds.
static inline double powerOfInteger(double x, int y) {
    if (y == 0) return 1.0;
    return y > 0 ? integerPower(x, y) : 1.0 / integerPower(x, -y);
}

static inline double power(double x, double y) {
    return isIntegerPower(y) ? powerOfInteger(x, static_cast<int>(y)) : std::pow(x, y);
}

}  // namespace voledit::scalar
