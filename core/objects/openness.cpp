#include "core/objects/openness.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "core/base/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/objects/openness.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#ifndef VOLEDIT_OPENNESS_RUN
#define VOLEDIT_OPENNESS_RUN
namespace voledit {
/// Neighbours along x of which the openness is found together.
constexpr int kOpennessRun = 16;
/// How far from a point its side is looked for, spacings.
constexpr float kSideReach = 1.5F;
/// The difference between two sides, of the mean, from which on the side is clear.
constexpr float kClearSide = 0.4F;
/// Of the nodes of a run.
struct Sides {
    std::array<std::array<float, kOpennessRun>, 3> outward{};
    std::array<float, kOpennessRun> clear{};  // the length of that
};
}  // namespace voledit
#endif

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = HWY_CAPPED(float, 16);
using Real = hn::Vec<F>;

/// What is left of light after a stretch of so much alpha a spacing.
HWY_INLINE Real passed(Real light, Real alpha, float length) {
    const Real clear = hn::Max(hn::Sub(hn::Set(F(), 1), alpha), hn::Set(F(), 1e-6F));
    return hn::Mul(light, hn::Exp(F(), hn::Mul(hn::Set(F(), length), hn::Log(F(), clear))));
}

/// Alphas of one level at points that lie two spacings apart along x.
class AlphaRow {
public:
    explicit AlphaRow(const OpacityGrid& grid) : grid_(grid) {}

    /// alpha[n] at first + (2 n, 0, 0); false where all are 0.
    bool fetch(int level, const Vec3f& first, float* alpha) {
        const float scale = 1 / float(1 << level), x = first.x * scale - 0.5F, below = std::floor(x);
        const int needed = (2 * kOpennessRun >> level) + 2;
        if (!combine(grid_.level(level), {first.y * scale - 0.5F, first.z * scale - 0.5F}, int(below), needed))
            return false;
        const float f = x - below;
        constexpr int kLanes = int(hn::MaxLanes(F()));
        const auto lanes = int(hn::Lanes(F()));
        static_assert(kLanes <= kOpennessRun);
        if (level == 0) {
            for (int n = 0; n < kOpennessRun; n += lanes) {
                Real even, odd;
                hn::LoadInterleaved2(F(), line_ + 2 * n, even, odd);
                hn::StoreU(hn::Add(even, hn::Mul(hn::Set(F(), f), hn::Sub(odd, even))), F(), alpha + n);
            }
        } else if (level == 1) {
            for (int n = 0; n < kOpennessRun; n += lanes) {
                const Real low = hn::LoadU(F(), line_ + n), high = hn::LoadU(F(), line_ + n + 1);
                hn::StoreU(hn::Add(low, hn::Mul(hn::Set(F(), f), hn::Sub(high, low))), F(), alpha + n);
            }
        } else {
            const int phases = 1 << (level - 1);
            for (int phase = 0; phase < phases; ++phase) {
                const float at = f + float(phase) / float(phases);
                const int over = at >= 1;
                const float t = at - float(over);
                for (int n = phase, m = over; n < kOpennessRun; n += phases, ++m)
                    alpha[n] = line_[m] + t * (line_[m + 1] - line_[m]);
            }
        }
        return true;
    }

private:
    /// line_[m] = alphas of the cells first + m at y and z; held beyond the grid.
    bool combine(const OpacityGrid::Level& level, const std::array<float, 2>& yz, int first, int count) {
        std::array<int, 2> cell{};
        std::array<float, 2> f{};
        for (std::size_t a = 0; a < 2; ++a) {
            const int size = level.size[int(a) + 1];
            const float at = std::clamp(yz[a], 0.0F, float(size - 1));
            cell[a] = std::max(std::min(int(at), size - 2), 0);
            f[a] = at - float(cell[a]);
        }
        const auto sx = std::size_t(level.size.x), sy = std::size_t(level.size.y);
        const std::uint16_t* row = level.alpha.data() + sx * (std::size_t(cell[0]) + sy * std::size_t(cell[1]));
        const std::size_t up = level.size.y > 1 ? sx : 0, back = level.size.z > 1 ? sx * sy : 0;
        const std::array<float, 4> weight{(1 - f[0]) * (1 - f[1]) / 65535, f[0] * (1 - f[1]) / 65535,
                                          (1 - f[0]) * f[1] / 65535, f[0] * f[1] / 65535};
        const std::array<const std::uint16_t*, 4> rows{row, row + up, row + back, row + up + back};
        const auto lanes = int(hn::Lanes(F()));
        const int padded = (count + lanes - 1) / lanes * lanes;
        if (first < 0 || first + padded > level.size.x) return combineHeld(rows, weight, level.size.x, first, count);
        const hn::Rebind<std::uint16_t, F> narrow;
        const hn::RebindToSigned<F> wide;
        Real most = hn::Zero(F());
        for (int m = 0; m < padded; m += lanes) {
            Real sum = hn::Zero(F());
            for (std::size_t r = 0; r < 4; ++r) {
                const auto raw = hn::ConvertTo(F(), hn::PromoteTo(wide, hn::LoadU(narrow, rows[r] + first + m)));
                sum = hn::Add(sum, hn::Mul(raw, hn::Set(F(), weight[r])));
            }
            hn::StoreU(sum, F(), line_ + m);
            most = hn::Max(most, sum);
        }
        return !hn::AllTrue(F(), hn::Eq(most, hn::Zero(F())));
    }

