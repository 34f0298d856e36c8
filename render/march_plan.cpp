#include "render/march_plan.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "render/slice_plan.h"

namespace voledit {

namespace {

/// Whether `m` takes boxes to boxes.
bool keepsBoxes(const Mat4& m) {
    for (int c = 0; c < 3; ++c) {
        const Vec3 column = glm::abs(Vec3(m[c]));
        const double largest = std::max({column.x, column.y, column.z});
        if (column.x + column.y + column.z > largest * (1 + 1e-9)) return false;
    }
    return true;
}

bool plainlyLooked(const VolumeTerm& volume) {
    return volume.interpolation == Interpolation::Linear && volume.appearance.gradientOpacity.points.empty();
}

}  // namespace

std::optional<MarchPlan> planMarch(const CompiledScene& scene) {
    // Shadows and occlusion are taken slice by slice.
    if (scene.render.shadows > 0 || scene.render.occlusion > 0) return std::nullopt;
    const auto chain = planChain(scene.root);
    if (!chain || !chain->located.empty() || !plainlyLooked(*chain->volume)) return std::nullopt;
    MarchPlan plan{chain->root,
                   chain->volume,
                   chain->forward,
                   chain->worldFromDeformed,
                   chain->indexFromSource,
                   chain->volume->volume->grid().indexDomain()};
    if (!plan.forward) return plan;
    if (!canBeCut(*plan.forward->by) || !keepsBoxes(plan.indexFromSource)) return std::nullopt;
    plan.clip = intersect(plan.clip, transformed(sourceBox(*plan.forward->by->cells()), plan.indexFromSource));
    return plan;
}

}  // namespace voledit
