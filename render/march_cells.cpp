#include "render/march_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

/// Voxels that a ray, straight within a block, may lie beside the map's own cells.
constexpr double kBeside = 0.5;

std::size_t volumeOf(Index3 n) {
    return std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z);
}

/// Eight nodes about a cell.
struct CellCorners {
    Box3 box;
    int known = 0;
};
CellCorners cornersOf(const BakedMap& map, Index3 cell) {
    CellCorners corners;
    const Vec4f* first = map.node.data() + map.grid.indexOf(cell);
    const std::size_t row = std::size_t(map.grid.nodes.x), layer = row * std::size_t(map.grid.nodes.y);
    Vec4f low(HUGE_VALF), high(-HUGE_VALF);
    for (const std::size_t at : {std::size_t(0), row, layer, layer + row})
        for (const std::size_t n : {at, at + 1}) {
            if (!(first[n].w > 0)) continue;
            ++corners.known;
            low = glm::min(low, first[n]);
            high = glm::max(high, first[n]);
        }
    corners.box = {Vec3(Vec3f(low)) - kBeside, Vec3(Vec3f(high)) + kBeside};
    return corners;
}

}  // namespace

Interval finiteRangeOf(const ValueBricks& bricks) {
    Interval range{kInfinity, -kInfinity};
    for (std::size_t n = 0; n < bricks.low.size(); ++n) {
        if (std::isfinite(bricks.low[n])) range.low = std::min(range.low, double(bricks.low[n]));
        if (std::isfinite(bricks.high[n])) range.high = std::max(range.high, double(bricks.high[n]));
    }
    return range.low <= range.high ? range : Interval{0, 0};
}

bool VisibleBricks::any(const Box3& box) const {
    // Beyond what an int holds it is outside, too.
    const auto brick = [&](const Vec3& p) { return Index3(glm::floor(glm::clamp(p / side(), Vec3(-9), Vec3(1e6)))); };
    return set.any(brick(box.min), brick(box.max) + 1);
}

VisibleBricks visibleBricks(const ValueBricks& values, const MarchTable& table) {
    int shift = 0;
    while (volumeOf(values.count >> shift) > kMostCells) ++shift;
    const Index3 count = (values.count + ((1 << shift) - 1)) >> shift;
    std::vector<std::uint8_t> visible(volumeOf(count), 0);
    parallelFor(std::size_t(count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (int k = int(begin) << shift; k < std::min(int(end) << shift, values.count.z); ++k)
            for (int j = 0; j < values.count.y; ++j) {
                const std::size_t from = values.indexOf({0, j, k});
                std::uint8_t* row =
                    visible.data() +
                    std::size_t(count.x) * (std::size_t(j >> shift) + std::size_t(count.y) * std::size_t(k >> shift));
                for (int i = 0; i < values.count.x; ++i) {
                    const std::size_t n = from + std::size_t(i);
                    if (!row[i >> shift] && table.mayAbsorb({double(values.low[n]), double(values.high[n])}))
                        row[i >> shift] = 1;
                }
            }
    });
    return {BrickSet(count, std::move(visible)), shift};
}

SeenCells seenCells(const BakedMap& map, const VisibleBricks& bricks, const Box3& clip) {
    const Index3 count = map.grid.nodes - 1;
    SeenCells result{std::vector<std::uint8_t>(volumeOf(count), 0), true};
    std::vector<char> unknown(std::size_t(count.z), 0);
    parallelFor(std::size_t(count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (int k = int(begin); k < int(end); ++k)
            for (int j = 0; j < count.y; ++j) {
                std::uint8_t* row = result.seen.data() +
                                    std::size_t(count.x) * (std::size_t(j) + std::size_t(count.y) * std::size_t(k));
                for (int i = 0; i < count.x; ++i) {
                    const CellCorners corners = cornersOf(map, {i, j, k});
                    if (corners.known == 0) continue;
                    const Box3 box = intersect(corners.box, {clip.min - kBeside, clip.max + kBeside});
                    if (box.empty() || !bricks.any(box)) continue;
                    row[i] = corners.known == 8;
                    if (corners.known < 8 && !intersect(corners.box, clip).empty()) unknown[std::size_t(k)] = 1;
                }
            }
    });
    result.known = std::none_of(unknown.begin(), unknown.end(), [](char u) { return u != 0; });
    return result;
}

BrickSet mergedCells(Index3 count, const std::vector<std::uint8_t>& seen, int shift) {
    if (shift == 0) return {count, seen};
    const Index3 merged = (count + ((1 << shift) - 1)) >> shift;
    std::vector<std::uint8_t> any(volumeOf(merged), 0);
    const std::uint8_t* at = seen.data();
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j) {
            std::uint8_t* row = any.data() + std::size_t(merged.x) * (std::size_t(j >> shift) +
                                                                      std::size_t(merged.y) * std::size_t(k >> shift));
            for (int i = 0; i < count.x; ++i, ++at) row[i >> shift] |= *at;
        }
    return {merged, std::move(any)};
}

}  // namespace voledit
