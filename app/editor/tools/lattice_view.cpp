#include "app/editor/tools/lattice_view.h"

#include <glm/matrix.hpp>

#include "core/scene/scene_at.h"

namespace voledit {

namespace {

/// The transfer that a list's entry means, and the name that edits find it by.
struct Named {
    const Transfer* transfer = nullptr;
    std::string name;
};

Named resolve(const Scene& scene, const Transfer& entry) {
    Named named{&entry, entry.name};
    // As many steps as there are transfers; more would be a cycle, which loading refuses.
    for (std::size_t steps = 0; steps <= scene.transfers.size(); ++steps) {
        const auto* use = std::get_if<TransferUse>(&named.transfer->kind);
        if (!use) return named;
        const auto found = scene.transfers.find(use->name);
        if (found == scene.transfers.end()) return {};
        named = {&*found->second, use->name};
    }
    return {};
}

/// The compiled form of `named`; null where there is none (it is switched off, or not compiled yet).
const TransferTerm* termOf(const Term* term, const Named& named) {
    const std::string& name = named.transfer->name.empty() ? named.name : named.transfer->name;
    while (term) {
        const auto* transfer = std::get_if<TransferTerm>(&term->node);
        if (!transfer) return nullptr;
        if (!name.empty() && transfer->name == name) return transfer;
        term = transfer->of.get();
    }
    return nullptr;
}

/// Forward matrix of an affine transfer at its amount: Δ = Ψ − id is scaled [definitions.md §3.1].
Mat4 forwardOf(const Transfer& transfer, const AffineTransfer& affine) {
    const Mat4 forward = worldFromRest(affine.placement);
    if (transfer.amount == 1) return forward;
    const Mat4 identity{1.0};
    return glm::inverse(identity + *transfer.amount * (glm::inverse(forward) - identity));
}

bool acts(const Transfer& transfer) {
    return transfer.enabled && transfer.amount != 0;
}

struct Walk {
    const Scene& scene;
    const CompiledScene* compiled;
    Mat4 outer{1.0};
    bool exact = true;
    std::vector<LatticeView> found{};

    void pass(const Transfer& entry) {
        const Named named = resolve(scene, entry);
        if (!named.transfer) return;
        const Transfer& transfer = *named.transfer;
        if (const auto* affine = std::get_if<AffineTransfer>(&transfer.kind)) {
            if (acts(transfer)) outer = outer * forwardOf(transfer, *affine);
        } else if (const auto* ffd = std::get_if<FfdTransfer>(&transfer.kind)) {
            if (!named.name.empty()) add(named, *ffd);
            if (acts(transfer) && !ffd->moves.empty()) exact = false;
        }
    }

    void add(const Named& named, const FfdTransfer& ffd) {
        const TransferTerm* term = compiled ? termOf(compiled->root.get(), named) : nullptr;
        std::optional<Frame> frame = named.transfer->frame;
        if (!frame && compiled && compiled->root) {
            // One that is switched off has no operand among the compiled terms: the whole object's box stands for it.
            const Box3& box = term ? term->of->bounds : compiled->root->bounds;
            if (!box.empty()) frame = frameOf(box);
        }
        if (!frame) return;
        found.push_back(
            {named.name, latticeOf(ffd, *frame), outer, exact, acts(*named.transfer), term ? term->by : nullptr});
    }
};

}  // namespace

std::vector<LatticeView> latticeViews(const Scene& animated, const CompiledScene* compiled) {
    const Scene scene = compiled ? sceneAt(animated, compiled->time) : animated;
    Walk walk{scene, compiled};
    const Object* object = &*scene.root;
    // Each object is passed once at most; more would be a cycle, which loading refuses.
    for (std::size_t steps = 0; object && steps <= 10000; ++steps) {
        const Object* next = nullptr;
        if (const auto* use = std::get_if<ObjectUse>(&object->kind)) {
            const auto named = scene.objects.find(use->name);
            if (named != scene.objects.end()) next = &*named->second;
        } else if (const auto* place = std::get_if<PlaceObject>(&object->kind)) {
            walk.outer = walk.outer * worldFromRest(place->placement);
            next = &*place->of;
        } else if (const auto* transfer = std::get_if<TransferObject>(&object->kind)) {
            for (auto entry = transfer->by.rbegin(); entry != transfer->by.rend(); ++entry) walk.pass(**entry);
            next = &*transfer->of;
        }
        object = next;
    }
    return std::move(walk.found);
}

std::optional<LatticeView> latticeView(const Scene& scene, const CompiledScene* compiled, const std::string& name) {
    for (auto& view : latticeViews(scene, compiled))
        if (name.empty() || view.name == name) return std::move(view);
    return std::nullopt;
}

Index3 gridIndexOf(const Lattice& lattice, std::size_t index) {
    const int n = int(index), nx = lattice.points.x, ny = lattice.points.y;
    return {n % nx, n / nx % ny, n / (nx * ny)};
}

}  // namespace voledit
