#include "app/editor/panels/gradient_statistics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/box3.h"

namespace voledit {

namespace {

constexpr double kVoxels = 40000;  // at most about so many are looked at
constexpr std::size_t kBins = 128;

// World positions of every n-th voxel along each axis.
std::vector<Vec3> lookedAt(const VolumeGrid& grid) {
    const int stride = std::max(1, int(std::ceil(std::cbrt(double(grid.sampleCount()) / kVoxels))));
    std::vector<Vec3> p;
    for (int k = stride / 2; k < grid.size.z; k += stride)
        for (int j = stride / 2; j < grid.size.y; j += stride)
            for (int i = stride / 2; i < grid.size.x; i += stride)
                p.push_back(transformPoint(grid.worldFromIndex, Vec3(i, j, k)));
    return p;
}

}  // namespace

VolumeStatistics gradientStatistics(const Volume& volume) {
    const std::vector<Vec3> p = lookedAt(volume.grid());
    std::vector<Vec3> gradients(p.size());
    volume.gradient(p, gradients);
    std::vector<double> steepness;
    for (const Vec3& g : gradients)
        if (const double length = glm::length(g); std::isfinite(length)) steepness.push_back(length);
    VolumeStatistics statistics;
    statistics.histogram.assign(kBins, 0);
    statistics.max = 1;
    if (steepness.empty()) return statistics;
    std::sort(steepness.begin(), steepness.end());
    if (const double most = steepness[std::size_t(0.999 * double(steepness.size() - 1))]; most > 0)
        statistics.max = most;
    for (const double s : steepness)
        if (s <= statistics.max)
            ++statistics.histogram[std::min(kBins - 1, std::size_t(s / statistics.max * double(kBins)))];
    return statistics;
}

}  // namespace voledit
