#include "core/fields/value_bricks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace voledit {
namespace {

template <class T>
void expectRangesOfTheSamples(Index3 size, int channels, int m = 0) {
    std::mt19937 random(1);
    VolumeGrid grid{size, channels, Mat4(1.0)};
    std::vector<T> values(grid.valueCount());
    for (T& v : values) v = T(random());
    const auto volume = Volume::fromValues(grid, values);
    for (int c = 0; c < channels; ++c) {
        const ValueBricks bricks = m == 0 ? volume->bricks(c) : makeValueBricks(*volume, c, m);
        for (int k = 0; k < bricks.count.z; ++k)
            for (int j = 0; j < bricks.count.y; ++j)
                for (int i = 0; i < bricks.count.x; ++i) {
                    double low = kInfinity, high = -kInfinity;
                    for (int z = std::max(4 * k - m, 0); z <= std::min(4 * k + 4 + m, size.z - 1); ++z)
                        for (int y = std::max(4 * j - m, 0); y <= std::min(4 * j + 4 + m, size.y - 1); ++y)
                            for (int x = std::max(4 * i - m, 0); x <= std::min(4 * i + 4 + m, size.x - 1); ++x) {
                                low = std::min(low, volume->at({x, y, z}, c));
                                high = std::max(high, volume->at({x, y, z}, c));
                            }
                    const double l = bricks.low[bricks.indexOf({i, j, k})], h = bricks.high[bricks.indexOf({i, j, k})];
                    EXPECT_LE(l, low);
                    EXPECT_GE(h, high);
                    EXPECT_NEAR(l, low, 1.2e-7 * std::abs(low));
                    EXPECT_NEAR(h, high, 1.2e-7 * std::abs(high));
                }
    }
}

TEST(ValueBricks, AreTheRangesOfTheSamplesOnAndWithinThem) {
    expectRangesOfTheSamples<std::int16_t>({17, 9, 6}, 1);
    expectRangesOfTheSamples<std::uint8_t>({5, 4, 1}, 2);
    expectRangesOfTheSamples<std::int32_t>({8, 9, 10}, 1);
    expectRangesOfTheSamples<double>({3, 13, 5}, 3);
}

TEST(ValueBricks, MayOverlapByAMargin) {
    expectRangesOfTheSamples<std::int16_t>({21, 14, 9}, 1, 1);
    expectRangesOfTheSamples<float>({5, 1, 12}, 2, 3);
}

TEST(ValueBricks, AreTheSameForRowsShorterAndLongerThanVectors) {
    for (const int n : {1, 2, 7, 8, 16, 31, 33, 64, 65, 130}) {
        expectRangesOfTheSamples<std::uint8_t>({n, 6, 5}, 1);
        expectRangesOfTheSamples<std::uint16_t>({n, 5, 6}, 1, 2);
        expectRangesOfTheSamples<float>({n, 9, 2}, 1, 1);
    }
    expectRangesOfTheSamples<std::uint32_t>({40, 3, 9}, 1, 1);
    expectRangesOfTheSamples<std::int8_t>({70, 9, 9}, 3, 2);
}

TEST(ValueBricks, CountIsThatOfTheGapsBetweenSamples) {
    const auto countOf = [](Index3 size) {
        return Volume::fromValues({size, 1, Mat4(1.0)}, std::vector<float>(VolumeGrid{size, 1, Mat4(1.0)}.valueCount()))
            ->bricks(0)
            .count;
    };
    EXPECT_EQ(countOf({1, 2, 5}), Index3(1, 1, 1));
    EXPECT_EQ(countOf({6, 9, 10}), Index3(2, 2, 3));
}

TEST(ValueBricks, LeaveOutWhatIsNotANumber) {
    std::vector<float> values(9 * 2 * 2, NAN);
    values[8] = 3;
    values[17] = INFINITY;
    const auto volume = Volume::fromValues({{9, 2, 2}, 1, Mat4(1.0)}, values);
    EXPECT_GT(volume->bricks(0).low[0], volume->bricks(0).high[0]) << "nothing but NaN";
    EXPECT_EQ(volume->bricks(0).low[1], 3);
    EXPECT_EQ(volume->bricks(0).high[1], INFINITY);
}

}  // namespace
}  // namespace voledit
