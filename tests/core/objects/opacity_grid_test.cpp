#include "core/objects/opacity_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

TermPtr ball() {
    return solid(SphereShape{Vec3(0.1, 0, -0.2), 0.6}, Vec3(1), "0.8 - 0.5 * x");
}

TEST(OpacityGrid, HoldsTheAlphaOfOneSpacingAtCellCentres) {
    const TermPtr term = ball();
    const double spacing = 0.07, distance = 0.3;
    const OpacityGrid grid(*term, spacing, distance);
    EXPECT_EQ(grid.spacing(), spacing);
    std::vector<Vec3> p;
    for (int z = 0; z < grid.size().z; ++z)
        for (int y = 0; y < grid.size().y; ++y)
            for (int x = 0; x < grid.size().x; ++x) p.push_back(grid.origin() + spacing * (Vec3(x, y, z) + 0.5));
    const auto expected = sampled(term, p);
    for (std::size_t n = 0; n < p.size(); ++n) {
        const double alpha = 1 - std::pow(1 - std::min(expected[n].opacity, 0.9999), spacing / distance);
        EXPECT_NEAR(grid.alpha(grid.gridFromWorld(p[n])), alpha, 1e-5);
    }
}

TEST(OpacityGrid, IsLinearBetweenCentresAndEmptyAround) {
    const OpacityGrid grid(*ball(), 0.1, 1);
    const Vec3f at(5.5F, 6.5F, 4.5F);
    EXPECT_NEAR(grid.alpha(at + Vec3f(0.25F, 0, 0)), 0.75F * grid.alpha(at) + 0.25F * grid.alpha(at + Vec3f(1, 0, 0)),
                1e-6);
    const Vec3f size(grid.size());
    for (int a = 0; a < 3; ++a) {
        Vec3f low = size / 2.0F, high = low;
        low[a] = 0;
        high[a] = size[a];
        EXPECT_EQ(grid.alpha(low), 0);
        EXPECT_EQ(grid.alpha(high), 0);
    }
}

TEST(OpacityGrid, LevelsAreMeans) {
    const OpacityGrid grid(*ball(), 0.05, 1);
    for (int l = 0; l < OpacityGrid::kLevels; ++l) {
        const OpacityGrid::Level& level = grid.level(l);
        EXPECT_EQ(level.size * (1 << l), grid.size());
        double sum = 0, first = 0;
        for (const auto a : level.alpha) sum += a;
        for (const auto a : grid.level(0).alpha) first += a;
        EXPECT_NEAR(sum / double(level.alpha.size()), first / double(grid.level(0).alpha.size()), 1);
    }
}

TEST(OpacityGrid, ClearancesAreTrueAndAsLargeAsCanBe) {
    const OpacityGrid grid(*solid(SphereShape{Vec3(0), 1}, Vec3(1), "select(x < -0.9 || (x > 0.7 && y > 0.3), 1, 0)"),
                           0.04, 1);
    const Index3 bricks = grid.brickCount(), size = grid.size();
    const auto seen = [&](Index3 brick) {
        for (int n = 0; n < 216; ++n) {
            const Index3 cell = brick * 4 - 1 + Index3(n % 6, n / 6 % 6, n / 36);
            if (glm::any(glm::lessThan(cell, Index3(0))) || glm::any(glm::greaterThanEqual(cell, size))) continue;
            if (grid.alpha(Vec3f(cell) + 0.5F) > 0) return true;
        }
        return false;
    };
    std::vector<Index3> visible;
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x)
                if (seen({x, y, z})) visible.push_back({x, y, z});
    ASSERT_FALSE(visible.empty());
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                int nearest = OpacityGrid::kFarthest;
                for (const Index3& v : visible) {
                    const Index3 d = glm::abs(v - Index3(x, y, z));
                    nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
                }
                EXPECT_EQ(int(grid.clearanceOf({x, y, z})), nearest);
            }
}

TEST(OpacityGrid, IsKeptWithItsTermAndNeverTooLarge) {
    const TermPtr term = ball();
    const auto grid = opacityGridOf(*term, 0.1, 1);
    EXPECT_EQ(opacityGridOf(*term, 0.1, 1), grid);
    EXPECT_EQ(opacityGridOf(*term, 0.2, 1), grid);  // a finer one will do
    EXPECT_NE(opacityGridOf(*term, 0.1, 2), grid);
    EXPECT_EQ(opacityGridOf(*term, 0.05, 1)->spacing(), 0.05);
    const auto fine = opacityGridOf(*solid(BoxShape{}, Vec3(1), "0"), 1e-4, 1);
    EXPECT_LE(fine->level(0).alpha.size(), OpacityGrid::kMostCells);
    EXPECT_GT(fine->level(0).alpha.size(), OpacityGrid::kMostCells / 2);
}

}  // namespace
}  // namespace voledit
