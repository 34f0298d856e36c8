#include "core/stf/displacement_image.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace voledit {

namespace {

constexpr int kLeaves = 8;                // an axis: leaves that may be left out
constexpr int kPoints = 2 * kLeaves + 1;  // samples an axis: each leaf has 3×3×3
constexpr int kRounds = 6;
const Box3 kEverywhere{Vec3(-kInfinity), Vec3(kInfinity)};

/// |Δ| of a map in a box, sampled where the map may reach `rest`.
class DisplacementSearch {
public:
    DisplacementSearch(const SpatialTransferFunction& map, const Box3& where, const Box3& rest)
        : map_(map), where_(where), rest_(rest), p_(kPoints * kPoints * kPoints), delta_(p_.size()) {
        for (std::size_t n = 0; n < p_.size(); ++n) {
            const auto i = int(n % kPoints), j = int(n / kPoints % kPoints), k = int(n / (kPoints * kPoints));
            p_[n] = at(Vec3(i, j, k) / double(kPoints - 1));
        }
        map.map(p_, delta_);
        for (std::size_t n = 0; n < p_.size(); ++n) delta_[n] -= p_[n];
    }

    double largest() {
        search(Index3(0), kLeaves);
        return largest_;
    }

private:
    Vec3 at(const Vec3& fraction) const { return where_.min + fraction * (where_.max - where_.min); }

    /// Leaves from `first`, `side` an axis.
    void search(Index3 first, int side) {
        const Box3 box{at(Vec3(first) / double(kLeaves)), at(Vec3(first + side) / double(kLeaves))};
        const auto reaches = [&](const Box3& source) { return !intersect(source, rest_).empty(); };
        if (!map_.anySourceBox(box, reaches)) return;
        if (side == 1) return measure(first);
        for (int c = 0; c < 8; ++c) search(first + side / 2 * Index3(c & 1, c >> 1 & 1, c >> 2), side / 2);
    }

    const Vec3& deltaAt(Index3 point) const {
        return delta_[std::size_t(point.x + kPoints * (point.y + kPoints * point.z))];
    }

    void measure(Index3 leaf) {
        double largest = 0;
        Vec3 corners(0);
        for (int n = 0; n < 27; ++n) {
            const Index3 offset(n % 3, n / 3 % 3, n / 9);
            const Vec3& delta = deltaAt(2 * leaf + offset);
            if (isDefined(delta)) largest = std::max(largest, glm::length(delta));
            if (offset.x != 1 && offset.y != 1 && offset.z != 1) corners += delta;
        }
        // Between samples: a smooth Δ leaves the straight line at most about half as far as it does over two samples.
        const double bend = glm::length(deltaAt(2 * leaf + 1) - corners / 8.0);
        if (bend > 1e-12 * largest) largest += 0.5 * bend;  // false where one of them is undefined
        if (std::isfinite(largest)) largest_ = std::max(largest_, largest);
    }

    const SpatialTransferFunction& map_;
    const Box3 where_, rest_;
    std::vector<Vec3> p_, delta_;
    double largest_ = 0;
};

bool isFinite(const Box3& box) {
    for (int a = 0; a < 3; ++a)
        if (!std::isfinite(box.min[a]) || !std::isfinite(box.max[a])) return false;
    return true;
}

}  // namespace

Box3 grown(const Box3& box, double distance) {
    return box.empty() ? box : Box3{box.min - distance, box.max + distance};
}

Box3 imageByDisplacement(const SpatialTransferFunction& map, const Box3& rest, const Box3& likely) {
    if (rest.empty() || !isFinite(rest)) return rest;
    Box3 where = isFinite(likely) ? join(rest, likely) : rest;
    double reach = 0;
    for (int round = 0; round < kRounds; ++round) {
        const double before = reach;
        reach = DisplacementSearch(map, where, rest).largest();
        if (round > 0 && reach <= before) break;  // all that the last box can hold lies in this one
        where = grown(rest, reach);
    }
    return grown(rest, reach);
}

Box3 sourceHull(const SpatialTransferFunction& map, const Box3& box) {
    Box3 hull;
    map.anySourceBox(box, [&](const Box3& source) {
        hull = join(hull, source);
        return false;
    });
    return hull;
}

Box3 combination(double a, const Box3& u, double b, const Box3& v) {
    const auto times = [](double factor, double x) { return factor == 0 ? 0 : factor * x; };
    Box3 result;
    for (int axis = 0; axis < 3; ++axis) {
        const double u0 = times(a, u.min[axis]), u1 = times(a, u.max[axis]);
        const double v0 = times(b, v.min[axis]), v1 = times(b, v.max[axis]);
        result.min[axis] = std::min(u0, u1) + std::min(v0, v1);
        result.max[axis] = std::max(u0, u1) + std::max(v0, v1);
    }
    return result;
}

Box3 blended(const Interval& weight, const Box3& u, const Box3& v) {
    if (!std::isfinite(weight.low) || !std::isfinite(weight.high)) return kEverywhere;
    // Linear in w for every pair of points, so the ends of `weight` hold all between.
    return join(combination(1 - weight.low, u, weight.low, v), combination(1 - weight.high, u, weight.high, v));
}

}  // namespace voledit
