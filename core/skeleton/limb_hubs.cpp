#include "core/skeleton/limb_hubs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/base/box3.h"

namespace voledit {

namespace {

/// Part of a region's width, from a face inwards, over which its say grows from 0 to 1.
constexpr double kRamp = 0.4;

Vec3 pointIn(const LimbShape& shape, const Vec3& s) {
    return (1 - s.z) * pointOf(shape.start, s.x, s.y) + s.z * pointOf(shape.end, s.x, s.y);
}

Mat3 derivativeIn(const LimbShape& shape, const Vec3& s) {
    return {(1 - s.z) * alongU(shape.start, s.y) + s.z * alongU(shape.end, s.y),
            (1 - s.z) * alongV(shape.start, s.x) + s.z * alongV(shape.end, s.x),
            pointOf(shape.end, s.x, s.y) - pointOf(shape.start, s.x, s.y)};
}

/// (u, v, w) of q in a rest region, by Newton from its middle; nullopt outside it.
std::optional<Vec3> placeIn(const LimbShape& shape, const Vec3& q) {
    Vec3 s(0.5);
    for (int step = 0; step < 12; ++step) {
        const Mat3 derivative = derivativeIn(shape, s);
        if (!(std::abs(glm::determinant(derivative)) > 0)) return std::nullopt;
        const Vec3 change = glm::inverse(derivative) * (q - pointIn(shape, s));
        s = glm::clamp(s + change, Vec3(-1), Vec3(2));
        if (glm::length(change) < 1e-10) break;
    }
    // A twisted region may have places that Newton does not come to.
    const Mat3 reach = derivativeIn(shape, s);
    const double size = glm::length(reach[0]) + glm::length(reach[1]) + glm::length(reach[2]);
    if (!(glm::length(q - pointIn(shape, s)) < 1e-9 * size)) return std::nullopt;
    for (int a = 0; a < 3; ++a)
        if (!(s[a] >= -1e-9 && s[a] <= 1 + 1e-9)) return std::nullopt;
    return glm::clamp(s, Vec3(0), Vec3(1));
}

Box3 boxOf(const LimbShape& shape) {
    Box3 box;
    for (const Quad* face : {&shape.start, &shape.end})
        for (const Vec3& corner : *face) box = join(box, corner);
    return box;
}

/// From 0 on a face to 1; steep at first, as skin lies near the faces and others' say must not end abruptly there.
double risen(double depth) {
    const double x = std::min(depth / kRamp, 1.0);
    return x * (2 - x);
}

class Hubs {
public:
    Hubs(const HubLimbs& limbs, const LimbGrid& grid, const std::vector<std::vector<Vec3>>& sources,
         std::vector<std::vector<Vec3>>& deformed)
        : in_(limbs), grid_(grid), sources_(sources), deformed_(deformed), before_(deformed) {}

    std::vector<std::vector<char>> blend() {
        const auto neighbours = hubNeighbours(in_);
        const std::vector<int> ranks = this->ranks();
        const std::size_t cells = std::size_t(grid_.cells.x) * std::size_t(grid_.cells.y) * std::size_t(grid_.cells.z);
        std::vector<std::vector<char>> repeated(neighbours.size(), std::vector<char>(cells, 0));
        for (std::size_t l = 0; l < neighbours.size(); ++l) {
            if (neighbours[l].empty()) continue;
            blendLimb(l, neighbours[l]);
            std::uint64_t before = 0;
            for (std::size_t k = 0; k < std::min(neighbours[l].size(), kMostMasked); ++k)
                if (ranks[std::size_t(neighbours[l][k])] < ranks[l]) before |= std::uint64_t(1) << k;
            findRepeated(before, repeated[l]);
            keepRims(l, repeated[l]);
        }
        return repeated;
    }

private:
    static constexpr std::size_t kMostMasked = 64;

