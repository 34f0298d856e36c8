#include "render/slice_plan.h"

#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

SlicePlan planSlices(const TermPtr& root) {
    SlicePlan plan;
    plan.root = root;
    Mat4 restFromWorld(1);  // of the affine maps passed so far, since the last forward map
    const Term* term = root.get();
    while (const auto* transfer = std::get_if<TransferTerm>(&term->node)) {
        if (const auto affine = transfer->by->affine()) {
            restFromWorld = *affine * restFromWorld;
        } else if (transfer->by->cells() && !plan.forward) {
            plan.forward = transfer;
            plan.worldFromDeformed = glm::inverse(restFromWorld);
            restFromWorld = Mat4(1);
        } else {
            throw Error(transfer->name.empty() ? std::string("transfer") : "transfer \"" + transfer->name + "\"",
                        "slices cannot draw this kind of map here", "use --renderer rays");
        }
        term = transfer->of.get();
    }
    plan.volume = &std::get<VolumeTerm>(term->node);
    plan.indexFromSource = plan.volume->volume->indexFromWorld() * restFromWorld;
    return plan;
}

}  // namespace voledit
