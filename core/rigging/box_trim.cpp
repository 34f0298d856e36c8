#include "core/rigging/box_trim.h"

#include <algorithm>

#include "core/rigging/rest_hexahedra.h"

namespace voledit {

namespace {

/// A voxel of a rim.
struct RimVoxel {
    Vec3 at{0};
    int owner = 0;
    int keepers = 0;  // how many of those that may hold it do
};

/// The limb with one side of its box moved in: 0, 1 low and high x, 2, 3 low and high y, 4, 5 start and end. Nothing
/// where no box would be left.
std::optional<Limb> withSideMoved(Limb limb, int side, double by) {
    if (side >= 4) {
        double& pad = limb.pad[side - 4];
        if (pad <= by) return std::nullopt;
        pad -= by;
        return limb;
    }
    const int axis = side / 2;
    if (limb.size[axis] < 4 * by) return std::nullopt;
    limb.size[axis] -= by;
    limb.offset[axis] += side % 2 == 0 ? 0.5 * by : -0.5 * by;
    return limb;
}

class Trim {
public:
    Trim(std::vector<Limb> limbs, const FitProblem& problem)
        : problem_(problem), limbs_(std::move(limbs)), held_(limbs_.size()), mayKeep_(limbs_.size()) {
        for (std::size_t l = 0; l < limbs_.size(); ++l) {
            mayKeep_[l].assign(limbs_.size(), false);
            for (const int k : problem.keepersOf(l)) mayKeep_[l][std::size_t(k)] = true;
            for (const Vec3& p : problem.rims[l]) voxels_.push_back({p, int(l), 0});
        }
        const auto regions = restHexahedra(limbs_, problem.rest);
        for (std::size_t l = 0; l < limbs_.size(); ++l)
            for (std::uint32_t v = 0; v < voxels_.size(); ++v)
                if (regions[l].holds(voxels_[v].at)) {
                    held_[l].push_back(v);
                    if (keeps(l, v)) ++voxels_[v].keepers;
                }
    }

    std::vector<Limb> run() {
        constexpr int kMostRounds = 30;
        bool moved = true;
        for (int round = 0; moved && round < kMostRounds; ++round) {
            moved = false;
            for (std::size_t l = 0; l < limbs_.size(); ++l) {
                // Along a chain regions meet in planes and hold little of each other.
                if (!problem_.fit[l] || problem_.attached[l].empty()) continue;
                // Starts stay: where limbs branch, they are to overlap.
                for (const int side : {0, 1, 2, 3, 5}) moved = tryMove(l, side) || moved;
            }
        }
        return std::move(limbs_);
    }

private:
    bool keeps(std::size_t l, std::uint32_t v) const { return mayKeep_[std::size_t(voxels_[v].owner)][l]; }

    bool tryMove(std::size_t l, int side) {
        const auto changed = withSideMoved(limbs_[l], side, problem_.step);
        if (!changed) return false;
        const Limb before = limbs_[l];
        limbs_[l] = *changed;
        const auto regions = restHexahedra(limbs_, problem_.rest);
        std::vector<std::pair<std::size_t, std::uint32_t>> lost;
        std::ptrdiff_t gain = 0;
        bool stays = true;
        for (const int k : {int(l), problem_.previous[l], problem_.next[l]}) {
            if (k < 0) continue;
            for (const std::uint32_t v : held_[std::size_t(k)]) {
                if (regions[std::size_t(k)].holds(voxels_[v].at)) continue;
                lost.emplace_back(std::size_t(k), v);
                gain += voxels_[v].owner == k ? -1 : 1;
                if (keeps(std::size_t(k), v) && --voxels_[v].keepers == 0) {
                    stays = false;
                    break;
                }
            }
            if (!stays) break;
        }
        if (stays && gain > 0) {
            forget(lost);
            return true;
        }
        for (const auto& [k, v] : lost)
            if (keeps(k, v)) ++voxels_[v].keepers;
        limbs_[l] = before;
        return false;
    }

    void forget(const std::vector<std::pair<std::size_t, std::uint32_t>>& lost) {
        std::vector<std::vector<std::uint32_t>> of(limbs_.size());
        for (const auto& [k, v] : lost) of[k].push_back(v);
        for (std::size_t k = 0; k < of.size(); ++k) {
            if (of[k].empty()) continue;
            std::vector<std::uint32_t> rest;
            // Both lists are in ascending order.
            std::set_difference(held_[k].begin(), held_[k].end(), of[k].begin(), of[k].end(), std::back_inserter(rest));
            held_[k] = std::move(rest);
        }
    }

    const FitProblem& problem_;
    std::vector<Limb> limbs_;
    std::vector<RimVoxel> voxels_;
    std::vector<std::vector<std::uint32_t>> held_;  // by each limb's region, ascending
    std::vector<std::vector<bool>> mayKeep_;        // [owner][limb]
};

}  // namespace

std::vector<int> FitProblem::keepersOf(std::size_t l) const {
    std::vector<int> keepers{static_cast<int>(l)};
    for (const int k : {previous[l], next[l]})
        if (k >= 0) keepers.push_back(k);
    keepers.insert(keepers.end(), attached[l].begin(), attached[l].end());
    return keepers;
}

std::vector<Limb> trimmed(std::vector<Limb> limbs, const FitProblem& problem) {
    return Trim(std::move(limbs), problem).run();
}

}  // namespace voledit
