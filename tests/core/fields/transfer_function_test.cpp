#include "core/fields/transfer_function.h"

#include <gtest/gtest.h>

#include <random>

namespace voledit {
namespace {

TEST(PiecewiseLinear, IsZeroWithoutPoints) {
    EXPECT_EQ(PiecewiseLinear{}(3.0), 0.0);
}

TEST(PiecewiseLinear, GoesThroughItsPointsAndHoldsBeyond) {
    const PiecewiseLinear f{{{-2, 1}, {0, 5}, {4, 3}}};
    EXPECT_EQ(f(-2), 1);
    EXPECT_EQ(f(0), 5);
    EXPECT_EQ(f(4), 3);
    EXPECT_EQ(f(-1), 3);
    EXPECT_EQ(f(2), 4);
    EXPECT_EQ(f(-1e300), 1);
    EXPECT_EQ(f(1e300), 3);
}

TEST(PiecewiseLinear, TwoPointsOfOnePositionMakeAStep) {
    const PiecewiseLinear f{{{0, 0}, {1, 0.25}, {1, 0.75}, {2, 1}}};
    EXPECT_EQ(f(1), 0.75);
    EXPECT_NEAR(f(1 - 1e-9), 0.25, 1e-8);
    EXPECT_EQ(f(1.5), 0.875);
}

TEST(PiecewiseLinear, StepsAtTheEndsHoldBeyond) {
    const PiecewiseLinear f{{{0, 1}, {0, 2}, {3, 5}, {3, 7}}};
    EXPECT_EQ(f(-1), 1);
    EXPECT_EQ(f(0), 2);
    EXPECT_EQ(f(3), 7);
    EXPECT_EQ(f(4), 7);
}

TEST(ColorTable, InterpolatesEachChannel) {
    const ColorTable table{{{0, {0, 1, 0.5}}, {10, {1, 0, 0.5}}}};
    EXPECT_EQ(table(2.5), Vec3(0.25, 0.75, 0.5));
    EXPECT_EQ(table(-5), Vec3(0, 1, 0.5));
    EXPECT_EQ(ColorTable{}(1), Vec3(0));
}

TEST(GreyRamp, RunsFromTransparentBlackToOpaqueWhite) {
    const TransferFunction ramp = greyRamp(-100, 300);
    EXPECT_EQ(ramp.opacity(-100), 0);
    EXPECT_EQ(ramp.opacity(100), 0.5);
    EXPECT_EQ(ramp.opacity(300), 1);
    EXPECT_EQ(ramp.color(100), Vec3(0.5));
    EXPECT_TRUE(ramp.gradientOpacity.points.empty());
}

TEST(LargestOpacity, SeesCornersWithinTheInterval) {
    const PiecewiseLinear f{{{0, 0}, {1, 0.9}, {2, 0.1}, {3, 0.4}}};
    EXPECT_EQ(largestOpacity(f, 0.5, 1.5), 0.9);
    EXPECT_DOUBLE_EQ(largestOpacity(f, 1.5, 2.5), 0.5);
    EXPECT_EQ(largestOpacity(f, 2, 10), 0.4);
    EXPECT_EQ(largestOpacity(f, -5, 0), 0);
    EXPECT_EQ(largestOpacity(f, 2, 1), 0);
    EXPECT_EQ(largestOpacity({}, 0, 1), 0);
}

TEST(LargestOpacity, LeavesOutWhatAStepsLeftSideOnlyApproachesFromOutside) {
    const PiecewiseLinear f{{{0, 0}, {1, 1}, {1, 0.2}, {2, 0.2}}};
    EXPECT_EQ(largestOpacity(f, 1, 2), 0.2);
    EXPECT_EQ(largestOpacity(f, 0.5, 1), 1);
}

TEST(LargestOpacity, BoundsEverySampleAndIsReached) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        PiecewiseLinear f;
        double x = 0;
        for (int i = 0; i < 8; ++i) f.points.emplace_back(x += unit(random), unit(random));
        const double a = unit(random) * 8, b = a + unit(random) * 3;
        const double bound = largestOpacity(f, a, b);
        double sampled = 0;
        for (int i = 0; i <= 3000; ++i) sampled = std::max(sampled, f(a + (b - a) * i / 3000));
        EXPECT_LE(sampled, bound + 1e-12);
        EXPECT_GE(sampled, bound - 0.1);
    }
}

TEST(PiecewiseLinear, SlopeIsThatOfThePieceAndZeroBeyond) {
    const PiecewiseLinear table{{{0, 1}, {2, 5}, {2, 0}, {3, -1}}};
    EXPECT_EQ(table.slope(-1), 0);
    EXPECT_EQ(table.slope(0), 2) << "at a corner, the piece after it";
    EXPECT_EQ(table.slope(1.5), 2);
    EXPECT_EQ(table.slope(2), -1) << "a step has none of its own";
    EXPECT_EQ(table.slope(3), 0);
    EXPECT_EQ(table.slope(9), 0);
    EXPECT_EQ(PiecewiseLinear{}.slope(1), 0);
}

TEST(PiecewiseLinear, RangeIsExact) {
    const PiecewiseLinear table{{{0, 1}, {1, 3}, {2, -2}, {2, 7}, {4, 0}}};
    EXPECT_EQ(rangeOf(table, {0.5, 0.75}), (Interval{2, 2.5}));
    EXPECT_EQ(rangeOf(table, {0.5, 1.5}), (Interval{0.5, 3}));
    EXPECT_EQ(rangeOf(table, {1.5, 2}), (Interval{-2, 7})) << "both sides of the step";
    EXPECT_EQ(rangeOf(table, {2, 3}), (Interval{3.5, 7})) << "what holds below is not reached";
    EXPECT_EQ(rangeOf(table, {-kInfinity, kInfinity}), (Interval{-2, 7}));
    EXPECT_EQ(rangeOf({}, {0, 1}), (Interval{0, 0}));
}

}  // namespace
}  // namespace voledit
