#include "core/objects/opacity_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/fields/extinction.h"
#include "core/objects/term_bounds.h"
#include "core/objects/term_cache.h"

namespace voledit {

namespace {

constexpr int kBlockSide = 8;  // cells sampled together

std::size_t countOf(Index3 size) {
    return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
}

std::size_t indexIn(Index3 size, int x, int y, int z) {
    return std::size_t(x) + std::size_t(size.x) * (std::size_t(y) + std::size_t(size.y) * std::size_t(z));
}

Index3 placeOf(std::size_t n, Index3 size) {
    const auto x = std::size_t(size.x), y = std::size_t(size.y);
    return {int(n % x), int(n / x % y), int(n / (x * y))};
}

/// Calls visit(n, place) for every cell of `size`, in parallel by layers.
template <class Visit>
void forEach(Index3 size, const Visit& visit) {
    parallelFor(std::size_t(size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (int z = int(begin); z < int(end); ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) visit(indexIn(size, x, y, z), Index3(x, y, z));
    });
}

}  // namespace

OpacityGrid::OpacityGrid(const Term& term, double spacing, double opacityDistance) : spacing_(spacing) {
    assert(spacing > 0 && opacityDistance > 0);
    const Vec3 extent = term.bounds.size();
    const double whole = double(1 << (kLevels - 1));  // so that every level halves the one below
    const auto sizeFor = [&](double h) { return whole * glm::ceil((glm::ceil(extent / h) + 2.0) / whole); };
    for (Vec3 size = sizeFor(spacing_); size.x * size.y * size.z > double(kMostCells); size = sizeFor(spacing_))
        spacing_ *= std::max(1.001, std::cbrt(size.x * size.y * size.z / double(kMostCells)));
    const Index3 size(sizeFor(spacing_));
    origin_ = (term.bounds.empty() ? Vec3(0) : term.bounds.center()) - 0.5 * spacing_ * Vec3(size);
    levels_.push_back({size, std::vector<std::uint16_t>(countOf(size))});
    if (!term.bounds.empty()) sampleTerm(term, opacityDistance);
    addLevels();
    measureClearance();
}

void OpacityGrid::sampleTerm(const Term& term, double opacityDistance) {
    Level& finest = levels_.front();
    const Index3 size = finest.size, blocks = (size + kBlockSide - 1) / kBlockSide;
    const double power = spacing_ / opacityDistance;
    parallelFor(countOf(blocks), 4, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> points;
        std::vector<ObjectSample> samples;
        for (std::size_t n = begin; n < end; ++n) {
            const Index3 first = placeOf(n, blocks) * kBlockSide, last = glm::min(first + kBlockSide, size);
            if (!mayBeVisible(term, {origin_ + spacing_ * Vec3(first), origin_ + spacing_ * Vec3(last)})) continue;
            points.clear();
            for (int z = first.z; z < last.z; ++z)
                for (int y = first.y; y < last.y; ++y)
                    for (int x = first.x; x < last.x; ++x) points.push_back(origin_ + spacing_ * (Vec3(x, y, z) + 0.5));
            samples.resize(points.size());
            sample(term, points, samples, false, "");
            auto from = samples.begin();
            for (int z = first.z; z < last.z; ++z)
                for (int y = first.y; y < last.y; ++y)
                    for (int x = first.x; x < last.x; ++x, ++from) {
                        if (!(from->opacity > 0)) continue;
                        const double alpha = 1 - std::pow(1 - std::min(from->opacity, kLargestOpacity), power);
                        finest.alpha[indexIn(size, x, y, z)] = std::uint16_t(std::lround(65535 * alpha));
                    }
        }
    });
}

