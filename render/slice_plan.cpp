#include "render/slice_plan.h"

#include <glm/matrix.hpp>

#include "core/stf/mapped_cells.h"

namespace voledit {

std::optional<SlicePlan> planChain(const TermPtr& root) {
    SlicePlan plan;
    plan.root = root;
    Mat4 restFromWorld(1);  // of the affine maps passed so far, since the last forward map
    const Term* term = root.get();
    while (const auto* transfer = std::get_if<TransferTerm>(&term->node)) {
        if (const auto affine = transfer->by->affine()) {
            restFromWorld = *affine * restFromWorld;
        } else if (!transfer->by->cells()) {
            return std::nullopt;
        } else if (!plan.forward) {
            plan.forward = transfer;
            plan.worldFromDeformed = glm::inverse(restFromWorld);
            restFromWorld = Mat4(1);
        } else if (transfer->by->cells()->mayOverlap() || plan.located.size() == SlicePlan::kMostLocated) {
            return std::nullopt;
        } else {
            plan.located.push_back({transfer, restFromWorld});
            restFromWorld = Mat4(1);
        }
        term = transfer->of.get();
    }
    plan.volume = std::get_if<VolumeTerm>(&term->node);
    if (!plan.volume || plan.volume->interpolation != Interpolation::Linear) return std::nullopt;
    plan.indexFromSource = plan.volume->volume->indexFromWorld() * restFromWorld;
    return plan;
}

SlicePlans planSlices(const TermPtr& root) {
    if (auto chain = planChain(root)) return {std::move(chain), std::nullopt};
    return {std::nullopt, makeTermProgram(root)};
}

}  // namespace voledit
