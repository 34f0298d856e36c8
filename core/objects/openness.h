#pragma once
// How open what stands around a point leaves it to light from everywhere: ambient occlusion, on a regular grid.

#include <array>
#include <cstdint>
#include <vector>

#include "core/objects/opacity_grid.h"

namespace voledit {

/// Directions from a point, each with its opposite: the corners of an icosahedron and of a dodecahedron.
inline constexpr int kOpennessDirections = 32;
const std::array<Vec3f, kOpennessDirections>& opennessDirections();
/// Directions flatter over a surface than this cosine do not count: what is wide would meet the surface itself.
inline constexpr float kFlattestOpenness = 0.3F;

/// A stretch of the way in one direction; lengths in spacings of the opacity grid.
struct OpennessStretch {
    float middle, length;
    int level;     // of the opacity grid's means
    float counts;  // what stands here, less with distance
};
inline constexpr int kOpennessStretches = 5;
/// Stretches up to `radius`.
std::array<OpennessStretch, kOpennessStretches> opennessStretches(float radius);

/// Openness at the nodes of a grid of twice the opacity's spacing, near what is visible. Nodes within what is opaque
/// count little where others are near, so that walls do not darken what stands in front of them, nor let through what
/// is behind. Immutable. "Grid" is that of the opacity.
class Openness {
public:
    /// Surroundings up to `radius` (> 0) spacings occlude. In parallel.
    Openness(const OpacityGrid& grid, float radius);

    /// 0 (closed) … 1 (open) at a point of the grid.
    float at(const Vec3f& at) const;

    /// Node (i, j, k) lies at 2 (i, j, k) + 1; all of the same weight but for what is opaque there.
    Index3 size() const { return size_; }
    /// Of each node, x fastest, its openness times its weight, and its weight, · 65535. Both are linear in between.
    const std::vector<std::uint16_t>& nodes() const { return nodes_; }

private:
    Index3 size_;
    std::vector<std::uint16_t> nodes_;
};

/// Outwards from what is opaque around a point of the grid: longer, up to 1, the clearer there is a side.
Vec3f outwardOf(const OpacityGrid& grid, const Vec3f& at);
/// The side that surfaces face which look up a node there: outwards from what lies below it. Amid a corner's walls it
/// is that of the nearest, as it is for points of either wall.
Vec3f opennessSide(const OpacityGrid& grid, const Vec3f& node);

}  // namespace voledit
