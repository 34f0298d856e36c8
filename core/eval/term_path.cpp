#include "core/eval/term_path.h"

namespace voledit {

namespace {

/// What `term` is of, where it is of one thing; else null.
const Term* operandOf(const Term& term) {
    if (const auto* transfer = std::get_if<TransferTerm>(&term.node)) return transfer->of.get();
    if (const auto* recolor = std::get_if<RecolorTerm>(&term.node)) return recolor->of.get();
    return nullptr;
}

bool isEntry(TransferRole role) {
    return role == TransferRole::Outermost || role == TransferRole::SameList;
}

}  // namespace

std::vector<PathPoint> pathThrough(const Term& root, const Vec3& p) {
    std::vector<PathPoint> path;
    Vec3 at = p;
    bool partOfEntry = false;  // the inner maps of a sequence belong to its entry
    for (const Term* term = &root; term; term = operandOf(*term)) {
        const auto* transfer = std::get_if<TransferTerm>(&term->node);
        if (!transfer) continue;
        transfer->by->map({&at, 1}, {&at, 1});
        if (isEntry(transfer->role)) path.push_back({transfer->name, at});
        partOfEntry = isEntry(transfer->role) || (partOfEntry && transfer->role == TransferRole::Part);
        if (transfer->role == TransferRole::Part && partOfEntry) path.back().point = at;
    }
    return path;
}

OutermostTransfer outermostTransfer(const Term& root) {
    OutermostTransfer result;
    for (const Term* term = &root; term; term = operandOf(*term)) {
        const auto* transfer = std::get_if<TransferTerm>(&term->node);
        const bool begins = transfer && transfer->role == TransferRole::Outermost;
        if (!result.list.empty() &&
            (!transfer || begins || transfer->role == TransferRole::Place || transfer->role == TransferRole::Displace))
            break;
        if (transfer) (begins || !result.list.empty() ? result.list : result.above).push_back(transfer);
    }
    if (result.list.empty()) result.above.clear();
    return result;
}

const Term* oneSourceOf(const Term& root) {
    const Term* term = &root;
    while (const Term* of = operandOf(*term)) term = of;
    const bool isSource =
        std::holds_alternative<VolumeTerm>(term->node) || std::holds_alternative<MeshTerm>(term->node);
    return isSource ? term : nullptr;
}

}  // namespace voledit
