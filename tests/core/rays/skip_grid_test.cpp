#include "core/rays/skip_grid.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <random>

namespace voledit {
namespace {

TransferFunction aboveHalf() {
    TransferFunction look;
    look.opacity.points = {{0.5, 0}, {1, 1}};
    look.color.points = {{0, Vec3(1)}};
    return look;
}

ValueBricks randomBricks(Index3 count, double share, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    ValueBricks bricks;
    bricks.count = count;
    for (std::size_t n = 0; n < bricks.indexOf({0, 0, count.z}); ++n) {
        bricks.low.push_back(0.F);
        bricks.high.push_back(unit(random) < share ? 0.9F : 0.1F);
    }
    return bricks;
}

int byAllPairs(const ValueBricks& bricks, Index3 at) {
    int least = SkipGrid::kFarthest;
    for (int k = 0; k < bricks.count.z; ++k)
        for (int j = 0; j < bricks.count.y; ++j)
            for (int i = 0; i < bricks.count.x; ++i)
                if (bricks.high[bricks.indexOf({i, j, k})] > 0.5F)
                    least = std::min(least, std::max({std::abs(i - at.x), std::abs(j - at.y), std::abs(k - at.z)}));
    return least;
}

TEST(SkipGrid, HoldsTheDistanceToTheNearestVisibleBrick) {
    const OpticalTable table = makeOpticalTable(aboveHalf(), {0, 1}, false, 1);
    for (const double share : {0.0, 0.0005, 0.02, 0.5}) {
        const ValueBricks bricks = randomBricks({31, 17, 40}, share, 3);
        const SkipGrid grid = makeSkipGrid(bricks, table);
        ASSERT_EQ(grid.shift, 2);
        std::mt19937 random(5);
        for (int n = 0; n < 300; ++n) {
            const Index3 at(random() % 31, random() % 17, random() % 40);
            ASSERT_EQ(int(grid.distance[bricks.indexOf(at)]), byAllPairs(bricks, at));
        }
    }
}

TEST(SkipGrid, MergesBricksOfLargeVolumes) {
    const OpticalTable table = makeOpticalTable(aboveHalf(), {0, 1}, false, 1);
    ValueBricks bricks = randomBricks({97, 90, 83}, 0, 1);
    bricks.high[bricks.indexOf({96, 45, 20})] = 1;
    const SkipGrid grid = makeSkipGrid(bricks, table);
    ASSERT_EQ(grid.shift, 3);
    ASSERT_EQ(grid.count, Index3(49, 45, 42));
    EXPECT_EQ(grid.first, Index3(48, 22, 10));
    EXPECT_EQ(grid.end, Index3(49, 23, 11));
    const auto at = [&](int i, int j, int k) {
        return int(grid.distance[std::size_t(i) + 49 * (std::size_t(j) + 45 * std::size_t(k))]);
    };
    EXPECT_EQ(at(48, 22, 10), 0);
    EXPECT_EQ(at(45, 22, 15), 5);
}

TEST(SkipGrid, TellsOfBoxesWhetherABrickInThemMayBeVisible) {
    const OpticalTable table = makeOpticalTable(aboveHalf(), {0, 1}, false, 1);
    const ValueBricks bricks = randomBricks({31, 17, 40}, 0.002, 3);
    const SkipGrid grid = makeSkipGrid(bricks, table);
    std::mt19937 random(7);
    int seen = 0;
    for (int n = 0; n < 500; ++n) {
        const Index3 from(random() % 31, random() % 17, random() % 40), most(random() % 6, random() % 6, random() % 6);
        const Index3 to = glm::min(from + most, grid.count - 1);
        bool any = false;
        for (int k = from.z; k <= to.z; ++k)
            for (int j = from.y; j <= to.y; ++j)
                for (int i = from.x; i <= to.x; ++i) any |= bricks.high[bricks.indexOf({i, j, k})] > 0.5F;
        ASSERT_EQ(grid.mayBeVisible({4.0 * Vec3(from) + 0.5, 4.0 * Vec3(to) + 3.5}), any);
        seen += any;
    }
    EXPECT_GT(seen, 20);
    EXPECT_LT(seen, 480);
    EXPECT_FALSE(grid.mayBeVisible(Box3()));
}

}  // namespace
}  // namespace voledit
