#pragma once
// The scalar of one volume under a map of cells, voxelised tetrahedron by tetrahedron.

#include <functional>

#include "core/eval/scalar_chain.h"
#include "core/eval/voxelise.h"

namespace voledit {

/// The general way: value[i] of the root's scalar at world point p[i], the request's fill where there is none.
using ScalarsAt = std::function<void(std::span<const Vec3> p, std::span<double> value)>;

/// Whether `voxeliseChain` takes it: integers of 8 or 16 bits in the volume's own type, from volumes of usual sizes.
bool mayVoxeliseChain(const ScalarChain& chain, const VoxeliseRequest& request);

/// What `scalarsAt` gives on the request's grid, to the bit, at twenty times its speed: rows of voxels are cut by the
/// tetrahedra; along a piece the samples' places step evenly. `scalarsAt` is asked where rounding leaves a doubt, and
/// in cells that overlap others. Throws Cancelled.
std::shared_ptr<const Volume> voxeliseChain(const ScalarChain& chain, const VoxeliseRequest& request,
                                            const ScalarsAt& scalarsAt, Progress* progress);

}  // namespace voledit
