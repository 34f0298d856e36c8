#include "core/objects/empty_space.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/fields/value_bricks.h"
#include "core/objects/term_bounds.h"
#include "core/objects/term_cache.h"

namespace voledit {

namespace {

constexpr int kFinestCells = 64;  // along the longest side of the bounds
constexpr int kLevels = 3;

}  // namespace

// A point a thousandth of a voxel outside still counts as inside, and is clamped; a B-spline reaches one sample on.
VisibleBricks::VisibleBricks(const VolumeTerm& node)
    : domain_(node.volume->grid().indexDomain()), reach_(node.interpolation == Interpolation::Cubic ? 1.002 : 0.002) {
    const ValueBricks& bricks = node.volume->bricks(node.channel);
    count_ = bricks.count;
    const Index3 corners = count_ + 1;
    sums_.assign(std::size_t(corners.x) * std::size_t(corners.y) * std::size_t(corners.z), 0);
    const auto sum = [&](int i, int j, int k) -> std::uint32_t& {
        return sums_[std::size_t(i) +
                     std::size_t(corners.x) * (std::size_t(j) + std::size_t(corners.y) * std::size_t(k))];
    };
    for (int k = 0; k < count_.z; ++k)
        for (int j = 0; j < count_.y; ++j) {
            std::uint32_t row = 0;
            for (int i = 0; i < count_.x; ++i) {
                const std::size_t n = bricks.indexOf({i, j, k});
                row += bricks.low[n] <= bricks.high[n] &&
                       largestOpacity(node.appearance.opacity, bricks.low[n], bricks.high[n]) > 0;
                sum(i + 1, j + 1, k + 1) = row + sum(i + 1, j, k + 1) + sum(i + 1, j + 1, k) - sum(i + 1, j, k);
            }
        }
}

bool VisibleBricks::mayBeVisible(const Box3& box) const {
    const Box3 inside = intersect({box.min - reach_, box.max + reach_}, domain_);
    if (inside.empty()) return false;
    const auto brick = [](const Vec3& x) { return Index3(glm::floor(x / double(ValueBricks::kSide))); };
    const Index3 first = glm::clamp(brick(inside.min), Index3(0), count_ - 1);
    const Index3 end = glm::clamp(brick(inside.max), Index3(0), count_ - 1) + 1;
    const auto sum = [&](int i, int j, int k) {
        return sums_[std::size_t(i) +
                     std::size_t(count_.x + 1) * (std::size_t(j) + std::size_t(count_.y + 1) * std::size_t(k))];
    };
    const auto layer = [&](int k) {
        return sum(end.x, end.y, k) - sum(first.x, end.y, k) - sum(end.x, first.y, k) + sum(first.x, first.y, k);
    };
    return layer(end.z) != layer(first.z);
}

EmptySpace::EmptySpace(const Term& term) : bounds_(term.bounds) {
    const Vec3 extent = bounds_.size();
    cellSize_ = std::max({extent.x, extent.y, extent.z}) / kFinestCells;
    if (bounds_.empty() || !(cellSize_ > 0) || !std::isfinite(cellSize_)) return;
    Index3 size = Index3(glm::floor(extent / cellSize_)) + 1;
    for (int level = 0; level < kLevels; ++level, size = (size + 3) / 4)
        levels_.push_back(
            {size, std::vector<std::uint8_t>(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z))});
    const Level& top = levels_.back();
    parallelFor(top.visible.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const auto x = std::size_t(top.size.x), y = std::size_t(top.size.y);
            fill(term, kLevels - 1, Index3(n % x, n / x % y, n / (x * y)));
        }
    });
}

/// Decides `cell` of `level` and, where it may be visible, its parts.
void EmptySpace::fill(const Term& term, int level, Index3 cell) {
    const double side = cellSize_ * double(1 << (2 * level)), slack = 1e-9 * side;
    const Vec3 corner = bounds_.min + Vec3(cell) * side;
    if (!mayBeVisible(term, {corner - slack, corner + side + slack})) return;
    Level& here = levels_[std::size_t(level)];
    here.visible[here.indexOf(cell)] = 1;
    if (level == 0) return;
    const Index3 first = cell * 4, end = glm::min(first + 4, levels_[std::size_t(level - 1)].size);
    for (int k = first.z; k < end.z; ++k)
        for (int j = first.y; j < end.y; ++j)
            for (int i = first.x; i < end.x; ++i) fill(term, level - 1, {i, j, k});
}

double EmptySpace::emptyAhead(const Vec3& p, const Vec3& direction) const {
    if (levels_.empty()) return 0;
    const Vec3 position = (p - bounds_.min) / cellSize_;
    const Index3 finest = glm::clamp(Index3(glm::floor(position)), Index3(0), levels_[0].size - 1);
    int level = kLevels;
    while (level > 0) {
        const Level& coarser = levels_[std::size_t(level - 1)];
        const Index3 cell(finest.x >> 2 * (level - 1), finest.y >> 2 * (level - 1), finest.z >> 2 * (level - 1));
        if (!coarser.visible[coarser.indexOf(cell)]) break;
        --level;
    }
    if (level == 0) return 0;
    const int shift = 2 * (level - 1);
    double exit = kInfinity;
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0) continue;
        const int low = finest[a] >> shift << shift, face = direction[a] > 0 ? low + (1 << shift) : low;
        exit = std::min(exit, (face - position[a]) / direction[a]);
    }
    return std::max(exit, 0.0) * cellSize_;
}

const EmptySpace& emptySpaceOf(const Term& term) {
    return term.cache->emptySpace(term);
}

}  // namespace voledit
