#pragma once
// Jacobians of limb regions at their vertices. Of use to limb_regions.cpp only.

#include <cstdint>
#include <span>
#include <vector>

#include "core/skeleton/limb_interior.h"

namespace voledit {

/// For each limb the first vertex of each of its layers across the bone, cells.z + 1 of them; two limbs that share a
/// face name the same vertices.
using LimbLayers = std::vector<std::vector<std::uint32_t>>;

/// dq/dp at every vertex, by differences along the grid's lines: central inside a limb, one-sided on its outer faces;
/// at a face that limbs share the mean of both sides weighted by the cells' volumes. I − (du/dp) with u = p − q: the
/// identity to the bit where nothing moved. Bounded where a region is nearly flat; vertices of no layer have the
/// identity.
std::vector<Mat3> limbJacobians(std::span<const Vec3> deformed, std::span<const Vec3> source, const LimbGrid& grid,
                                const LimbLayers& layers);

}  // namespace voledit
