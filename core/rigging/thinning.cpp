// Distance-field thinning [Gagvani, Silver 1999: Parameter-controlled volume thinning] and snapping to what it keeps.

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/rigging/curve_skeleton.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

double cellSize(const OpaqueVoxels& voxels) {
    return std::min({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z});
}

/// Mean distance of the 26 neighbours; beyond the grid it is 0.
double meanAround(const OpaqueVoxels& voxels, const std::vector<float>& distance,
                  const std::vector<NeighbourStep>& steps, const Index3& c) {
    const auto i = std::ptrdiff_t(voxels.indexOf(c));
    double sum = 0;
    for (const NeighbourStep& s : steps)
        if (isInside(voxels, c + s.by)) sum += double(distance[std::size_t(i + s.offset)]);
    return sum / double(steps.size());
}

}  // namespace

std::vector<Index3> thinned(const OpaqueVoxels& voxels, const std::vector<float>& distance, double thinness) {
    const double least = thinness * cellSize(voxels);
    const auto steps = neighbourSteps(voxels);
    std::vector<std::vector<Index3>> slices(std::size_t(voxels.size.z));
    parallelFor(slices.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (Index3 c(0, 0, int(begin)); c.z < int(end); ++c.z)
            for (c.y = 0; c.y < voxels.size.y; ++c.y)
                for (c.x = 0; c.x < voxels.size.x; ++c.x) {
                    const std::size_t i = voxels.indexOf(c);
                    if (voxels.opaque[i] && double(distance[i]) - meanAround(voxels, distance, steps, c) > least)
                        slices[std::size_t(c.z)].push_back(c);
                }
    });
    std::vector<Index3> kept;
    for (const auto& slice : slices) kept.insert(kept.end(), slice.begin(), slice.end());
    return kept;
}

Vec3 snappedToMedialAxis(const OpaqueVoxels& voxels, const std::vector<float>& distance, const Vec3& p, double reach) {
    // Towards the axis the distance rises by nearly as much as one steps; along it, by less.
    constexpr double kSteep = 0.4;
    Index3 c = cellAt(voxels, p);
    if (!isInside(voxels, c) || !voxels.opaque[voxels.indexOf(c)]) return p;
    const auto steps = neighbourSteps(voxels);
    const auto at = [&](const Index3& cell) { return double(distance[voxels.indexOf(cell)]); };
    for (bool moved = true; moved;) {
        moved = false;
        Index3 next = c;
        double steepest = kSteep;
        for (const NeighbourStep& s : steps) {
            const Index3 n = c + s.by;
            if (!isInside(voxels, n) || glm::length(voxels.centre(n) - p) > reach) continue;
            if (const double slope = (at(n) - at(c)) / s.length; slope > steepest) {
                steepest = slope;
                next = n;
                moved = true;
            }
        }
        c = next;
    }
    // Between two cells that are as deep, the axis runs in their middle.
    Vec3 sum = voxels.centre(c);
    double count = 1;
    for (const NeighbourStep& s : steps)
        if (isInside(voxels, c + s.by) && at(c + s.by) > at(c) - 0.1 * cellSize(voxels)) {
            sum += voxels.centre(c + s.by);
            ++count;
        }
    return sum / count;
}

}  // namespace voledit
