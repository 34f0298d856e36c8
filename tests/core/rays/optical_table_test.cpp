#include "core/rays/optical_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voledit {
namespace {

TransferFunction bands() {
    TransferFunction look;
    look.opacity.points = {{20, 0}, {30, 0.4}, {50, 0.4}, {50, 0}, {80, 0}, {80, 1}, {90, 0.1}};
    look.color.points = {{0, Vec3(1, 0, 0)}, {45, Vec3(0, 1, 0)}, {100, Vec3(0.2, 0.3, 1)}};
    return look;
}

struct Mean {
    double depth = 0;
    Vec3 color{0};
};

/// Mean extinction and colour of a value that runs from a to b, by many points.
Mean byPoints(const TransferFunction& look, double a, double b, double unit) {
    constexpr int kPoints = 20000;
    Mean mean;
    for (int n = 0; n < kPoints; ++n) {
        const double value = a + (b - a) * (n + 0.5) / kPoints;
        const double extinction = -std::log(1 - std::min(look.opacity(value), 0.9999)) * unit;
        mean.depth += extinction / kPoints;
        mean.color += extinction * look.color(value) / double(kPoints);
    }
    if (mean.depth > 0) mean.color /= mean.depth;
    return mean;
}

int binOf(const OpticalTable& table, double value) {
    return std::clamp(int(std::lround((value - double(table.low)) * double(table.scale))), 0, table.last);
}

TEST(OpticalTable, AStretchHasTheMeanExtinctionAndColorOfItsValues) {
    const TransferFunction look = bands();
    const OpticalTable table = makeOpticalTable(look, {0, 100}, false, 0.7);
    for (const auto& [a, b] :
         {std::pair{10.0, 95.0}, {95.0, 10.0}, {22.0, 27.0}, {31.0, 49.0}, {40.0, 40.1}, {76.0, 86.0}}) {
        const int from = binOf(table, a), to = binOf(table, b);
        ASSERT_NE(from, to);
        const Mean expected = byPoints(look, a, b, 0.7);
        const double absorbed = double(table.depth[std::size_t(to)]) - double(table.depth[std::size_t(from)]);
        EXPECT_NEAR(absorbed / (to - from), expected.depth, 0.002 * expected.depth + 1e-3) << a << " to " << b;
        for (std::size_t c = 0; c < 3; ++c) {
            const double glow =
                double(table.color[4 * std::size_t(to) + c]) - double(table.color[4 * std::size_t(from) + c]);
            EXPECT_NEAR(glow / absorbed, expected.color[int(c)], 5e-3) << a << " to " << b;
        }
    }
}

TEST(OpticalTable, WholeValuesLieOnBins) {
    const OpticalTable table = makeOpticalTable(bands(), {0, 255}, true, 1);
    EXPECT_EQ(table.scale, std::floor(table.scale));
    EXPECT_EQ(table.low, 0);
}

TEST(OpticalTable, FarOutliersDoNotCoarsenIt) {
    const OpticalTable table = makeOpticalTable(bands(), {-1e30, 1e30}, false, 1);
    EXPECT_GT(table.scale, 10);
}

TEST(OpticalTable, KnowsWhichRangesAbsorbNothing) {
    const OpticalTable table = makeOpticalTable(bands(), {0, 100}, false, 1);
    EXPECT_FALSE(table.mayAbsorb(0, 19.9F));
    EXPECT_FALSE(table.mayAbsorb(51, 79));
    EXPECT_TRUE(table.mayAbsorb(0, 20.5F));
    EXPECT_TRUE(table.mayAbsorb(0, 100));
    EXPECT_TRUE(table.mayAbsorb(40, 40));
    EXPECT_FALSE(table.mayAbsorb(1, 0));
}

TEST(OpticalTable, OfOneValue) {
    TransferFunction look;
    look.opacity.points = {{0, 0.3}};
    look.color.points = {{0, Vec3(0.5)}};
    const OpticalTable table = makeOpticalTable(look, {7, 7}, true, 1);
    EXPECT_NEAR(table.depth[1] - table.depth[0], -std::log(0.7), 1e-6);
}

}  // namespace
}  // namespace voledit
