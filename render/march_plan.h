#pragma once
// Terms that fragments walk through ray by ray, instead of being cut into slices.

#include <memory>
#include <optional>
#include <vector>

#include "core/objects/term.h"
#include "core/scene/compile.h"

namespace voledit {

/// One volume, moved affinely; under one map of cells, which is baked (core/eval/baked_map.h), and affine ones about
/// it; or under any chain of maps, each with one pre-image at most, which is baked as a whole.
struct MarchPlan {
    TermPtr root;  // keeps all below alive
    const VolumeTerm* volume = nullptr;
    std::vector<TransferPtr> chain = {};    // outermost first; empty: there is none
    const TransferTerm* forward = nullptr;  // null: there is none
    Mat4 worldFromDeformed{1};              // from the cells' deformed positions to the world
    Mat4 indexFromSource{1};                // from the cells' source (the world, without them) to indices
    Box3 clip;                              // index coordinates outside of which nothing is seen
};

/// Nullopt where slices have to do it: for other terms, opacity by steepness, and interpolation that is not linear.
std::optional<MarchPlan> planMarch(const CompiledScene& scene);

/// index[n] = the plan's index coordinates of world point p[n] through its chain; kUndefined where there are none.
void mapChain(const MarchPlan& plan, std::span<const Vec3> p, std::span<Vec3> index);

}  // namespace voledit