// A level's cell is the mean of the eight below it.
void OpacityGrid::addLevels() {
    for (int l = 1; l < kLevels; ++l) {
        const Level& fine = levels_.back();
        Level coarse{fine.size / 2, {}};
        coarse.alpha.resize(countOf(coarse.size));
        forEach(coarse.size, [&](std::size_t n, Index3 at) {
            const Index3 first = 2 * at;
            std::uint32_t sum = 0;
            for (int z = first.z; z < first.z + 2; ++z)
                for (int y = first.y; y < first.y + 2; ++y)
                    for (int x = first.x; x < first.x + 2; ++x) sum += fine.alpha[indexIn(fine.size, x, y, z)];
            coarse.alpha[n] = std::uint16_t((sum + 4) / 8);
        });
        levels_.push_back(std::move(coarse));
    }
}

// Distances by two sweeps over 13 neighbours each, exact in the largest-coordinate norm.
void OpacityGrid::measureClearance() {
    const Level& finest = levels_.front();
    const Index3 size = finest.size;
    bricks_ = (size + kBrick - 1) / kBrick;
    clearance_.assign(countOf(bricks_), kFarthest);
    forEach(bricks_, [&](std::size_t n, Index3 brick) {
        // A cell counts up to the centres of its neighbours.
        const Index3 first = glm::max(brick * kBrick - 1, Index3(0)), end = glm::min((brick + 1) * kBrick + 1, size);
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y) {
                const std::uint16_t* row = &finest.alpha[indexIn(size, 0, y, z)];
                if (std::any_of(row + first.x, row + end.x, [](std::uint16_t a) { return a > 0; })) {
                    clearance_[n] = 0;
                    return;
                }
            }
    });
    const auto sweep = [&](int sign) {
        for (std::size_t n = 0; n < clearance_.size(); ++n) {
            const std::size_t here = sign < 0 ? n : clearance_.size() - 1 - n;
            const Index3 at = placeOf(here, bricks_);
            int least = clearance_[here];
            for (int k = -1; k <= 1; ++k)
                for (int j = -1; j <= 1; ++j)
                    for (int i = -1; i <= 1; ++i) {
                        if (i + 3 * j + 9 * k >= 0) continue;  // of each pair of opposite neighbours, one
                        const Index3 from = at - sign * Index3(i, j, k);
                        if (from.x < 0 || from.y < 0 || from.z < 0 || from.x >= bricks_.x || from.y >= bricks_.y ||
                            from.z >= bricks_.z)
                            continue;
                        least = std::min(least, clearance_[indexIn(bricks_, from.x, from.y, from.z)] + 1);
                    }
            clearance_[here] = std::uint8_t(least);
        }
    };
    sweep(-1);
    sweep(1);
}

float OpacityGrid::alpha(const Vec3f& at, int level) const {
    const Level& l = levels_[std::size_t(level)];
    const float scale = 1 / float(1 << level);
    std::array<int, 3> cell{};
    std::array<float, 3> f{};
    for (int a = 0; a < 3; ++a) {
        const float x = std::clamp(at[a] * scale - 0.5F, 0.0F, float(l.size[a] - 1));
        cell[std::size_t(a)] = std::max(std::min(int(x), l.size[a] - 2), 0);
        f[std::size_t(a)] = x - float(cell[std::size_t(a)]);
    }
    const std::size_t stepX = l.size.x > 1, stepY = l.size.y > 1 ? std::size_t(l.size.x) : 0,
                      stepZ = l.size.z > 1 ? std::size_t(l.size.x) * std::size_t(l.size.y) : 0;
    const std::uint16_t* p = &l.alpha[indexIn(l.size, cell[0], cell[1], cell[2])];
    const auto line = [&](const std::uint16_t* q) { return float(q[0]) + f[0] * (float(q[stepX]) - float(q[0])); };
    const auto plane = [&](const std::uint16_t* q) {
        const float low = line(q);
        return low + f[1] * (line(q + stepY) - low);
    };
    const float low = plane(p);
    return (low + f[2] * (plane(p + stepZ) - low)) * (1 / 65535.0F);
}

std::shared_ptr<const OpacityGrid> opacityGridOf(const Term& term, double spacing, double opacityDistance) {
    return term.cache->opacityGrid(term, spacing, opacityDistance);
}

}  // namespace voledit
