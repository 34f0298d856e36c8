#include "render/slice_plan.h"

#include <glm/matrix.hpp>
#include <set>

#include "core/stf/source_solid.h"

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

bool canBeCut(const SpatialTransferFunction& map) {
    const MappedCells* cells = map.cells();
    return cells && map.outside() == Outside::Hide && !cells->mayOverlap() && fillSourceBox(*cells);
}

namespace {

bool holdsSolids(const Term& root) {
    std::vector<const Term*> next{&root};
    std::set<const Term*> seen;
    while (!next.empty()) {
        const Term* term = next.back();
        next.pop_back();
        if (!seen.insert(term).second) continue;
        if (std::holds_alternative<SolidTerm>(term->node)) return true;
        if (const auto* transfer = std::get_if<TransferTerm>(&term->node)) next.push_back(transfer->of.get());
        if (const auto* recolor = std::get_if<RecolorTerm>(&term->node)) next.push_back(recolor->of.get());
        if (const auto* cvg = std::get_if<CvgTerm>(&term->node))
            for (const TermPtr& of : cvg->of) next.push_back(of.get());
    }
    return false;
}

}  // namespace

TermPlan planTerm(const TermPtr& root) {
    const bool solids = holdsSolids(*root);
    Mat4 restFromWorld(1);
    for (TermPtr term = root; !solids;) {
        const auto* transfer = std::get_if<TransferTerm>(&term->node);
        if (!transfer) break;
        if (const auto affine = transfer->by->affine()) {
            restFromWorld = *affine * restFromWorld;
            term = transfer->of;
            continue;
        }
        if (!canBeCut(*transfer->by)) break;
        return {root,
                transfer->of,
                transfer,
                glm::inverse(restFromWorld),
                intersect(transfer->of->bounds, sourceBox(*transfer->by->cells())),
                false};
    }
    return {root, root, nullptr, Mat4(1), root->bounds, solids};
}

void checkSlices(const TermPtr& root) {
    if (!planChain(root)) makeTermProgram(planTerm(root).drawn);
}

}  // namespace voledit
