#pragma once
// The CPU ray-caster: plain and right, the oracle of every other renderer.

#include "core/base/picture.h"
#include "core/base/progress.h"
#include "core/scene/compile.h"

namespace voledit {

/// What a ray did; summed over a picture.
struct RayStatistics {
    std::uint64_t samples = 0;
};

/// Draws `scene` from `scene.camera` in a picture of `size` pixels: per pixel centre,
/// L = ∫ C τ exp(−∫τ) ds + T·background with τ = −ln(1 − min(O, 0.9999)) / ℓ (definitions.md §2), by the midpoint rule
/// with steps of `scene.stepLength()` within the root's bounds. In parallel. Throws Cancelled.
Picture castRays(const CompiledScene& scene, Index2 size, RayStatistics* statistics = nullptr,
                 Progress* progress = nullptr);

/// Casts the pixels from `first` up to but without `end` only, into `picture` (already of its size), in the calling
/// thread: a caller may spread a picture over several frames and threads.
void castPixels(const CompiledScene& scene, Picture& picture, Index2 first, Index2 end, RayStatistics* statistics);

}  // namespace voledit
