#include "core/eval/baked_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/base/quad.h"

namespace voledit {

namespace {

/// Continues runs of known nodes along a line linearly by kBakeBorder nodes at both ends, which get `mark`.
void continueLine(Vec4f* line, std::size_t stride, int count, float mark) {
    const auto at = [&](int n) -> Vec4f& { return line[std::size_t(n) * stride]; };
    /// Gives how many nodes it filled.
    const auto extend = [&](int edge, int direction, bool single) {
        const Vec4f rate = single ? Vec4f(0) : at(edge) - at(edge - direction);
        for (int r = 1; r <= kBakeBorder; ++r) {
            const int n = edge + direction * r;
            if (n < 0 || n >= count || at(n).w > 0) return r - 1;
            at(n) = Vec4f(Vec3f(at(edge) + float(r) * rate), mark);
        }
        return kBakeBorder;
    };
    for (int n = 0; n < count; ++n) {
        if (!(at(n).w > 0)) continue;
        int end = n;
        while (end + 1 < count && at(end + 1).w > 0) ++end;
        const bool single = n == end;
        extend(n, -1, single);
        n = end + extend(end, 1, single);
    }
}

}  // namespace

Mat4 BakeGrid::gridFromWorld() const {
    Mat4 m(1 / cell);
    m[3] = Vec4(-origin / cell, 1);
    return m;
}

BakeGrid bakeGrid(const Box3& bounds, int most) {
    BakeGrid grid;
    const Vec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z, 1e-30});
    grid.cell = longest / std::max(most - 1 - 2 * kBakeBorder, 1);
    for (int a = 0; a < 3; ++a)
        grid.nodes[a] = std::max(int(std::ceil(size[a] / grid.cell - 1e-9)), 1) + 1 + 2 * kBakeBorder;
    grid.origin = bounds.center() - 0.5 * grid.cell * Vec3(grid.nodes - 1);
    return grid;
}

Mat3 BakedMap::jacobianAt(Index3 n) const {
    Mat3 j(0);
    const Vec4f& here = node[grid.indexOf(n)];
    if (!(here.w > 0)) return j;
    for (int a = 0; a < 3; ++a) {
        const auto neighbour = [&](int d) {
            Index3 other = n;
            other[a] += d;
            const bool within = other[a] >= 0 && other[a] < grid.nodes[a];
            return within ? node[grid.indexOf(other)] : Vec4f(0);
        };
        const Vec4f ahead = neighbour(1), behind = neighbour(-1);
        const Vec4f& to = ahead.w > 0 ? ahead : here;
        const Vec4f& from = behind.w > 0 ? behind : here;
        const int cells = (ahead.w > 0) + (behind.w > 0);
        if (cells > 0) j[a] = Vec3(Vec3f(to) - Vec3f(from)) / (cells * grid.cell);
    }
    return j;
}

bool BakedMap::atGrid(const Vec3& unclamped, Vec3& place) const {
    const Vec3 x = glm::clamp(unclamped, Vec3(0), Vec3(grid.nodes - 1));
    const Index3 below = glm::min(Index3(x), grid.nodes - 2);
    const Vec3f f(x - Vec3(below));
    const Vec4f* first = node.data() + grid.indexOf(below);
    const std::size_t row = std::size_t(grid.nodes.x), layer = row * std::size_t(grid.nodes.y);
    Quad least = quadOf(*first);
    const auto along = [&](std::size_t n) {
        const Quad from = quadOf(first[n]), to = quadOf(first[n + 1]);
        least = lower(least, lower(from, to));
        return from + f.x * (to - from);
    };
    const auto across = [&](std::size_t n) {
        const Quad from = along(n), to = along(n + row);
        return from + f.y * (to - from);
    };
    const Quad from = across(0), to = across(layer);
    place = vec3Of(from + f.z * (to - from));
    return least[3] > 0;
}

