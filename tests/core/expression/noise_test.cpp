#include "core/expression/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/types.h"

namespace voledit {
namespace {

double at(double x, double y, double z) {
    return noise(x, y, z, {0, 0, 0});
}

TEST(Noise, IsZeroAtWholeNumbersWithUnitGradients) {
    for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0}, {5.0, -3.0, 2.0}, {-100.0, 7.0, 12345.0}}) {
        EXPECT_EQ(at(x, y, z), 0);
        const double dx = noise(x, y, z, {1, 0, 0}), dy = noise(x, y, z, {0, 1, 0}), dz = noise(x, y, z, {0, 0, 1});
        // The middle of a cube's edge.
        EXPECT_EQ(dx * dx + dy * dy + dz * dz, 2);
        EXPECT_EQ(std::abs(dx) + std::abs(dy) + std::abs(dz), 2);
    }
}

TEST(Noise, IsWhatItWasWhenItWasDefined) {
    // Scenes are to look the same for good: these values never change.
    EXPECT_NEAR(at(0.5, 0.5, 0.5), 0.25, 1e-15);
    EXPECT_NEAR(at(1.25, -3.75, 7.5), 0.33655786514282227, 1e-15);
    EXPECT_NEAR(at(-1000.3, 2000.6, 0.1), -0.10111194497375722, 1e-12);
}

TEST(Noise, IsSmoothAcrossCells) {
    for (const std::array<int, 3> order : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 1}})
        for (int n = -3; n < 3; ++n) {
            const double before = noise(n - 1e-9, 0.3, 0.8, order), after = noise(n + 1e-9, 0.3, 0.8, order);
            EXPECT_NEAR(before, after, 1e-6) << n;
        }
}

TEST(Noise, IsBalancedAndWithinItsBound) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-300, 300);
    double sum = 0, squares = 0, most = 0;
    constexpr int kSamples = 200'000;
    for (int i = 0; i < kSamples; ++i) {
        const double value = at(place(random), place(random), place(random));
        sum += value;
        squares += value * value;
        most = std::max(most, std::abs(value));
    }
    EXPECT_LT(std::abs(sum / kSamples), 0.005);
    EXPECT_GT(squares / kSamples, 0.05);
    EXPECT_GT(most, 0.7);
    EXPECT_LE(most, noiseBound({0, 0, 0}));
}

TEST(Noise, NeverRunsOutOfCells) {
    for (const double far : {1e9, 1e10, 1e18, -1e300}) EXPECT_EQ(std::isfinite(at(far, 0.5, 0.5)), true) << far;
    EXPECT_TRUE(std::isnan(at(kInfinity, 0, 0)));
    EXPECT_TRUE(std::isnan(at(0, kNaN, 0)));
}

}  // namespace
}  // namespace voledit
