#include "render/march_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace voledit {
namespace {

TransferFunction fogAndBone() {
    TransferFunction f;
    f.color.points = {{0, {1, 0, 0}}, {500, {0, 1, 0}}, {1000, {0, 0, 1}}};
    f.opacity.points = {{100, 0}, {101, 0.0005}, {700, 0.0005}, {720, 0.9}, {1000, 0.95}};
    return f;
}

int binOf(const MarchTable& table, double value) {
    return int(
        std::clamp(std::floor((value - double(table.low)) * double(table.scale) + 0.5), 0.0, double(table.bins - 1)));
}

/// As shaders/march/table.glsl has it, in its precision.
float extinctionBetween(const MarchTable& table, int a, int b) {
    if (a == b) return table.depth[std::size_t(a)][2];
    const auto &from = table.depth[std::size_t(a)], &to = table.depth[std::size_t(b)];
    return ((to[0] - from[0]) + (to[1] - from[1])) / float(b - a);
}

double meanExtinction(const TransferFunction& f, double a, double b) {
    constexpr int kPoints = 20000;
    double sum = 0;
    for (int n = 0; n < kPoints; ++n)
        sum += -std::log1p(-std::min(f.opacity(a + (b - a) * (n + 0.5) / kPoints), 0.9999));
    return sum / kPoints;
}

TEST(MarchTable, StretchesHaveTheMeanExtinctionBetweenTheirEnds) {
    const TransferFunction f = fogAndBone();
    const MarchTable table = makeMarchTable(f, {0, 1000}, true);
    std::mt19937 random(1);
    std::uniform_int_distribution<int> value(0, 1000);
    for (int n = 0; n < 100; ++n) {
        const double a = value(random), b = value(random);
        const double expected = meanExtinction(f, a, b);
        EXPECT_NEAR(extinctionBetween(table, binOf(table, a), binOf(table, b)), expected, 0.01 * expected + 1e-6)
            << a << " to " << b;
    }
}

TEST(MarchTable, NeighbouringBinsOfThinFogBehindBoneAreStillTold) {
    // Single precision of the sum alone would be wrong by a tenth here.
    TransferFunction f = fogAndBone();
    f.opacity.points = {{0, 0.9}, {500, 0.9}, {501, 0.0005}, {1000, 0.0005}};
    const MarchTable table = makeMarchTable(f, {0, 1000}, false);
    const double expected = -std::log1p(-0.0005);
    for (int b = binOf(table, 600); b < binOf(table, 990); ++b)
        ASSERT_NEAR(extinctionBetween(table, b, b + 1), expected, 1e-4 * expected);
}

TEST(MarchTable, WhatMayAbsorbHoldsAllThatDoes) {
    const MarchTable table = makeMarchTable(fogAndBone(), {-200, 1000}, true);
    EXPECT_FALSE(table.mayAbsorb({-200, 99}));
    EXPECT_TRUE(table.mayAbsorb({-200, 102}));
    EXPECT_TRUE(table.mayAbsorb({800, 800}));
    EXPECT_FALSE(table.mayAbsorb({kInfinity, -kInfinity}));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-200, 300);
    for (int n = 0; n < 2000; ++n) {
        double a = value(random), b = value(random);
        if (a > b) std::swap(a, b);
        if (!table.mayAbsorb({a, b})) {
            ASSERT_EQ(extinctionBetween(table, binOf(table, a), binOf(table, b)), 0);
        }
    }
}

TEST(MarchTable, NothingAndOneValueAreTablesToo) {
    const MarchTable none = makeMarchTable({}, {0, 0}, true);
    EXPECT_FALSE(none.mayAbsorb({0, 0}));
    TransferFunction constant;
    constant.opacity.points = {{0, 0.5}};
    const MarchTable one = makeMarchTable(constant, {3, 3}, true);
    EXPECT_TRUE(one.mayAbsorb({3, 3}));
    EXPECT_NEAR(extinctionBetween(one, binOf(one, 3), binOf(one, 3)), std::log(2.0), 1e-6);
}

}  // namespace
}  // namespace voledit
