#include "render/march_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "core/stf/source_solid.h"
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

/// Affine maps, and one map of cells at most.
std::optional<MarchPlan> planSingle(const TermPtr& root) {
    const auto chain = planChain(root);
    if (!chain || !chain->located.empty() || !plainlyLooked(*chain->volume)) return std::nullopt;
    MarchPlan plan;
    plan.root = root;
    plan.volume = chain->volume;
    plan.forward = chain->forward;
    plan.worldFromDeformed = chain->worldFromDeformed;
    plan.indexFromSource = chain->indexFromSource;
    plan.clip = chain->volume->volume->grid().indexDomain();
    if (!plan.forward) return plan;
    if (!canBeCut(*plan.forward->by) || !keepsBoxes(plan.indexFromSource)) return std::nullopt;
    plan.clip = intersect(plan.clip, transformed(sourceBox(*plan.forward->by->cells()), plan.indexFromSource));
    return plan;
}

/// Any maps.
std::optional<MarchPlan> planWhole(const TermPtr& root) {
    MarchPlan plan;
    plan.root = root;
    const Term* term = root.get();
    while (const auto* transfer = std::get_if<TransferTerm>(&term->node)) {
        if (transfer->by->cells() && transfer->by->cells()->mayOverlap()) return std::nullopt;
        plan.chain.push_back(transfer->by);
        term = transfer->of.get();
    }
    plan.volume = std::get_if<VolumeTerm>(&term->node);
    if (plan.chain.empty() || !plan.volume || !plainlyLooked(*plan.volume)) return std::nullopt;
    plan.indexFromSource = plan.volume->volume->indexFromWorld();
    plan.clip = plan.volume->volume->grid().indexDomain();
    return plan;
}

}  // namespace

std::optional<MarchPlan> planMarch(const CompiledScene& scene) {
    if (const auto single = planSingle(scene.root)) return single;
    return planWhole(scene.root);
}

void mapChain(const MarchPlan& plan, std::span<const Vec3> p, std::span<Vec3> index) {
    std::copy(p.begin(), p.end(), index.begin());
    for (const TransferPtr& map : plan.chain) map->map(index, index);
    for (Vec3& q : index) q = transformPoint(plan.indexFromSource, q);
}

}  // namespace voledit
