#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/rigging/body_shape.h"
#include "core/rigging/limb_boxes.h"
#include "core/rigging/rest_hexahedra.h"
#include "core/rigging/rig.h"

namespace voledit {

namespace {

/// Boxes that grow until the regions between them hold all rims: regions are not boxes, since at every connected joint
/// the corners of two are averaged, so what sticks out is found with the regions themselves.
class BoxFit {
public:
    BoxFit(const std::vector<PosedJoint>& rest, std::vector<Limb>& limbs, const std::vector<bool>& fit, double step)
        : rest_(rest), limbs_(limbs), fit_(fit), step_(step), next_(limbs.size(), -1), previous_(limbs.size(), -1) {
        for (std::size_t l = 0; l < limbs.size(); ++l) {
            next_[l] = continuationOf(limbs, rest, static_cast<int>(l), {});
            if (next_[l] >= 0) previous_[std::size_t(next_[l])] = static_cast<int>(l);
        }
    }

    bool fits(std::size_t l) const { return fit_.empty() || fit_[l]; }

    /// Grows the boxes round by round; each voxel of a rim is to lie in its own limb's region or in one connected to
    /// it.
    void grow(const std::vector<std::vector<Vec3>>& rims) {
        constexpr int kMostRounds = 40;
        for (int round = 0; round < kMostRounds; ++round) {
            hexahedra_ = restHexahedra(limbs_, rest_);
            growth_.assign(limbs_.size(), {});
            for (std::size_t l = 0; l < limbs_.size(); ++l)
                for (const Vec3& p : rims[l]) demand(l, p);
            if (!applyGrowth()) return;
        }
    }

private:
    /// How far each side is to move out: low and high x, low and high y, start, end.
    using Sides = std::array<double, 6>;

    struct Excess {
        double total = kInfinity;
        Vec3 local{0}, world{0};  // world: how far out along u, v and w
    };

    Excess excessOf(int limb, const Vec3& p) const {
        Excess e;
        e.local = hexahedra_[std::size_t(limb)].local(p);
        if (!isDefined(e.local)) return e;
        const Mat3& edges = hexahedra_[std::size_t(limb)].middleEdges();
        const Vec3 out = glm::max(Vec3(0), glm::max(-e.local, e.local - 1.0));
        e.world = {out.x * glm::length(edges[0]), out.y * glm::length(edges[1]), out.z * glm::length(edges[2])};
        // Past a face that it shares, a limb cannot grow: there the other one is.
        const bool blocked =
            (e.local.z < 0 && previous_[std::size_t(limb)] >= 0) || (e.local.z > 1 && next_[std::size_t(limb)] >= 0);
        e.total = e.world.x + e.world.y + e.world.z + (blocked ? 1e3 * step_ + 10 * e.world.z : 0);
        return e;
    }

    void demand(std::size_t owner, const Vec3& p) {
        int best = -1;
        Excess least;
        for (const int l : {int(owner), previous_[owner], next_[owner]}) {
            if (l < 0) continue;
            const Excess e = excessOf(l, p);
            if (e.total <= 1e-9 * step_) return;
            if (e.total < least.total && fits(std::size_t(l))) {
                least = e;
                best = l;
            }
        }
        if (best >= 0) note(std::size_t(best), least);
    }

    void note(std::size_t l, const Excess& e) {
        // The grid of a region may be turned by quarters against the bone frame.
        const Mat3 frame = boneFrame(directionOf(limbs_[l], rest_), limbs_[l].roll);
        for (int a = 0; a < 2; ++a) {
            if (e.world[a] <= 0) continue;
            const Vec3 edge = glm::transpose(frame) * hexahedra_[l].middleEdges()[a];
            const int axis = std::abs(edge.x) > std::abs(edge.y) ? 0 : 1;
            const bool high = (e.local[a] > 1) == (edge[axis] > 0);
            raise(growth_[l][std::size_t(2 * axis + (high ? 1 : 0))], e.world[a]);
        }
        if (e.world.z > 0 && e.local.z < 0 && previous_[l] < 0) raise(growth_[l][4], e.world.z);
        if (e.world.z > 0 && e.local.z > 1 && next_[l] < 0) raise(growth_[l][5], e.world.z);
    }
    void raise(double& side, double by) const { side = std::max(side, std::min(by, step_)); }

    bool applyGrowth() {
        bool grown = false;
        for (std::size_t l = 0; l < limbs_.size(); ++l) {
            const Sides& g = growth_[l];
            Limb& limb = limbs_[l];
            limb.size += Vec2(g[0] + g[1], g[2] + g[3]);
            limb.offset += 0.5 * Vec2(g[1] - g[0], g[3] - g[2]);
            limb.pad += Vec2(g[4], g[5]);
            for (const double side : g) grown = grown || side > 0;
        }
        return grown;
    }

    const std::vector<PosedJoint>& rest_;
    std::vector<Limb>& limbs_;
    const std::vector<bool>& fit_;
    double step_;
    std::vector<int> next_, previous_;
    std::vector<RestHexahedron> hexahedra_;
    std::vector<Sides> growth_;
};

}  // namespace

std::vector<Limb> fittedLimbs(const OpaqueVoxels& voxels, const std::vector<PosedJoint>& rest, std::vector<Limb> limbs,
                              const std::vector<bool>& fit, const RigOptions& options) {
    const OpaqueVoxels solid = withoutCavities(voxels);
    const auto rims = rimsOf(solid, limbParts(solid, distanceField(solid), limbs, rest), limbs.size());
    const double step = std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z});
    BoxFit boxes(rest, limbs, fit, step);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!boxes.fits(l)) continue;
        LimbExtents extents = extentsOf(limbs[l], rest, rims[l]);
        if (extents.empty()) extents = {Vec3(0), Vec3(0)};
        limbs[l] = boxed(limbs[l], rest, extents, 1e-3 * step);
    }
    boxes.grow(rims);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!boxes.fits(l)) continue;
        limbs[l].size += 2 * options.margin * step;
        limbs[l].pad += options.margin * step;
    }
    return limbs;
}

}  // namespace voledit
