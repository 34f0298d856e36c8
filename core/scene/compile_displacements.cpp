// SD objects of a scene → maps p + Δ(p) (definitions.md §3.1). STFs within take the box of the displaced object.
#include "core/base/error.h"
#include "core/scene/compiler.h"
#include "core/stf/composite_maps.h"
#include "core/stf/field_maps.h"

namespace voledit {

TransferPtr Compiler::displacement(const Displacement& displacement, const Box3* box) {
    return std::visit([&](const auto& kind) { return made(kind, box); }, displacement.kind);
}

TransferPtr Compiler::made(const DisplacementUse& use, const Box3* box) {
    const auto found = in_.scene.displacements.find(use.name);
    if (found == in_.scene.displacements.end())
        throw Error("use of \"" + use.name + "\"", "the scene has no such displacement", "name one of `displacements`");
    const At at(*this, displacementPath(use.name));
    if (!displacements_.insert(use.name).second)
        throw Error("displacement \"" + use.name + "\"", "it uses itself", "break the cycle");
    TransferPtr used = displacement(*found->second, box);
    displacements_.erase(use.name);
    return used;
}

TransferPtr Compiler::made(const OfDisplacement& of, const Box3* box) {
    const At at(*this, "transfer");
    return map(*of.transfer, box);
}

TransferPtr Compiler::made(const ScaleDisplacement& scale, const Box3* box) {
    TransferPtr of;
    {
        const At at(*this, "of");
        of = displacement(*scale.of, box);
    }
    const At at(*this, "by");
    // By a number that is the same everywhere: what `amount` does.
    if (const auto* number = std::get_if<NumberField>(&scale.by->kind))
        return number->value == 0 ? identity() : scaled(of, number->value);
    const FieldPtr by = field(*scale.by);
    return piece<SpatialTransferFunction>(PieceKey("scaled", by, of),
                                          [&] { return std::make_shared<const ScaledMap>(by, of); });
}

TransferPtr Compiler::made(const CombinedDisplacement& combined, const Box3* box) {
    Maps of;
    for (std::size_t n = 0; n < combined.of.size(); ++n) {
        const At at(*this, "of", n);
        of.push_back(displacement(*combined.of[n], box));
    }
    if (of.empty()) throw Error("displacement", "`of` is empty", "give one or more displacements");
    if (of.size() == 1) return of.front();
    using Kind = CombinedDisplacement::Kind;
    return piece<SpatialTransferFunction>(PieceKey("combined", combined.kind, of), [&]() -> TransferPtr {
        if (combined.kind == Kind::Sum) return std::make_shared<const SumMap>(of);
        const bool larger = combined.kind == Kind::Union;
        return std::make_shared<const ChosenMap>(larger ? ChosenMap::Choice::Larger : ChosenMap::Choice::Smaller, of);
    });
}

TransferPtr Compiler::made(const BlendDisplacement& blend, const Box3* box) {
    TransferPtr first, second;
    {
        const At at(*this, "of", 0);
        first = displacement(*blend.first, box);
    }
    {
        const At at(*this, "of", 1);
        second = displacement(*blend.second, box);
    }
    const At at(*this, "weight");
    const FieldPtr weight = field(*blend.weight);
    return piece<SpatialTransferFunction>(PieceKey("blended", weight, first, second),
                                          [&] { return std::make_shared<const BlendedMap>(weight, first, second); });
}

/// Where a field is undefined nothing moves: a displacement of fields keeps what is outside (definitions.md §3.2).
TransferPtr Compiler::made(const FieldsDisplacement& fields, const Box3*) {
    const auto of = xyzFields(fields.fields);
    return piece<SpatialTransferFunction>(PieceKey("fields map", of, true, Outside::Keep),
                                          [&] { return std::make_shared<const FieldsMap>(of, true, Outside::Keep); });
}

}  // namespace voledit