    /// Which of two limbs keeps what both hold: the lower one.
    std::vector<int> ranks() const {
        std::vector<int> order(in_.limbs.size()), ranks(in_.limbs.size()), depth(in_.limbs.size(), 0);
        for (const HubRoot& root : hubRoots(in_)) {
            depth[std::size_t(root.limb)] = std::max(depth[std::size_t(root.limb)], 1);
            if (const int next = in_.links.next[std::size_t(root.limb)]; next >= 0) depth[std::size_t(next)] = 2;
        }
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            const Limb &first = in_.limbs[std::size_t(a)], &second = in_.limbs[std::size_t(b)];
            return std::tie(depth[std::size_t(a)], first.from, first.to, a) <
                   std::tie(depth[std::size_t(b)], second.from, second.to, b);
        });
        for (std::size_t n = 0; n < order.size(); ++n) ranks[std::size_t(order[n])] = int(n);
        return ranks;
    }

    /// Cells whose corners all lie in one of the neighbours of the mask `before`.
    void findRepeated(std::uint64_t before, std::vector<char>& repeated) const {
        const std::size_t row = std::size_t(grid_.cells.x + 1), layer = grid_.layerSize();
        std::size_t cell = 0;
        for (std::size_t k = 0; k < std::size_t(grid_.cells.z); ++k)
            for (std::size_t j = 0; j < std::size_t(grid_.cells.y); ++j)
                for (std::size_t i = 0; i < std::size_t(grid_.cells.x); ++i, ++cell) {
                    std::uint64_t common = before;
                    for (const std::size_t corner : {std::size_t(0), std::size_t(1), row, row + 1})
                        for (const std::size_t side : {std::size_t(0), layer})
                            common &= inside_[i + row * j + layer * k + corner + side];
                    repeated[cell] = common != 0;
                }
    }

    /// Takes those out that touch a cell which is kept: the cells of two limbs agree only as well as they are small, so
    /// what is drawn of one reaches a cell's width into the other.
    void keepRims(std::size_t l, std::vector<char>& repeated) const {
        const std::vector<char> whole = repeated;
        const Index3 n = grid_.cells;
        const auto held = [&](const Index3& c) {
            if (c.z < 0) return in_.links.previous[l] < 0;
            if (c.z >= n.z) return in_.links.next[l] < 0;
            if (c.x < 0 || c.y < 0 || c.x >= n.x || c.y >= n.y) return true;
            return whole[std::size_t(c.x + n.x * (c.y + n.y * c.z))] != 0;
        };
        for (int k = 0; k < n.z; ++k)
            for (int j = 0; j < n.y; ++j)
                for (int i = 0; i < n.x; ++i)
                    for (int around = 0; around < 27; ++around)
                        if (!held({i + around % 3 - 1, j + around / 3 % 3 - 1, k + around / 9 - 1}))
                            repeated[std::size_t(i + n.x * (j + n.y * k))] = 0;
    }

    /// How much limb l has to say at (u, v, w) of its region.
    double weight(std::size_t l, const Vec3& s) const {
        const double across = risen(std::min(s.x, 1 - s.x)) * risen(std::min(s.y, 1 - s.y));
        return across * (in_.links.previous[l] < 0 ? risen(s.z) : 1) * (in_.links.next[l] < 0 ? risen(1 - s.z) : 1);
    }

    /// By how much limb l moves what is at (u, v, w) of its region at rest, as its cells do before any blending.
    Vec3 displacement(std::size_t l, const Vec3& s) const {
        const Vec3 at = s * Vec3(grid_.cells);
        const Index3 cell = glm::clamp(Index3(at), Index3(0), grid_.cells - 1);
        const Vec3 part = at - Vec3(cell);
        Vec3 sum(0);
        for (int corner = 0; corner < 8; ++corner) {
            const Index3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            const Vec3 share = glm::mix(1.0 - part, part, Vec3(side));
            const Index3 v = cell + side;
            const std::size_t vertex = std::size_t(v.z) * grid_.layerSize() +
                                       std::size_t(v.y) * std::size_t(grid_.cells.x + 1) + std::size_t(v.x);
            sum += share.x * share.y * share.z * (before_[l][vertex] - sources_[l][vertex]);
        }
        return sum;
    }

