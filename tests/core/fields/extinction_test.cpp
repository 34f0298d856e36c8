#include "core/fields/extinction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voledit {
namespace {

TransferFunction rampBetween(double first, double last) {
    TransferFunction look;
    look.opacity.points = {{first, 0}, {last, 1}};
    return look;
}

TEST(Extinction, AbsorbsWhatOpacitySays) {
    for (const double opacity : {0.0, 0.01, 0.5, 0.99})
        EXPECT_NEAR(1 - std::exp(-extinctionOf(opacity)), opacity, 1e-15) << opacity;
    EXPECT_EQ(extinctionOf(-1), 0);
}

TEST(Extinction, IsFiniteWhereNothingComesThrough) {
    EXPECT_NEAR(1 - std::exp(-extinctionOf(1)), kLargestOpacity, 1e-12);
    EXPECT_EQ(extinctionOf(2), extinctionOf(1));
}

TEST(TabulatedRange, CoversTheCornersAndLittleMore) {
    const Interval range = tabulatedRange(rampBetween(100, 200), {-1e6, 1e6}, 0.25, 0);
    EXPECT_DOUBLE_EQ(range.low, 75);
    EXPECT_DOUBLE_EQ(range.high, 225);
}

TEST(TabulatedRange, StaysWithinTheData) {
    const Interval range = tabulatedRange(rampBetween(100, 200), {120, 150}, 1, 0);
    EXPECT_EQ(range.low, 120);
    EXPECT_EQ(range.high, 150);
}

TEST(TabulatedRange, IsWideEnoughForSinglePrecision) {
    const Interval range = tabulatedRange(rampBetween(1e6, 1e6 + 1e-3), {0, 1e9}, 1, 1e-3);
    EXPECT_NEAR(range.high - range.low, 2e3, 1);
}

TEST(TabulatedRange, IsNeverEmptyOrEndless) {
    const double infinity = kInfinity;
    for (const Interval data : {Interval{5, 5}, Interval{infinity, -infinity}, Interval{300, 400}, Interval{-9, -8}}) {
        const Interval range = tabulatedRange(rampBetween(100, 200), data, 0, 0);
        EXPECT_LT(range.low, range.high);
        EXPECT_TRUE(std::isfinite(range.low) && std::isfinite(range.high));
    }
    const Interval bare = tabulatedRange({}, {infinity, -infinity}, 1, 1e-3);
    EXPECT_LT(bare.low, bare.high);
}

}  // namespace
}  // namespace voledit
