#include "core/eval/scalar_chain.h"

namespace voledit {

std::optional<ScalarChain> scalarChainOf(const Term& root) {
    ScalarChain chain;
    Mat4 sourceFromCells(1.0);
    for (const Term* term = &root;;) {
        if (const auto* volume = std::get_if<VolumeTerm>(&term->node)) {
            if (volume->channel != 0 || volume->interpolation != Interpolation::Linear) return std::nullopt;
            chain.volume = volume->volume.get();
            chain.indexFromSource = chain.volume->indexFromWorld() * sourceFromCells;
            return chain;
        }
        if (const auto* recolor = std::get_if<RecolorTerm>(&term->node)) {
            term = recolor->of.get();
            continue;
        }
        const auto* transfer = std::get_if<TransferTerm>(&term->node);
        if (!transfer) return std::nullopt;
        if (const MappedCells* cells = transfer->by->cells()) {
            if (chain.cells) return std::nullopt;
            chain.cells = cells;
            chain.keepsOutside = transfer->by->outside() == Outside::Keep;
        } else if (const auto matrix = transfer->by->affine()) {
            Mat4& part = chain.cells ? sourceFromCells : chain.deformedFromWorld;
            part = *matrix * part;
        } else {
            return std::nullopt;
        }
        term = transfer->of.get();
    }
}

}  // namespace voledit