bool BakedMap::surelyKnownAt(const Vec3& p) const {
    const Index3 below = glm::clamp(Index3((p - grid.origin) / grid.cell), Index3(0), grid.nodes - 2);
    for (int c = 0; c < 8; ++c)
        if (node[grid.indexOf(below + Index3(c & 1, c >> 1 & 1, c >> 2))].w < 1) return false;
    return true;
}

double BakedMap::errorAt(const Known& known, double straight) const {
    if (!isDefined(known.place)) return kInfinity;
    Vec3 place;
    if (straight == 0) return atGrid(known.at, place) ? glm::length(place - known.place) : 0;
    double worst = 0;
    for (int a = 0; a < 3; ++a) {
        Vec3 half(0), other;
        half[a] = straight / 2;
        if (atGrid(known.at - half, place) && atGrid(known.at + half, other))
            worst = std::max(worst, glm::length(0.5 * (place + other) - known.place));
    }
    return worst;
}

double BakedMap::error(std::span<const Known> known, double straight) const {
    constexpr std::size_t kGrain = 1024;
    std::vector<double> worst((known.size() + kGrain - 1) / kGrain, 0);
    parallelFor(worst.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part)
            for (const Known& one : known.subspan(part * kGrain, std::min(kGrain, known.size() - part * kGrain)))
                worst[part] = std::max(worst[part], errorAt(one, straight));
    });
    return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

void BakedMap::continueOutwards(float mark) {
    const Index3& nodes = grid.nodes;
    const std::size_t row = std::size_t(nodes.x), layer = row * std::size_t(nodes.y);
    parallelFor(std::size_t(nodes.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            for (int j = 0; j < nodes.y; ++j)
                continueLine(node.data() + k * layer + std::size_t(j) * row, 1, nodes.x, mark);
            for (int i = 0; i < nodes.x; ++i)
                continueLine(node.data() + k * layer + std::size_t(i), row, nodes.y, mark);
        }
    });
    parallelFor(std::size_t(nodes.y), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j)
            for (int i = 0; i < nodes.x; ++i)
                continueLine(node.data() + j * row + std::size_t(i), layer, nodes.z, mark);
    });
}

BakedMap bake(const PlaceMap& exact, const BakeGrid& grid) {
    BakedMap map{grid, std::vector<Vec4f>(grid.nodeCount(), Vec4f(0))};
    parallelFor(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z), 8, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> p;
        for (std::size_t row = begin; row < end; ++row)
            for (int i = 0; i < grid.nodes.x; ++i)
                p.push_back(grid.origin + grid.cell * Vec3(i, int(row) % grid.nodes.y, int(row) / grid.nodes.y));
        exact(p, p);
        Vec4f* node = map.node.data() + begin * std::size_t(grid.nodes.x);
        for (const Vec3& place : p) {
            if (isDefined(place)) *node = Vec4f(Vec3f(place), 1);
            ++node;
        }
    });
    map.continueOutwards(BakedMap::kContinued);
    return map;
}

std::vector<BakedMap::Known> bakedCentres(const BakedMap& map, const PlaceMap& exact,
                                          const std::vector<std::uint8_t>& seen) {
    const BakeGrid& grid = map.grid;
    const Index3 count = grid.nodes - 1;
    std::vector<BakedMap::Known> centres;
    const std::uint8_t* flag = seen.data();
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i)
                if (*flag++) centres.push_back({Vec3(i, j, k) + 0.5, Vec3(0)});
    parallelFor(centres.size(), 1024, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> p;
        for (std::size_t n = begin; n < end; ++n) p.push_back(grid.origin + grid.cell * centres[n].at);
        std::vector<Vec3> place(p.size());
        exact(p, place);
        for (std::size_t n = begin; n < end; ++n)
            centres[n].place = map.surelyKnownAt(p[n - begin]) ? place[n - begin] : kUndefined;
    });
    return centres;
}

}  // namespace voledit
