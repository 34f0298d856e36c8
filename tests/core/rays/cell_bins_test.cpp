#include "core/rays/cell_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/matrix.hpp>
#include <random>

namespace voledit {
namespace {

PacketCells randomCells(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    PacketCells cells;
    for (std::uint32_t n = 0; n < 200; ++n) {
        const Vec3 middle(2 * unit(random), 2 * unit(random), 2 * unit(random));
        for (std::uint32_t v = 0; v < 4; ++v) {
            cells.position.push_back(middle + 0.3 * Vec3(unit(random), unit(random), unit(random)));
            cells.bounds = join(cells.bounds, cells.position.back());
        }
        cells.corners.push_back({4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3});
    }
    cells.cells.resize(cells.corners.size());
    return cells;
}

/// Whether the ray of a pixel's centre passes the cell in front of the eye.
bool passes(const PacketCells& cells, std::size_t n, const CellView& view, Index2 pixel) {
    const Vec3 direction = view.forward + double(pixel.x) * view.right + double(pixel.y) * view.down;
    double near = 0, far = kInfinity;
    const auto& c = cells.corners[n];
    const Vec3 origin = cells.position[c[0]];
    const Mat3 weights =
        glm::inverse(Mat3(cells.position[c[1]] - origin, cells.position[c[2]] - origin, cells.position[c[3]] - origin));
    const Vec3 at = weights * (view.eye - origin), along = weights * direction;
    const auto cut = [&](double value, double slope) {
        if (slope > 0) near = std::max(near, -value / slope);
        if (slope < 0) far = std::min(far, -value / slope);
    };
    for (int a = 0; a < 3; ++a) cut(at[a], along[a]);
    cut(1 - at.x - at.y - at.z, -along.x - along.y - along.z);
    return near < far;
}

TEST(CellBins, HoldEveryCellThatARayPasses) {
    const Index2 size(50, 37);
    // From outside, and from amid the cells.
    for (const Vec3& eye : {Vec3(0, -7, 0), Vec3(0.2, 0.1, -0.3)}) {
        const PacketCells cells = randomCells(5);
        const CellView view{eye, Vec3(-0.5, 1, 0.4), Vec3(0.02, 0, 0), Vec3(0, 0.002, -0.02)};
        const CellBins bins = makeCellBins(cells, view, size);
        ASSERT_EQ(bins.tiles, Index2(4, 3));
        std::size_t passed = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto list = bins.at({x / CellBins::kTile, y / CellBins::kTile});
                for (std::size_t n = 0; n < cells.cells.size(); ++n) {
                    if (!passes(cells, n, view, {x, y})) continue;
                    ++passed;
                    ASSERT_EQ(std::count(list.begin(), list.end(), n), 1);
                    const PixelBox& box = bins.boxes[n];
                    ASSERT_TRUE(x >= box.firstX && x < box.endX && y >= box.firstY && y < box.endY);
                }
            }
        EXPECT_GT(passed, 500U);
    }
}

TEST(CellBins, NothingFillsNoTile) {
    const CellBins bins =
        makeCellBins({}, {Vec3(0, -7, 0), Vec3(-0.5, 1, 0.4), Vec3(0.02, 0, 0), Vec3(0, 0, -0.02)}, {20, 20});
    EXPECT_TRUE(bins.at({1, 1}).empty());
}

}  // namespace
}  // namespace voledit
