#pragma once
// What of a distant light comes to each point of an opacity grid.

#include <cstdint>
#include <vector>

#include "core/objects/opacity_grid.h"

namespace voledit {

/// What is left of parallel light, all over an OpacityGrid. The planes of cells that it crosses most steeply are
/// followed from its side on, each ray of light through all of them: what it lost is known where it crosses each plane,
/// and linear between four rays and two planes, so nothing is blurred more the farther it went. Immutable.
class ShadowVolume {
public:
    /// Light comes from direction `toward` (unit). In parallel.
    ShadowVolume(const OpacityGrid& grid, const Vec3f& toward);

    /// 0 … 1 at a point of the grid, or up to a cell and a half outside of it.
    float at(const Vec3f& at) const;
    /// How far outside of the grid there are rays, cells.
    static constexpr int kMargin = 5;

    /// Coordinates of rays and planes of a point of the grid: ray (i, j) crosses plane k at (i, j, k) + 0.5. The first
    /// two repeat with the sizes: rays that leave the grid on one side are others on the opposite side.
    const Mat4f& raysFromGrid() const { return raysFromGrid_; }
    Index3 size() const { return size_; }  // rays, rays, planes
    /// What is left · 65535, the first coordinate fastest.
    const std::vector<std::uint16_t>& left() const { return left_; }

private:
    Index3 size_{0};
    Mat4f raysFromGrid_{1};
    std::vector<std::uint16_t> left_;
};

}  // namespace voledit