    bool combineHeld(const std::array<const std::uint16_t*, 4>& rows, const std::array<float, 4>& weight, int size,
                     int first, int count) {
        float most = 0;
        for (int m = 0; m < count; ++m) {
            const int x = std::clamp(first + m, 0, size - 1);
            line_[m] = 0;
            for (std::size_t r = 0; r < 4; ++r) line_[m] += weight[r] * float(rows[r][x]);
            most = std::max(most, line_[m]);
        }
        return most > 0;
    }

    const OpacityGrid& grid_;
    float line_[4 * kOpennessRun] = {};
};

/// The openness of the nodes `first`, first + 2, … along x, for surfaces that face `sides`.
void opennessOfRun(const OpacityGrid& grid, std::span<const OpennessStretch> stretches, const Vec3f& first,
                   const Sides& sides, float* openness) {
    constexpr float kDark = 1 / 256.0F;
    AlphaRow row(grid);
    const auto lanes = std::size_t(hn::Lanes(F()));
    float alpha[kOpennessRun], left[kOpennessRun], taken[kOpennessRun], weight[kOpennessRun];
    float open[kOpennessRun] = {}, weights[kOpennessRun] = {};
    const Real one = hn::Set(F(), 1), zero = hn::Zero(F());
    for (const Vec3f& direction : opennessDirections()) {
        bool counts = false;
        for (std::size_t n = 0; n < kOpennessRun; n += lanes) {
            const auto along = [&](int a) HWY_ATTR {
                return hn::Mul(hn::Set(F(), direction[a]), hn::LoadU(F(), sides.outward[std::size_t(a)].data() + n));
            };
            // Without a side all directions count alike.
            const Real facing = hn::Add(hn::Add(along(0), along(1)), along(2));
            const Real flat = hn::Mul(hn::Set(F(), 1 + kFlattestOpenness), hn::LoadU(F(), sides.clear.data() + n));
            const Real w = hn::Max(hn::Add(facing, hn::Sub(one, flat)), zero);
            hn::StoreU(w, F(), weight + n);
            hn::StoreU(one, F(), left + n);
            hn::StoreU(zero, F(), taken + n);
            counts = counts || !hn::AllFalse(F(), hn::Gt(w, zero));
        }
        if (!counts) continue;
        for (const OpennessStretch& stretch : stretches) {
            if (!row.fetch(stretch.level, first + stretch.middle * direction, alpha)) continue;
            bool light = false;
            for (std::size_t n = 0; n < kOpennessRun; n += lanes) {
                const Real before = hn::LoadU(F(), left + n);
                const Real next = passed(before, hn::LoadU(F(), alpha + n), stretch.length);
                const Real took = hn::Mul(hn::Sub(before, next), hn::Set(F(), stretch.counts));
                hn::StoreU(hn::Add(hn::LoadU(F(), taken + n), took), F(), taken + n);
                hn::StoreU(next, F(), left + n);
                light = light || !hn::AllFalse(F(), hn::Gt(next, hn::Set(F(), kDark)));
            }
            if (!light) break;
        }
        for (std::size_t n = 0; n < kOpennessRun; n += lanes) {
            const Real w = hn::LoadU(F(), weight + n), share = hn::Sub(one, hn::LoadU(F(), taken + n));
            hn::StoreU(hn::Add(hn::LoadU(F(), open + n), hn::Mul(w, share)), F(), open + n);
            hn::StoreU(hn::Add(hn::LoadU(F(), weights + n), w), F(), weights + n);
        }
    }
    for (int n = 0; n < kOpennessRun; ++n) openness[n] = weights[n] > 0 ? open[n] / weights[n] : 1;
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voledit {

HWY_EXPORT(opennessOfRun);

namespace {

std::array<Vec3f, kOpennessDirections> madeDirections() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    std::array<Vec3f, kOpennessDirections> found{};
    std::size_t n = 0;
    const auto add = [&](const Vec3& v) { found[n++] = Vec3f(glm::normalize(v)); };
    for (int axis = 0; axis < 3; ++axis)
        for (int signs = 0; signs < 4; ++signs) {
            const auto turned = [&](double a, double b) {
                Vec3 v(0);
                v[(axis + 1) % 3] = signs & 1 ? -a : a;
                v[(axis + 2) % 3] = signs & 2 ? -b : b;
                return v;
            };
            add(turned(1, golden));           // an icosahedron's corner
            add(turned(golden, 1 / golden));  // a dodecahedron's, whose other eight are a cube's
        }
    for (int corner = 0; corner < 8; ++corner) add({corner & 1 ? -1 : 1, corner & 2 ? -1 : 1, corner & 4 ? -1 : 1});
    return found;
}

/// Outwards by the means of one level.
Vec3f outwardBy(const OpacityGrid& grid, const Vec3f& at, int level) {
    Vec3f difference(0);
    float sum = 0;
    for (int a = 0; a < 3; ++a) {
        Vec3f offset(0);
        offset[a] = kSideReach * float(level);
        const float ahead = grid.alpha(at + offset, level), behind = grid.alpha(at - offset, level);
        difference[a] = behind - ahead;
        sum += ahead + behind;
    }
    const float length = glm::length(difference);
    if (!(length > 0)) return Vec3f(0);
    // A side is clear where the difference is a good part of the mean.
    const float clear = std::min(length / (kClearSide * sum / 6), 1.0F);
    return difference * (clear / length);
}

/// What a node counts where the mean of alpha about it is so large: little where it would be darkened by the very
/// surface that it stands before.
float weightOf(float alpha) {
    constexpr float kWithin = 0.17F;      // of a surface half a spacing below
    constexpr float kLeast = 1 / 256.0F;  // between opaque nodes there is nothing but their own
    const float ratio = alpha / kWithin, cube = ratio * ratio * ratio;
    return std::max(1 / (1 + cube * cube), kLeast);
}

/// Nodes that points in what is visible look up, from up to kSideReach outside, and how open they are.
class NodeFinder {
public:
    NodeFinder(const OpacityGrid& grid, float radius)
        : grid_(grid), size_(grid.level(1).size), stretches_(opennessStretches(radius)) {}

    /// Finds those of row (j, k); node[2 i] and node[2 i + 1] as Openness::nodes() has them.
    void findRow(int j, int k, std::uint16_t* node) const {
        for (int first = 0; first < size_.x; first += kOpennessRun) findRun({first, j, k}, node + 2 * first);
    }

private:
    void findRun(Index3 first, std::uint16_t* node) const {
        const int count = std::min(kOpennessRun, size_.x - first.x);
        enum class Kind : std::uint8_t { Unseen, Buried, Open };
        std::array<Kind, kOpennessRun> kind{};
        bool any = false;
        Sides sides;
        for (int n = 0; n < count; ++n) {
            const Index3 at = first + Index3(n, 0, 0);
            const auto i = std::size_t(n);
            if (!nearVisible(at)) continue;
            kind[i] = buried(at) ? Kind::Buried : Kind::Open;
            if (kind[i] == Kind::Buried) continue;
            any = true;
            const Vec3f side = opennessSide(grid_, placeOf(at));
            for (std::size_t a = 0; a < 3; ++a) sides.outward[a][i] = side[int(a)];
            sides.clear[i] = glm::length(side);
        }
        std::array<float, kOpennessRun> open{};
        if (any) HWY_DYNAMIC_DISPATCH(opennessOfRun)(grid_, stretches_, placeOf(first), sides, open.data());
        for (int n = 0; n < count; ++n) {
            const auto i = std::size_t(n);
            if (kind[i] == Kind::Unseen) continue;
            const float weight = weightOf(alphaOf(first + Index3(n, 0, 0)));
            if (kind[i] == Kind::Open)
                node[2 * i] = std::uint16_t(std::lround(65535 * weight * std::min(open[i] * kFlat, 1.0F)));
            node[2 * i + 1] = std::uint16_t(std::lround(65535 * weight));
        }
    }

    static Vec3f placeOf(Index3 node) { return 2.0F * Vec3f(node) + 1.0F; }

    float alphaOf(Index3 node) const {
        return float(grid_.level(1).alpha[std::size_t(node.x) +
                                          std::size_t(size_.x) *
                                              (std::size_t(node.y) + std::size_t(size_.y) * std::size_t(node.z))]) /
               65535;
    }

    bool nearVisible(Index3 node) const { return grid_.clearanceOf(node / (OpacityGrid::kBrick / 2)) <= 1; }

    /// No light comes through what is all around.
    bool buried(Index3 node) const {
        for (int n = 0; n < 27; ++n) {
            const Index3 at = node + Index3(n % 3, n / 3 % 3, n / 9) - 1;
            for (int a = 0; a < 3; ++a)
                if (at[a] < 0 || at[a] >= size_[a]) return false;
            if (!(alphaOf(at) > kBuried)) return false;
        }
        return true;
    }

    static constexpr float kBuried = 0.75F;  // alpha
    static constexpr float kFlat = 1.02F;    // means reach so much into a flat surface below

    const OpacityGrid& grid_;
    Index3 size_;
    std::array<OpennessStretch, kOpennessStretches> stretches_;
};

}  // namespace

const std::array<Vec3f, kOpennessDirections>& opennessDirections() {
    static const std::array<Vec3f, kOpennessDirections> found = madeDirections();
    return found;
}

// Longer the farther they are, and over means so wide that nothing between two samples is missed.
std::array<OpennessStretch, kOpennessStretches> opennessStretches(float radius) {
    std::array<OpennessStretch, kOpennessStretches> found{};
    for (int n = 0; n < kOpennessStretches; ++n) {
        const float from = float(n) / kOpennessStretches, to = float(n + 1) / kOpennessStretches;
        const float begin = radius * from * from, end = radius * to * to, middle = (begin + end) / 2;
        const int level = int(std::floor(std::log2(std::max((end - begin) / 2, 1.0F))));
        found[std::size_t(n)] = {middle, end - begin, std::min(level, OpacityGrid::kLevels - 1),
                                 1 - (middle / radius) * (middle / radius)};
    }
    return found;
}

Vec3f outwardOf(const OpacityGrid& grid, const Vec3f& at) {
    return outwardBy(grid, at, 1);
}

Vec3f opennessSide(const OpacityGrid& grid, const Vec3f& node) {
    constexpr float kBelow = 2;
    Vec3f side = outwardBy(grid, node, 1);
    if (side == Vec3f(0)) side = outwardBy(grid, node, 2);  // nothing is near
    if (side == Vec3f(0)) return side;
    const Vec3f below = outwardBy(grid, node - kBelow * side, 1);
    return glm::dot(below, side) > 0 ? below : side;  // a thin wall's other side is another one
}

Openness::Openness(const OpacityGrid& grid, float radius) : size_(grid.level(1).size) {
    const NodeFinder finder(grid, radius);
    const std::size_t sx = std::size_t(size_.x), sy = std::size_t(size_.y), rows = sy * std::size_t(size_.z);
    nodes_.resize(2 * sx * rows);
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) finder.findRow(int(r % sy), int(r / sy), &nodes_[2 * sx * r]);
    });
}

float Openness::at(const Vec3f& at) const {
    Index3 node;
    Vec3f f;
    for (int a = 0; a < 3; ++a) {
        const float x = std::clamp(0.5F * at[a] - 0.5F, 0.0F, float(size_[a] - 1));
        node[a] = std::max(std::min(int(x), size_[a] - 2), 0);
        f[a] = x - float(node[a]);
    }
    float open = 0, weights = 0;
    for (int c = 0; c < 8; ++c) {
        const Index3 step(c & 1, c >> 1 & 1, c >> 2);
        const Index3 corner = glm::min(node + step, size_ - 1);
        const std::size_t n =
            std::size_t(corner.x) +
            std::size_t(size_.x) * (std::size_t(corner.y) + std::size_t(size_.y) * std::size_t(corner.z));
        const float share = (step.x ? f.x : 1 - f.x) * (step.y ? f.y : 1 - f.y) * (step.z ? f.z : 1 - f.z);
        open += share * float(nodes_[2 * n]);
        weights += share * float(nodes_[2 * n + 1]);
    }
    return weights > 0 ? open / weights : 1;
}

}  // namespace voledit
#endif
