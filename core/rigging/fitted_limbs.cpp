#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/rigging/body_shape.h"
#include "core/rigging/box_trim.h"
#include "core/rigging/grid_steps.h"
#include "core/rigging/limb_boxes.h"
#include "core/rigging/rest_hexahedra.h"
#include "core/rigging/rig.h"

namespace voledit {

namespace {

/// How far, in sides of its section, the broadest of the limbs that begin at a joint reaches back beyond it, under the
/// others: the trunk under the thighs, so that flesh is there where a thigh that swings has left.
constexpr double kUnder = 0.04;

/// Boxes that grow until the regions between them hold all rims: regions are not boxes, since at every connected joint
/// the corners of two are averaged, so what sticks out is found with the regions themselves.
class Growth {
public:
    Growth(std::vector<Limb> limbs, const FitProblem& problem) : problem_(problem), limbs_(std::move(limbs)) {}

    /// Grows the boxes round by round; each voxel of a rim is to lie in its own limb's region or in one that touches
    /// it.
    std::vector<Limb> run() {
        constexpr int kMostRounds = 80;
        for (int round = 0; round < kMostRounds; ++round) {
            hexahedra_ = restHexahedra(limbs_, problem_.rest);
            growth_.assign(limbs_.size(), {});
            for (std::size_t l = 0; l < limbs_.size(); ++l)
                for (const Vec3& p : problem_.rims[l]) demand(l, p);
            if (!applyGrowth()) break;
        }
        return std::move(limbs_);
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
        const bool blocked = (e.local.z < 0 && problem_.previous[std::size_t(limb)] >= 0) ||
                             (e.local.z > 1 && problem_.next[std::size_t(limb)] >= 0);
        e.total = e.world.x + e.world.y + e.world.z + (blocked ? 1e3 * problem_.step + 10 * e.world.z : 0);
        return e;
    }

    void demand(std::size_t owner, const Vec3& p) {
        int best = -1;
        Excess least;
        for (const int l : {int(owner), problem_.previous[owner], problem_.next[owner]}) {
            if (l < 0) continue;
            const Excess e = excessOf(l, p);
            if (e.total <= 1e-9 * problem_.step) return;
            if (e.total < least.total && problem_.fit[std::size_t(l)]) {
                least = e;
                best = l;
            }
        }
        // Where limbs branch, one may hold what is another's.
        for (const int l : problem_.attached[owner])
            if (excessOf(l, p).total <= 1e-9 * problem_.step) return;
        if (best >= 0) note(std::size_t(best), least);
    }

    /// A section's corner moves with the limb's own box and, next to a connected end, with its neighbour's: the growth
    /// asked for is the least in sum of squares over the three boxes that brings the point in.
    void note(std::size_t l, const Excess& e) {
        const double w = std::clamp(e.local.z, 0.0, 1.0);
        const int before = problem_.previous[l], after = problem_.next[l];
        const double ofBefore = before >= 0 && problem_.fit[std::size_t(before)] ? 0.5 * (1 - w) : 0;
        const double ofAfter = after >= 0 && problem_.fit[std::size_t(after)] ? 0.5 * w : 0;
        const double own = (1 - w) * (before >= 0 ? 0.5 : 1) + w * (after >= 0 ? 0.5 : 1);
        const double norm = own * own + ofBefore * ofBefore + ofAfter * ofAfter;
        for (int a = 0; a < 2; ++a) {
            if (e.world[a] <= 0) continue;
            const Vec3 outward = (e.local[a] > 1 ? 1.0 : -1.0) * glm::normalize(hexahedra_[l].middleEdges()[a]);
            raise(l, outward, own / norm * e.world[a]);
            if (ofBefore > 0) raise(std::size_t(before), outward, ofBefore / norm * e.world[a]);
            if (ofAfter > 0) raise(std::size_t(after), outward, ofAfter / norm * e.world[a]);
        }
        if (e.world.z > 0 && e.local.z < 0 && before < 0) raise(growth_[l][4], e.world.z);
        if (e.world.z > 0 && e.local.z > 1 && after < 0) raise(growth_[l][5], e.world.z);
    }
    /// The side of limb l's box that looks most along `outward`.
    void raise(std::size_t l, const Vec3& outward, double by) {
        const Vec3 d = glm::transpose(boneFrame(directionOf(limbs_[l], problem_.rest), limbs_[l].roll)) * outward;
        const int axis = std::abs(d.x) > std::abs(d.y) ? 0 : 1;
        raise(growth_[l][std::size_t(2 * axis + (d[axis] > 0 ? 1 : 0))], by);
    }
    void raise(double& side, double by) const { side = std::max(side, std::min(by, 0.5 * problem_.step)); }

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

