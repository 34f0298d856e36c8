#include "core/expression/noise.h"

#include <algorithm>
#include <cmath>

#include "core/base/types.h"

namespace voledit {

namespace {

// Rounds of xor-shift and multiply spread the bits of the three lattice coordinates over the whole word.
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ z * 0xcb1ab31fu;
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ h >> 16;
}

/// By a hash's lowest four bits: the twelve vectors to the middles of a cube's edges, four of them twice.
constexpr std::array<std::array<double, 3>, 16> kGradients{{{1, 1, 0},
                                                            {-1, 1, 0},
                                                            {1, -1, 0},
                                                            {-1, -1, 0},
                                                            {1, 0, 1},
                                                            {-1, 0, 1},
                                                            {1, 0, -1},
                                                            {-1, 0, -1},
                                                            {0, 1, 1},
                                                            {0, -1, 1},
                                                            {0, 1, -1},
                                                            {0, -1, -1},
                                                            {1, 1, 0},
                                                            {-1, 1, 0},
                                                            {0, -1, 1},
                                                            {0, -1, -1}}};

/// The weight 6t⁵ − 15t⁴ + 10t³ of a cell's upper end, differentiated `order` times; written with u = 1 − t, so that
/// single precision loses nothing near 1.
double fade(double t, int order) {
    const double u = 1.0 - t;
    switch (order) {
        case 0:
            return t * t * t * (1.0 + u * (3.0 + u * 6.0));
        case 1:
            return 30.0 * t * t * u * u;
        case 2:
            return 60.0 * t * u * (u - t);
        case 3:
            return 60.0 - 360.0 * t * u;
        case 4:
            return t * 720.0 - 360.0;
        case 5:
            return 720.0;
        default:
            return 0.0;
    }
}

/// Weights of a cell's lower and upper end along one axis, differentiated `order` times; zeros for order −1.
std::array<double, 2> weights(double t, int order) {
    if (order < 0) return {0, 0};
    const double upper = fade(t, order);
    return {order == 0 ? 1.0 - upper : -upper, upper};
}

std::uint32_t latticeIndex(double x) {
    return std::abs(x) < 2147483648.0 ? static_cast<std::uint32_t>(static_cast<std::int32_t>(x)) : 0u;
}

/// Largest |fade| of an order on [0, 1].
double fadeBound(int order) {
    constexpr std::array<double, 6> kBounds{1.0, 1.875, 5.7736, 60.0, 360.0, 720.0};
    return order < 6 ? kBounds[static_cast<std::size_t>(order)] : 0.0;
}

/// Bound of the sum of the absolute weights of a cell's two ends.
double weightBound(int order) {
    if (order < 0) return 0;
    return order == 0 ? 1.0 : 2.0 * fadeBound(order);
}

}  // namespace

double noise(double x, double y, double z, const std::array<int, 3>& order) {
    const std::array<double, 3> point{x, y, z};
    const bool plain = order[0] + order[1] + order[2] == 0;
    std::array<std::array<double, 2>, 3> offset{}, weight{}, lowered{};  // of a cell's two ends along each axis
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
        const double base = std::floor(point[a]);
        offset[a] = {point[a] - base, point[a] - base - 1.0};
        cell[a] = latticeIndex(base);
        weight[a] = weights(offset[a][0], order[a]);
        if (!plain) lowered[a] = weights(offset[a][0], order[a] - 1);
    }
    // Each corner adds weight · (gradient · distance). The second factor is linear, so by Leibniz the nth derivative by
    // one axis is (nth of the weight) · factor + n · (n−1th of the weight) · (gradient's component).
    double sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::size_t i = corner & 1u, j = corner >> 1 & 1u, k = corner >> 2;
        const auto& g =
            kGradients[hash(cell[0] + (corner & 1u), cell[1] + (corner >> 1 & 1u), cell[2] + (corner >> 2)) & 15u];
        const double wx = weight[0][i], wy = weight[1][j], wz = weight[2][k];
        sum += wx * wy * wz * (g[0] * offset[0][i] + g[1] * offset[1][j] + g[2] * offset[2][k]);
        if (plain) continue;
        sum += order[0] * lowered[0][i] * wy * wz * g[0] + order[1] * lowered[1][j] * wx * wz * g[1] +
               order[2] * lowered[2][k] * wx * wy * g[2];
    }
    return sum;
}

double noiseBound(const std::array<int, 3>& order) {
    // The largest sum of corners' weights times the largest |gradient · distance|, 1.0364 near (½, 0.48, 0.36).
    if (order == std::array<int, 3>{}) return 1.05;
    std::array<double, 3> own{}, lowered{};
    for (std::size_t a = 0; a < 3; ++a) {
        own[a] = weightBound(order[a]);
        lowered[a] = order[a] * weightBound(order[a] - 1);
    }
    // |gradient · distance| ≤ 2 and |gradient's component| ≤ 1.
    const double bound = 2.0 * own[0] * own[1] * own[2] + lowered[0] * own[1] * own[2] + own[0] * lowered[1] * own[2] +
                         own[0] * own[1] * lowered[2];
    return bound * (1 + 1e-12);
}

}  // namespace voledit
