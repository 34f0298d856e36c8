#include "core/stf/displacement_image.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace voledit {

namespace {

constexpr int kCells = 8;        // an axis, at first
constexpr int kRefinements = 3;  // each halves the cells that matter
constexpr std::size_t kMostCellsKept = 20'000;
constexpr int kRounds = 8;
const Box3 kEverywhere{Vec3(-kInfinity), Vec3(kInfinity)};

/// Seeks the largest |Δ| of a map in a box, over all points or over those that it carries into `target`.
class DisplacementSearch {
public:
    DisplacementSearch(const SpatialTransferFunction& map, const Box3& where, const Box3* target)
        : map_(map), target_(target), cells_(std::size_t(kCells * kCells * kCells)) {
        size_ = (where.max - where.min) / double(kCells);
        for (std::size_t n = 0; n < cells_.size(); ++n)
            cells_[n] = where.min + Vec3(n % kCells, n / kCells % kCells, n / (kCells * kCells)) * size_;
    }

    double largest() {
        double bound = examine();
        for (int n = 0; n < kRefinements && !cells_.empty() && cells_.size() < kMostCellsKept / 8; ++n) {
            refine();
            bound = examine();
        }
        return std::max(seen_, bound);
    }

private:
    static constexpr std::size_t kSamples = 9;  // of a cell: its corners and its middle

    /// Samples all cells and keeps those that may hold more than what was seen; gives the most that they may hold.
    double examine() {
        std::vector<Vec3> p(cells_.size() * kSamples), q(p.size());
        for (std::size_t n = 0; n < cells_.size(); ++n)
            for (std::size_t c = 0; c < kSamples; ++c)
                p[n * kSamples + c] = cells_[n] + (c < 8 ? Vec3(c & 1, c >> 1 & 1, c >> 2) : Vec3(0.5)) * size_;
        map_.map(p, q);
        for (std::size_t n = 0; n < p.size(); ++n)
            if (isDefined(q[n]) && (!target_ || target_->contains(q[n]))) see(glm::length(q[n] - p[n]));
        std::vector<Vec3> kept;
        double bound = 0;
        for (std::size_t n = 0; n < cells_.size(); ++n) {
            const double most =
                mostIn(std::span(p).subspan(n * kSamples, kSamples), std::span(q).subspan(n * kSamples, kSamples));
            if (!(most > seen_ * (1 + 1e-9))) continue;
            kept.push_back(cells_[n]);
            bound = std::max(bound, most);
        }
        cells_ = std::move(kept);
        return bound;
    }

    void see(double length) {
        if (std::isfinite(length)) seen_ = std::max(seen_, length);
    }

    /// The most that |Δ| may be in a cell, as far as its samples tell: 0 where it does not reach the target. An affine
    /// Δ does not bend; what a smooth one bends, it may rise by between its samples.
    double mostIn(std::span<const Vec3> p, std::span<const Vec3> q) const {
        Box3 sources;
        double most = 0;
        Vec3 bend = q[8] - p[8];
        for (std::size_t c = 0; c < kSamples; ++c) {
            if (c < 8) bend -= (q[c] - p[c]) / 8.0;
            if (!isDefined(q[c]) || !std::isfinite(glm::length(q[c]))) continue;
            sources = join(sources, q[c]);
            most = std::max(most, glm::length(q[c] - p[c]));
        }
        const double bent = isDefined(bend) ? glm::length(bend) : 0;
        if (sources.empty() || (target_ && intersect(grown(sources, bent), *target_).empty())) return 0;
        return most + bent;
    }

    void refine() {
        size_ = 0.5 * size_;
        std::vector<Vec3> finer;
        for (const Vec3& cell : cells_)
            for (int c = 0; c < 8; ++c) finer.push_back(cell + Vec3(c & 1, c >> 1 & 1, c >> 2) * size_);
        cells_ = std::move(finer);
    }

    const SpatialTransferFunction& map_;
    const Box3* target_;
    std::vector<Vec3> cells_;  // their lower corners
    Vec3 size_;
    double seen_ = 0;
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
    const Box3 start = isFinite(likely) ? join(rest, likely) : rest;
    double reach = DisplacementSearch(map, start, nullptr).largest();
    for (int round = 0; round < kRounds; ++round) {
        const double before = reach;
        reach = DisplacementSearch(map, grown(rest, before), &rest).largest();
        // All that it holds lies in a smaller box, and a search of that would not tell much better.
        if (reach <= before && reach > 0.9 * before) break;
        if (reach == 0) break;
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
