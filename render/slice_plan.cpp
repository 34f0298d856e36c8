#include "render/slice_plan.h"

#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {
[[noreturn]] void refuse(const TransferTerm& transfer, const std::string& cause) {
    throw Error(transfer.name.empty() ? std::string("transfer") : "transfer \"" + transfer.name + "\"", cause,
                "use --renderer rays");
}
}  // namespace

SlicePlan planSlices(const TermPtr& root) {
    SlicePlan plan;
    plan.root = root;
    Mat4 restFromWorld(1);  // of the affine maps passed so far, since the last forward map
    const Term* term = root.get();
    while (const auto* transfer = std::get_if<TransferTerm>(&term->node)) {
        if (const auto affine = transfer->by->affine()) {
            restFromWorld = *affine * restFromWorld;
        } else if (!transfer->by->cells()) {
            refuse(*transfer, "slices cannot draw this kind of map");
        } else if (!plan.forward) {
            plan.forward = transfer;
            plan.worldFromDeformed = glm::inverse(restFromWorld);
            restFromWorld = Mat4(1);
        } else if (transfer->by->cells()->mayOverlap()) {
            refuse(*transfer, "slices cannot draw a folded map below another one");
        } else if (plan.located.size() == SlicePlan::kMostLocated) {
            refuse(*transfer, "slices can draw " + std::to_string(SlicePlan::kMostLocated + 1) + " such maps at most");
        } else {
            plan.located.push_back({transfer, restFromWorld});
            restFromWorld = Mat4(1);
        }
        term = transfer->of.get();
    }
    plan.volume = std::get_if<VolumeTerm>(&term->node);
    if (!plan.volume) throw Error("scene", "slices cannot draw this kind of object", "use --renderer rays");
    plan.indexFromSource = plan.volume->volume->indexFromWorld() * restFromWorld;
    return plan;
}

}  // namespace voledit
