#pragma once
// Sampling a scene's root on a regular grid.

#include <memory>

#include "core/base/progress.h"
#include "core/scene/compile.h"

namespace voledit {

enum class VoxeliseWhat : std::uint8_t { Scalar, Opacity, Rgba, Displacement };

struct VoxeliseRequest {
    VolumeGrid grid;  // channels are set by `what`
    VoxeliseWhat what = VoxeliseWhat::Rgba;
    VoxelType type = VoxelType::Float;
    double fill = 0;  // of a scalar where it is undefined or outside
};

/// One value a sample (scalar, opacity), four (rgba; black where opacity is 0) or three (displacement: Ψ(p) − p of the
/// outermost transfer's whole list, NaN where undefined). Scalar takes the pre-image of the largest opacity, the first
/// cell on a tie (definitions.md §6). Integers are rounded to nearest and clamped to the type. In parallel, a slab at a
/// time. Throws Cancelled, and Error where the root is not one volume or mesh, deformed or recoloured (scalar), or no
/// transfer (displacement).
std::shared_ptr<const Volume> voxelise(const CompiledScene& scene, const VoxeliseRequest& request,
                                       Progress* progress = nullptr);

/// Grid of `size` cells over `bounds`, sampled at their centres.
VolumeGrid cellCentredGrid(const Box3& bounds, Index3 size, int channels);

}  // namespace voledit
