#pragma once
// Walking over a grid of cells: neighbours, positions, values between cells.

#include <vector>

#include "core/rigging/opaque_voxels.h"

namespace voledit {

struct NeighbourStep {
    Index3 by{0};
    std::ptrdiff_t offset = 0;  // in indices
    double length = 0;          // world units
};

/// The 26 steps to a cell's neighbours, the shortest first.
std::vector<NeighbourStep> neighbourSteps(const OpaqueVoxels& voxels);

inline bool isInside(const OpaqueVoxels& voxels, const Index3& c) {
    return c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < voxels.size.x && c.y < voxels.size.y && c.z < voxels.size.z;
}
/// The cell with that index.
inline Index3 cellOf(const OpaqueVoxels& voxels, std::size_t index) {
    const auto nx = std::size_t(voxels.size.x), ny = std::size_t(voxels.size.y);
    return {int(index % nx), int(index / nx % ny), int(index / (nx * ny))};
}
/// The cell that p lies in, which may be outside the grid.
Index3 cellAt(const OpaqueVoxels& voxels, const Vec3& p);

/// The values of a distance field between cells, trilinear; outside the grid those of the nearest cell of it.
double distanceAt(const OpaqueVoxels& voxels, const std::vector<float>& distance, const Vec3& p);

}  // namespace voledit
