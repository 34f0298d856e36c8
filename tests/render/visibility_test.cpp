#include "render/visibility.h"

#include <cmath>
#include <random>

#include "tests/render/render_fixtures.h"

namespace voledit {
namespace {

using namespace test;

std::shared_ptr<const Volume> speckled(Index3 size, unsigned seed, int voxels) {
    VolumeGrid grid;
    grid.size = size;
    std::vector<std::int16_t> values(grid.sampleCount(), -1000);
    std::mt19937 random(seed);
    for (int n = 0; n < voxels; ++n) values[random() % values.size()] = std::int16_t(random() % 3000);
    return Volume::fromValues(grid, std::move(values));
}

ValueBricks bricksOf(const Volume& volume) {
    return makeValueBricks(volume, 0, kVisibilityMargin);
}

TEST(Visibility, FiniteRangeIsThatOfAllFiniteValues) {
    const auto volume = speckled({21, 14, 9}, 3, 60);
    const auto [min, max] = finiteRange(bricksOf(*volume));
    EXPECT_EQ(min, volume->statistics().min);
    EXPECT_EQ(max, volume->statistics().max);
    const auto none = sampled(Index3(5), [](const Vec3&) { return kNaN; });
    EXPECT_EQ(finiteRange(bricksOf(*none)), std::pair(0.0, 0.0));
}

TEST(Visibility, NeverMissesAndFindsMostEmptyBoxes) {
    const auto volume = speckled({40, 30, 20}, 5, 12);
    TransferFunction f;
    f.opacity.points = {{0, 0}, {100, 1}};
    const ValueBricks bricks = bricksOf(*volume);
    const auto [min, max] = finiteRange(bricks);
    const Visibility visibility(bricks, makeTransferTable(f, min, max));
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    int empty = 0, toldEmpty = 0;
    for (int n = 0; n < 2000; ++n) {
        const Vec3 corner = Vec3(unit(random), unit(random), unit(random)) * Vec3(38, 28, 18);
        const Box3 box{corner, glm::min(corner + 4.0 * unit(random), Vec3(39, 29, 19))};
        bool seen = false;
        for (int z = int(box.min.z); z <= int(std::ceil(box.max.z)); ++z)
            for (int y = int(box.min.y); y <= int(std::ceil(box.max.y)); ++y)
                for (int x = int(box.min.x); x <= int(std::ceil(box.max.x)); ++x) seen |= volume->at({x, y, z}) > 0;
        if (seen) {
            EXPECT_TRUE(visibility.visible(box));
        } else {
            ++empty;
            toldEmpty += !visibility.visible(box);
        }
    }
    EXPECT_GT(toldEmpty, empty / 2);
    EXPECT_TRUE(Visibility().visible({Vec3(0), Vec3(1)}));
}

TEST(Visibility, BricksWithoutNumbersAreNotVisible) {
    const auto volume = sampled(Index3(9), [](const Vec3& p) { return p.x < 0.3 ? kNaN : 500; });
    const ValueBricks bricks = bricksOf(*volume);
    EXPECT_EQ(finiteRange(bricks).first, 500);
    const Visibility visibility(bricks, makeTransferTable(constantAppearance(0.5, {1, 1, 1}), 500, 500));
    EXPECT_FALSE(visibility.visible({{0, 0, 0}, {2, 2, 2}}));
    EXPECT_TRUE(visibility.visible({{6, 0, 0}, {7, 2, 2}}));
}

}  // namespace
}  // namespace voledit