    void blendLimb(std::size_t l, const std::vector<int>& neighbours) {
        std::vector<Box3> boxes;
        for (const int k : neighbours) boxes.push_back(boxOf(in_.motions[std::size_t(k)].rest));
        inside_.assign(grid_.size(), 0);
        for (std::size_t n = 0; n < grid_.size(); ++n) {
            const Vec3& q = sources_[l][n];
            const Index3 v(int(n % std::size_t(grid_.cells.x + 1)),
                           int(n % grid_.layerSize() / std::size_t(grid_.cells.x + 1)), int(n / grid_.layerSize()));
            const Vec3 own = before_[l][n] - q;
            double weights = weight(l, Vec3(v) / Vec3(grid_.cells));
            Vec3 change(0);
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                if (!boxes[k].contains(q)) continue;
                const std::size_t other = std::size_t(neighbours[k]);
                const auto place = placeIn(in_.motions[other].rest, q);
                if (!place) continue;
                if (k < kMostMasked) inside_[n] |= std::uint64_t(1) << k;
                const double w = weight(other, *place);
                weights += w;
                change += w * (displacement(other, *place) - own);
            }
            if (weights > 0) deformed_[l][n] += change / weights;
        }
    }

    HubLimbs in_;
    LimbGrid grid_;
    const std::vector<std::vector<Vec3>>& sources_;
    std::vector<std::vector<Vec3>>& deformed_;
    const std::vector<std::vector<Vec3>> before_;
    std::vector<std::uint64_t> inside_;  // of the limb being blended: which neighbours hold each vertex, by bits
};

}  // namespace

std::vector<HubRoot> hubRoots(const HubLimbs& in) {
    std::vector<HubRoot> roots;
    for (std::size_t l = 0; l < in.limbs.size(); ++l) {
        const Limb& limb = in.limbs[l];
        if (in.links.previous[l] >= 0 || (!in.disjoint.empty() && in.disjoint[std::size_t(limb.from)])) continue;
        const Vec3& joint = in.rest[std::size_t(limb.from)].position;
        for (std::size_t k = 0; k < in.limbs.size(); ++k)
            if (k != l &&
                (in.limbs[k].from == limb.from || in.limbs[k].to == limb.from || placeIn(in.motions[k].rest, joint)))
                roots.push_back({int(l), int(k)});
    }
    return roots;
}

std::vector<std::vector<int>> hubNeighbours(const HubLimbs& in) {
    const auto& links = in.links;
    std::vector<std::vector<int>> met(in.limbs.size());
    const auto meet = [&](int a, int b) {
        if (a < 0 || b < 0 || a == b) return;
        if (links.next[std::size_t(a)] == b || links.previous[std::size_t(a)] == b) return;
        met[std::size_t(a)].push_back(b);
        met[std::size_t(b)].push_back(a);
    };
    for (const HubRoot& root : hubRoots(in))
        for (const int a : {root.limb, links.next[std::size_t(root.limb)]}) {
            for (int b = root.in; b >= 0; b = links.next[std::size_t(b)]) meet(a, b);
            for (int b = root.in; b >= 0; b = links.previous[std::size_t(b)]) meet(a, b);
        }
    for (auto& of : met) {
        // In an order that does not depend on that of the limbs, so that sums do not either.
        std::sort(of.begin(), of.end(), [&](int a, int b) {
            const Limb &first = in.limbs[std::size_t(a)], &second = in.limbs[std::size_t(b)];
            return std::tie(first.from, first.to, a) < std::tie(second.from, second.to, b);
        });
        of.erase(std::unique(of.begin(), of.end()), of.end());
    }
    return met;
}

std::vector<std::vector<char>> blendHubs(const HubLimbs& limbs, const LimbGrid& grid,
                                         const std::vector<std::vector<Vec3>>& sources,
                                         std::vector<std::vector<Vec3>>& deformed) {
    return Hubs(limbs, grid, sources, deformed).blend();
}

}  // namespace voledit
