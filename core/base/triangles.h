#pragma once
// Which boxes of many meet, and whether two triangles touch.

#include <cstdint>
#include <functional>
#include <span>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

/// Calls met(a, b) for pairs of boxes that meet (closed boxes), each pair once, until it gives true; gives whether it
/// did. By a tree of boxes: n log n for boxes that mostly lie apart.
bool anyPairOfBoxes(std::span<const Box3> boxes, const std::function<bool(std::uint32_t, std::uint32_t)>& met);

/// True if the closed triangles come within about `tolerance` of each other; one may be flattened to an edge. By
/// separating axes: the normals, the edges' cross products, and the edges' normals in each plane.
bool trianglesTouch(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance);

}  // namespace voledit
