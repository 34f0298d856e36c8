#include "render/march_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/base/quad.h"

namespace voledit {

namespace {

/// Voxels that a ray, straight within a block, may lie beside the map's own cells.
constexpr float kBeside = 0.5F;

std::size_t volumeOf(Index3 n) {
    return std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z);
}

/// Some nodes of a map: how many are known, and the box of these.
struct Nodes {
    Quad low = quadOf(HUGE_VALF), high = quadOf(-HUGE_VALF);
    int known = 0;

    void add(const Vec4f& node) {
        if (!(node.w > 0)) return;
        ++known;
        low = lower(low, quadOf(node));
        high = higher(high, quadOf(node));
    }
    void add(const Nodes& other) {
        known += other.known;
        low = lower(low, other.low);
        high = higher(high, other.high);
    }
    /// Whether they and what lies beside them meets a box.
    bool meet(Quad min, Quad max) const {
        const auto apart = (low - kBeside > max) | (high + kBeside < min);
        return !(apart[0] | apart[1] | apart[2]);
    }
};

/// The four nodes of a row of cells at one place along it.
Nodes nodesAcross(const Vec4f* first, std::size_t row, std::size_t layer) {
    Nodes nodes;
    for (const std::size_t at : {std::size_t(0), row, layer, layer + row}) nodes.add(first[at]);
    return nodes;
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

bool VisibleBricks::any(Quad min, Quad max) const {
    const auto perVoxel = float(1 / side());
    // Beyond what an int holds it is outside, too; above 0 conversion rounds down.
    const auto brick = [&](Quad p) {
        return index3Of(lower(higher(p * perVoxel, quadOf(-9)), quadOf(1e6F)) + 16.0F) - 16;
    };
    return set.any(brick(min), brick(max) + 1);
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
    const std::size_t nodesOfRow = std::size_t(map.grid.nodes.x);
    const std::size_t nodesOfLayer = nodesOfRow * std::size_t(map.grid.nodes.y);
    const Quad clipMin = quadOf(clip.min), clipMax = quadOf(clip.max);
    SeenCells result{std::vector<std::uint8_t>(volumeOf(count), 0), true};
    std::vector<char> unknown(std::size_t(count.z), 0);
    parallelFor(std::size_t(count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (int k = int(begin); k < int(end); ++k)
            for (int j = 0; j < count.y; ++j) {
                std::uint8_t* row = result.seen.data() +
                                    std::size_t(count.x) * (std::size_t(j) + std::size_t(count.y) * std::size_t(k));
                const Vec4f* first = map.node.data() + map.grid.indexOf({0, j, k});
                Nodes ahead = nodesAcross(first, nodesOfRow, nodesOfLayer);
                for (int i = 0; i < count.x; ++i) {
                    Nodes corners = ahead;
                    ahead = nodesAcross(first + i + 1, nodesOfRow, nodesOfLayer);
                    corners.add(ahead);
                    if (corners.known == 0) continue;
                    if (!corners.meet(clipMin - kBeside, clipMax + kBeside) ||
                        !bricks.any(higher(corners.low, clipMin) - kBeside, lower(corners.high, clipMax) + kBeside))
                        continue;
                    row[i] = corners.known == 8;
                    if (corners.known < 8 && corners.meet(clipMin, clipMax)) unknown[std::size_t(k)] = 1;
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