    const FitProblem& problem_;
    std::vector<Limb> limbs_;
    std::vector<RestHexahedron> hexahedra_;
    std::vector<Sides> growth_;
};

/// For each limb in whose bone's start no other limb ends or begins, the limb that it begins in; −1 else.
std::vector<int> basesOf(const OpaqueVoxels& voxels, const std::vector<std::int16_t>& parts,
                         const std::vector<PosedJoint>& rest, const std::vector<Limb>& limbs) {
    std::vector<int> bases(limbs.size(), -1);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const bool isLoose = std::none_of(limbs.begin(), limbs.end(), [&](const Limb& other) {
            return other.to == limbs[l].from || (&other != &limbs[l] && other.from == limbs[l].from);
        });
        const Index3 c = cellAt(voxels, rest[std::size_t(limbs[l].from)].position);
        if (isLoose && isInside(voxels, c)) bases[l] = parts[voxels.indexOf(c)];
        if (bases[l] == int(l)) bases[l] = -1;
    }
    return bases;
}

/// Whether other limbs begin where this one does, all with smaller sections.
bool isBroadest(const std::vector<Limb>& limbs, std::size_t l) {
    bool isHub = false;
    for (std::size_t k = 0; k < limbs.size(); ++k) {
        if (k == l || limbs[k].from != limbs[l].from) continue;
        isHub = true;
        if (limbs[k].size.x * limbs[k].size.y > limbs[l].size.x * limbs[l].size.y) return false;
    }
    return isHub;
}

/// Moves voxels along chains to the limb between whose end planes they lie, since only that one's region can hold them:
/// what climbs to the middle of a bulge may have come to a limb farther on.
void moveBetweenPlanes(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const FitProblem& problem,
                       std::vector<std::int16_t>& parts) {
    const std::size_t n = limbs.size();
    std::vector<Vec3> direction, end, normal(n, Vec3(0));  // normal: of the plane shared with the next limb
    for (std::size_t l = 0; l < n; ++l) {
        direction.push_back(directionOf(limbs[l], problem.rest));
        end.push_back(problem.rest[std::size_t(limbs[l].to)].position);
    }
    for (std::size_t l = 0; l < n; ++l)
        if (problem.next[l] >= 0) normal[l] = direction[l] + direction[std::size_t(problem.next[l])];
    const auto isPast = [&](int l, const Vec3& p) {
        return problem.next[std::size_t(l)] >= 0 && glm::dot(p - end[std::size_t(l)], normal[std::size_t(l)]) > 0;
    };
    parallelFor(parts.size(), 1 << 14, [&](std::size_t begin, std::size_t count) {
        for (std::size_t i = begin; i < count; ++i) {
            if (parts[i] == kNoLimb) continue;
            const Vec3 p = voxels.centre(cellOf(voxels, i));
            int l = parts[i];
            const bool forward = isPast(l, p);
            for (std::size_t steps = 0; steps < n; ++steps) {
                const int before = problem.previous[std::size_t(l)];
                if (forward && isPast(l, p))
                    l = problem.next[std::size_t(l)];
                else if (!forward && before >= 0 && !isPast(before, p))
                    l = before;
                else
                    break;
            }
            parts[i] = static_cast<std::int16_t>(l);
        }
    });
}

FitProblem problemOf(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, const std::vector<int>& bases,
                     double step) {
    const std::size_t n = limbs.size();
    FitProblem problem{rest, std::vector<bool>(n, true), std::vector<int>(n, -1), std::vector<int>(n, -1), {}, {},
                       step};
    problem.attached.resize(n);
    for (std::size_t l = 0; l < n; ++l) {
        problem.next[l] = continuationOf(limbs, rest, static_cast<int>(l), {});
        if (problem.next[l] >= 0) problem.previous[std::size_t(problem.next[l])] = static_cast<int>(l);
    }
    for (std::size_t l = 0; l < n; ++l)
        for (std::size_t k = 0; k < n; ++k) {
            const bool touch = limbs[k].from == limbs[l].from || limbs[k].to == limbs[l].from ||
                               limbs[k].from == limbs[l].to || bases[l] == int(k) || bases[k] == int(l);
            if (k != l && touch && problem.next[l] != int(k) && problem.previous[l] != int(k))
                problem.attached[l].push_back(static_cast<int>(k));
        }
    return problem;
}

/// Where limbs overlap about a hub they move as one, the more softly the more they overlap, and the faces that cross
/// should do so outside the flesh: these regions reach farther than their voxels, by parts of their sections.
void widenHubs(std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, const std::vector<bool>& fit) {
    constexpr double kHub = 0.3, kNext = 0.18;
    const std::vector<HubRole> roles = hubRoles(limbs, rest, {});
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!fit[l] || roles[l] == HubRole::None) continue;
        const double width = std::min(limbs[l].size.x, limbs[l].size.y);
        if (roles[l] == HubRole::Rooted) limbs[l].pad.x += kHub / 2 * width;
        limbs[l].size += (roles[l] == HubRole::Next ? kNext : kHub) * width;
    }
}

}  // namespace

std::vector<Limb> fittedLimbs(const OpaqueVoxels& voxels, const std::vector<PosedJoint>& rest, std::vector<Limb> limbs,
                              const std::vector<bool>& fit, const RigOptions& options) {
    const OpaqueVoxels solid = withoutCavities(voxels);
    auto parts = limbParts(solid, distanceField(solid), limbs, rest);
    const double step = std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z});
    FitProblem problem = problemOf(limbs, rest, basesOf(solid, parts, rest, limbs), step);
    if (!fit.empty()) problem.fit = fit;
    moveBetweenPlanes(solid, limbs, problem, parts);
    problem.rims = rimsOf(solid, parts, limbs.size());
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!problem.fit[l]) continue;
        LimbExtents extents = extentsOf(limbs[l], rest, problem.rims[l]);
        if (extents.empty()) extents = {Vec3(0), Vec3(0)};
        limbs[l] = boxed(limbs[l], rest, extents, 1e-3 * step);
    }
    limbs = trimmed(Growth(std::move(limbs), problem).run(), problem);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!problem.fit[l]) continue;
        limbs[l].size += 2 * options.margin * step;
        limbs[l].pad += options.margin * step;
        if (isBroadest(limbs, l)) limbs[l].pad.x += kUnder * std::sqrt(limbs[l].size.x * limbs[l].size.y);
    }
    widenHubs(limbs, rest, problem.fit);
    return limbs;
}

}  // namespace voledit
