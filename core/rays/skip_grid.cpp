#include "core/rays/skip_grid.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kMostBricks = 400'000;
constexpr double kRounding = 2e-3;  // voxels: how far samples may come to lie from where they should

std::size_t volumeOf(Index3 size) {
    return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
}

/// Sets distance 0 where a brick may be visible, kFarthest elsewhere.
void markVisible(const ValueBricks& bricks, const OpticalTable& table, SkipGrid& grid) {
    const int merged = grid.shift - 2;  // ValueBricks have sides of 4
    parallelFor(std::size_t(grid.count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (int k = int(begin) << merged; k < std::min(int(end) << merged, bricks.count.z); ++k)
            for (int j = 0; j < bricks.count.y; ++j) {
                const std::size_t from = bricks.indexOf({0, j, k});
                std::uint8_t* row = grid.distance.data() +
                                    std::size_t(grid.count.x) * (std::size_t(j >> merged) +
                                                                 std::size_t(grid.count.y) * std::size_t(k >> merged));
                for (int i = 0; i < bricks.count.x; ++i) {
                    if (row[i >> merged] == 0) continue;
                    const std::size_t n = from + std::size_t(i);
                    if (table.mayAbsorb(bricks.low[n], bricks.high[n])) row[i >> merged] = 0;
                }
            }
    });
}

void spreadAlongRow(std::uint8_t* row, int count) {
    for (int i = 1; i < count; ++i) row[i] = std::min(row[i], std::uint8_t(row[i - 1] + 1));
    for (int i = count - 2; i >= 0; --i) row[i] = std::min(row[i], std::uint8_t(row[i + 1] + 1));
}

/// distance(at) = min over r of max(r, before(at ± r)) along an axis of `count` lines that lie `stride` apart, each
/// `width` long.
void spreadAcross(std::uint8_t* lines, std::size_t stride, int count, int width, std::vector<std::uint8_t>& before) {
    before.resize(std::size_t(count) * std::size_t(width));
    for (int n = 0; n < count; ++n)
        std::copy_n(lines + std::size_t(n) * stride, width, before.begin() + std::ptrdiff_t(n) * width);
    for (int n = 0; n < count; ++n) {
        std::uint8_t* line = lines + std::size_t(n) * stride;
        for (int r = 1; r < SkipGrid::kFarthest; ++r)
            for (const int from : {n - r, n + r}) {
                if (from < 0 || from >= count) continue;
                const std::uint8_t* other = before.data() + std::ptrdiff_t(from) * width;
                const auto least = std::uint8_t(r);
                for (int i = 0; i < width; ++i) line[i] = std::min(line[i], std::max(other[i], least));
            }
    }
}

void spread(SkipGrid& grid) {
    const std::size_t row = std::size_t(grid.count.x), slice = row * std::size_t(grid.count.y);
    parallelFor(std::size_t(grid.count.z), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> before;
        for (std::size_t k = begin; k < end; ++k) {
            std::uint8_t* lines = grid.distance.data() + k * slice;
            for (int j = 0; j < grid.count.y; ++j) spreadAlongRow(lines + std::size_t(j) * row, grid.count.x);
            spreadAcross(lines, row, grid.count.y, grid.count.x, before);
        }
    });
    parallelFor(std::size_t(grid.count.y), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> before;
        for (std::size_t j = begin; j < end; ++j)
            spreadAcross(grid.distance.data() + j * row, slice, grid.count.z, grid.count.x, before);
    });
}

std::size_t cornerIndex(const SkipGrid& grid, int i, int j, int k) {
    return std::size_t(i) +
           std::size_t(grid.count.x + 1) * (std::size_t(j) + std::size_t(grid.count.y + 1) * std::size_t(k));
}

/// `first`, `end` and `before`.
void countVisible(SkipGrid& grid) {
    grid.first = grid.count;
    grid.end = Index3(0);
    grid.before.assign(volumeOf(grid.count + 1), 0);
    const auto sum = [&](int i, int j, int k) -> std::uint32_t& { return grid.before[cornerIndex(grid, i, j, k)]; };
    const std::uint8_t* at = grid.distance.data();
    for (int k = 0; k < grid.count.z; ++k)
        for (int j = 0; j < grid.count.y; ++j) {
            std::uint32_t row = 0;
            for (int i = 0; i < grid.count.x; ++i, ++at) {
                row += *at == 0;
                sum(i + 1, j + 1, k + 1) = row + sum(i + 1, j, k + 1) + sum(i + 1, j + 1, k) - sum(i + 1, j, k);
                if (*at != 0) continue;
                grid.first = glm::min(grid.first, Index3(i, j, k));
                grid.end = glm::max(grid.end, Index3(i, j, k) + 1);
            }
        }
}

}  // namespace

bool SkipGrid::mayBeVisible(const Box3& box) const {
    if (box.empty()) return false;
    const auto brick = [&](const Vec3& x) {
        return glm::clamp(Index3(glm::floor(x / double(1 << shift))), Index3(0), count - 1);
    };
    const Index3 from = brick(box.min - kRounding), to = brick(box.max + kRounding) + 1;
    const auto layer = [&](int k) {
        const auto sum = [&](int i, int j) { return before[cornerIndex(*this, i, j, k)]; };
        return sum(to.x, to.y) - sum(from.x, to.y) - sum(to.x, from.y) + sum(from.x, from.y);
    };
    return layer(to.z) != layer(from.z);
}

SkipGrid makeSkipGrid(const ValueBricks& bricks, const OpticalTable& table) {
    SkipGrid grid;
    grid.count = bricks.count;
    for (; volumeOf(grid.count) > kMostBricks; ++grid.shift) grid.count = (grid.count + 1) / 2;
    grid.distance.assign(volumeOf(grid.count) + 3, SkipGrid::kFarthest);
    markVisible(bricks, table, grid);
    spread(grid);
    countVisible(grid);
    return grid;
}

}  // namespace voledit
