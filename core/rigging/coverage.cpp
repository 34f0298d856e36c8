#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "core/base/parallel.h"
#include "core/rigging/rig.h"

namespace voledit {

namespace {

/// The plane in which a limb meets the one that continues it: points on it are of both, and count once.
struct SharedPlane {
    int next = -1;  // limb that begins there; -1: none does
    Vec3 point{0}, normal{0};
};

Vec3 directionOf(const Limb& limb, const std::vector<PosedJoint>& rest) {
    return glm::normalize(rest[std::size_t(limb.to)].position - rest[std::size_t(limb.from)].position);
}

SharedPlane sharedPlane(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, int limb,
                        const std::vector<bool>& disjoint) {
    const int next = continuationOf(limbs, rest, limb, disjoint);
    if (next < 0) return {};
    const Vec3 normal = directionOf(limbs[std::size_t(limb)], rest) + directionOf(limbs[std::size_t(next)], rest);
    if (glm::length(normal) < 1e-9) return {};
    return {next, rest[std::size_t(limbs[std::size_t(limb)].to)].position, glm::normalize(normal)};
}

/// Tells which limbs' regions at rest hold a point.
class RegionTest {
public:
    RegionTest(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, const RegionOptions& options) {
        const LimbRegions regions = limbRegions(limbs, rest, rest, options);
        // One limb a set of cells: in one set for all, a point that two limbs hold would be found once, since at rest
        // both map it to the same source point.
        for (int l = 0; l < static_cast<int>(limbs.size()); ++l) {
            cells_.push_back(std::make_unique<MappedCells>(cellsOf(regions, {l})));
            planes_.push_back(sharedPlane(limbs, rest, l, options.disjoint));
        }
    }

    /// Limbs whose boxes meet the row of cells along x through `start`.
    std::vector<int> nearRow(const Vec3& start, double length) const {
        std::vector<int> near;
        for (std::size_t l = 0; l < cells_.size(); ++l) {
            const Box3& box = cells_[l]->bounds();
            const double t = cells_[l]->thickness();
            if (start.y >= box.min.y - t && start.y <= box.max.y + t && start.z >= box.min.z - t &&
                start.z <= box.max.z + t && start.x <= box.max.x + t && start.x + length >= box.min.x - t)
                near.push_back(static_cast<int>(l));
        }
        return near;
    }

    /// Those of `near` that hold p; `hints` (one for each limb) speeds up points that follow one another.
    void holders(const Vec3& p, const std::vector<int>& near, std::vector<std::uint32_t>& hints,
                 std::vector<int>& found) const {
        found.clear();
        CellLocation at;
        for (const int l : near)
            if (cells_[std::size_t(l)]->locateNear(p, hints[std::size_t(l)], at)) found.push_back(l);
        if (found.size() < 2) return;
        std::erase_if(found, [&](int l) {
            return std::any_of(found.begin(), found.end(), [&](int before) {
                const SharedPlane& plane = planes_[std::size_t(before)];
                return plane.next == l &&
                       std::abs(glm::dot(p - plane.point, plane.normal)) <= 4 * cells_[std::size_t(l)]->thickness();
            });
        });
    }

private:
    std::vector<std::unique_ptr<MappedCells>> cells_;
    std::vector<SharedPlane> planes_;
};

/// The slice z of the grid: its voxels' counts go into `coverage.regions`, each limb's into `ofLimb`.
void coverSlice(const OpaqueVoxels& voxels, const RegionTest& test, int z, Coverage& coverage,
                std::vector<std::size_t>& ofLimb) {
    std::vector<std::uint32_t> hints(ofLimb.size(), 0);
    std::vector<int> found;
    for (int y = 0; y < voxels.size.y; ++y) {
        const auto near = test.nearRow(voxels.centre({0, y, z}), voxels.spacing.x * (voxels.size.x - 1));
        for (int x = 0; x < voxels.size.x; ++x) {
            const std::size_t i = voxels.indexOf({x, y, z});
            if (!voxels.opaque[i]) continue;
            test.holders(voxels.centre({x, y, z}), near, hints, found);
            coverage.regions[i] = static_cast<std::uint8_t>(std::min<std::size_t>(found.size(), 255));
            for (const int l : found) ++ofLimb[std::size_t(l)];
        }
    }
}

}  // namespace

Coverage coverageOf(const OpaqueVoxels& voxels, const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                    const RegionOptions& options) {
    Coverage coverage;
    coverage.regions.assign(voxels.opaque.size(), 0);
    coverage.ofLimb.assign(limbs.size(), 0);
    const RegionTest test(limbs, rest, options);
    std::vector<std::vector<std::size_t>> ofLimb(std::size_t(voxels.size.z), coverage.ofLimb);
    parallelFor(std::size_t(voxels.size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z) coverSlice(voxels, test, static_cast<int>(z), coverage, ofLimb[z]);
    });
    for (const auto& slice : ofLimb)
        for (std::size_t l = 0; l < slice.size(); ++l) coverage.ofLimb[l] += slice[l];
    for (std::size_t i = 0; i < voxels.opaque.size(); ++i) {
        if (!voxels.opaque[i]) continue;
        ++coverage.opaque;
        if (coverage.regions[i] == 0) ++coverage.uncovered;
        if (coverage.regions[i] > 1) ++coverage.doubly;
    }
    return coverage;
}

}  // namespace voledit
