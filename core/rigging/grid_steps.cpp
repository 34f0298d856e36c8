#include "core/rigging/grid_steps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voledit {

std::vector<NeighbourStep> neighbourSteps(const OpaqueVoxels& voxels) {
    std::vector<NeighbourStep> steps;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                if (x == 0 && y == 0 && z == 0) continue;
                const Index3 by(x, y, z);
                const std::ptrdiff_t offset =
                    x + std::ptrdiff_t(voxels.size.x) * (y + std::ptrdiff_t(voxels.size.y) * z);
                steps.push_back({by, offset, glm::length(Vec3(by) * voxels.spacing)});
            }
    std::stable_sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.length < b.length; });
    return steps;
}

Index3 cellAt(const OpaqueVoxels& voxels, const Vec3& p) {
    // Kept within what an int holds, for points from anywhere.
    const Vec3 c = glm::clamp(glm::floor((p - voxels.origin) / voxels.spacing + 0.5), Vec3(-1e9), Vec3(1e9));
    return Index3(c);
}

double distanceAt(const OpaqueVoxels& voxels, const std::vector<float>& distance, const Vec3& p) {
    const Vec3 at = glm::clamp((p - voxels.origin) / voxels.spacing, Vec3(0), Vec3(voxels.size - 1));
    const Index3 low(at);
    const Vec3 w = at - Vec3(low);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Index3 bit(corner & 1, corner >> 1 & 1, corner >> 2);
        const Vec3 part = glm::mix(1.0 - w, w, Vec3(bit));
        const Index3 c = glm::min(low + bit, voxels.size - 1);
        sum += part.x * part.y * part.z * double(distance[voxels.indexOf(c)]);
    }
    return sum;
}

}  // namespace voledit
