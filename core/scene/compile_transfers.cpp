// STFs of a scene → maps.
#include <algorithm>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/fields/simple_fields.h"
#include "core/scene/compiler.h"
#include "core/stf/affine.h"
#include "core/stf/composite_maps.h"
#include "core/stf/field_maps.h"

namespace voledit {

namespace {

TransferArgument argumentOf(const LibraryTransfer::Argument& argument) {
    if (const auto* line = std::get_if<LibraryTransfer::Line>(&argument))
        return LineValue{*line->point, *line->direction};
    if (const auto* axes = std::get_if<LibraryTransfer::Axes>(&argument)) return axes->axes;
    return *std::get<Tracked<std::vector<double>>>(argument);
}

bool hasStrength(const TransferDefinition& definition) {
    const auto& parameters = definition.parameters();
    return std::any_of(parameters.begin(), parameters.end(), [](const auto& parameter) { return parameter.strength; });
}

bool definitionReadsTime(const TransferDefinition& definition) {
    const auto& formulas = definition.formulas();
    return std::any_of(formulas.begin(), formulas.end(), [](const auto& f) { return formulaReadsTime(f.second); });
}

bool expressionReadsTime(const ExpressionTransfer& expression) {
    const auto& let = expression.let;
    return formulaReadsTime(expression.x + " " + expression.y + " " + expression.z + " " + expression.undefined) ||
           std::any_of(let.begin(), let.end(), [](const auto& f) { return formulaReadsTime(f.second); });
}

}  // namespace

bool formulaReadsTime(const std::string& formula) {
    const auto isPartOfName = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    };
    for (std::size_t at = formula.find('t'); at != std::string::npos; at = formula.find('t', at + 1))
        if ((at == 0 || !isPartOfName(formula[at - 1])) && (at + 1 == formula.size() || !isPartOfName(formula[at + 1])))
            return true;
    return false;
}

/// Ψ as maps in the order in which they apply: several for sequences, one for all others.
Compiler::Maps Compiler::maps(const Transfer& transfer, const Box3* box) {
    if (const auto* use = std::get_if<TransferUse>(&transfer.kind)) {
        const auto found = in_.scene.transfers.find(use->name);
        if (found == in_.scene.transfers.end())
            throw Error("use of \"" + use->name + "\"", "the scene has no such transfer", "name one of `transfers`");
        const At at(*this, transferPath(use->name));
        if (!transfers_.insert(use->name).second)
            throw Error("transfer \"" + use->name + "\"", "it uses itself", "break the cycle");
        const Maps used = maps(*found->second, box);
        transfers_.erase(use->name);
        return used;
    }
    const bool isOff = !transfer.enabled || transfer.amount == 0;
    const bool hasMembers = std::holds_alternative<SequenceTransfer>(transfer.kind) ||
                            std::holds_alternative<TransferredTransfer>(transfer.kind);
    // What is switched off is made all the same: a shared transfer within may take its frame here.
    if (!hasMembers) {
        const TransferPtr map = basicMap(transfer, box);
        return {isOff ? identity() : map};
    }
    const Maps members = mapsOfMembers(transfer, box);
    if (isOff) return {identity()};
    if (transfer.amount == 1) return members;
    return {scaled(sequence(members), transfer.amount)};
}

TransferPtr Compiler::map(const Transfer& transfer, const Box3* box) {
    return sequence(maps(transfer, box));
}

/// Each member of a sequence takes the box after those before it; both of `transferred` that of the final operand.
Compiler::Maps Compiler::mapsOfMembers(const Transfer& transfer, const Box3* box) {
    Maps all;
    if (const auto* transferred = std::get_if<TransferredTransfer>(&transfer.kind)) {
        {
            const At at(*this, "of");
            all = maps(*transferred->of, box);
        }
        const At at(*this, "by");
        const Maps by = maps(*transferred->by, box);
        all.insert(all.end(), by.begin(), by.end());
        return all;
    }
    const auto& of = std::get<SequenceTransfer>(transfer.kind).of;
    Box3 reached = box ? *box : Box3{};
    for (std::size_t n = 0; n < of.size(); ++n) {
        const At at(*this, "of", n);
        for (const TransferPtr& map : maps(*of[n], box ? &reached : nullptr)) {
            all.push_back(map);
            if (box && n + 1 < of.size()) reached = map->imageOf(reached);
        }
    }
    return all;
}

TransferPtr Compiler::basicMap(const Transfer& transfer, const Box3* box) {
    return std::visit(
        [&](const auto& kind) -> TransferPtr {
            if constexpr (requires { made(kind, transfer, box); })
                return made(kind, transfer, box);
            else
                throw Error("transfer", "its members were to be made one by one", "report this");
        },
        transfer.kind);
}

TransferPtr Compiler::made(const AffineTransfer& affine, const Transfer& transfer, const Box3*) {
    const Mat4 matrix = worldFromRest(affine.placement);
    const auto map = piece<SpatialTransferFunction>(PieceKey("affine", matrix),
                                                    [&] { return std::make_shared<const AffineMap>(matrix); });
    return scaled(map, transfer.amount);
}

TransferPtr Compiler::made(const FfdTransfer& ffd, const Transfer& transfer, const Box3* box) {
    const Frame frame = frameOfTransfer(transfer, box);
    const Outside outside = transfer.outside.value_or(Outside::Hide);
    PieceKey key("ffd", frame, outside, ffd.basis, ffd.points, ffd.cells);
    for (const auto& [point, move] : ffd.moves) {
        key.add(point);
        key.add(*move.vector);
        key.add(move.absolute);
    }
    const auto map = piece<SpatialTransferFunction>(
        key, [&] { return std::make_shared<const LatticeMap>(latticeOf(ffd, frame), ffd.cells, outside); });
    return scaled(map, transfer.amount);
}

TransferDefinitionPtr Compiler::definitionOf(const LibraryTransfer& library) const {
    if (!library.isFile) {
        if (auto definition = libraryTransfer(library.definition)) return definition;
        throw Error("transfer type \"" + library.definition + "\"", "there is no such transfer",
                    "name one of resources/transfers, or a formula file by { \"file\": PATH }");
    }
    const auto found = in_.assets.transfers.find(library.definition);
    if (found == in_.assets.transfers.end() || !found->second)
        throw Error("formula file \"" + library.definition + "\"", "it is not loaded", "check its path");
    return found->second;
}

TransferPtr Compiler::made(const LibraryTransfer& library, const Transfer& transfer, const Box3* box) {
    const TransferDefinitionPtr definition = definitionOf(library);
    const bool takesAmount = hasStrength(*definition);
    TransferDefinition::Use use;
    for (const auto& [name, argument] : library.arguments) use.arguments.emplace(name, argumentOf(argument));
    if (definition->usesFrame()) use.frame = frameOfTransfer(transfer, box);
    use.outside = transfer.outside.value_or(Outside::Hide);
    use.amount = takesAmount ? *transfer.amount : 1;
    use.time = timeFor(definitionReadsTime(*definition));
    PieceKey key("library", definition, use.frame, use.outside, use.amount, use.time);
    for (const auto& [name, argument] : use.arguments) {
        key.add(name);
        key.add(argument);
    }
    const auto made = piece<WarnedMap>(key, [&] {
        WarnedMap result;
        result.map = definition->make(use, &result.warning);
        return std::make_shared<const WarnedMap>(std::move(result));
    });
    nodes_[made->map.get()] = 1;
    if (!made->warning.empty()) warnings_.push_back(at_ + ": " + made->warning);
    return takesAmount ? made->map : scaled(made->map, transfer.amount);
}

TransferPtr Compiler::made(const ExpressionTransfer& expression, const Transfer& transfer, const Box3* box) {
    ExpressionUse use;
    const auto text = [&](const std::string& formula, const std::string& member) {
        return FormulaText{formula, at_ + "/" + member};
    };
    for (std::size_t n = 0; n < expression.let.size(); ++n)
        use.lets.push_back(
            {expression.let[n].first, text(expression.let[n].second, "let/" + std::to_string(n) + "/1")});
    use.x = text(expression.x, "x");
    use.y = text(expression.y, "y");
    use.z = text(expression.z, "z");
    if (!expression.undefined.empty()) use.undefined = text(expression.undefined, "undefined");
    use.world = expression.world;
    if (!use.world) use.frame = frameOfTransfer(transfer, box);
    if (expression.image) use.image = **expression.image;
    use.time = timeFor(expressionReadsTime(expression));
    const PieceKey key("expression map", expression.x, expression.y, expression.z, expression.undefined, expression.let,
                       use.world, use.frame, use.image, use.time);
    const auto map = piece<SpatialTransferFunction>(key, [&] { return makeExpressionMap(use); });
    return scaled(map, transfer.amount);
}

TransferPtr Compiler::made(const FieldsTransfer& fields, const Transfer& transfer, const Box3*) {
    std::array<FieldPtr, 3> of;
    if (fields.asset.empty()) {
        of = xyzFields(fields.fields);
    } else {
        const int channels = channelsOf(fields.asset);
        if (channels != 3)
            throw Error("asset \"" + fields.asset + "\"",
                        "it has " + std::to_string(channels) + " components, where a map needs 3",
                        "name a volume of three components, or give x, y, z");
        for (std::size_t c = 0; c < 3; ++c) of[c] = assetChannel(fields.asset, int(c));
    }
    const Outside outside = transfer.outside.value_or(fields.displacement ? Outside::Keep : Outside::Hide);
    const auto map = piece<SpatialTransferFunction>(PieceKey("fields map", of, fields.displacement, outside), [&] {
        return std::make_shared<const FieldsMap>(of, fields.displacement, outside);
    });
    return scaled(map, transfer.amount);
}

TransferPtr Compiler::made(const MappedTransfer& mapped, const Transfer& transfer, const Box3*) {
    const Outside outside = transfer.outside.value_or(Outside::Hide);
    const PieceKey key("mapped", mapped.points, mapped.source, mapped.cells, outside);
    const auto map = piece<SpatialTransferFunction>(key, [&] {
        MappedCells::Data data;
        data.deformed = *mapped.points;
        data.source = *mapped.source;
        data.hexahedra = mapped.cells;
        return std::make_shared<const CellMap>(std::move(data), outside);
    });
    return scaled(map, transfer.amount);
}

/// The transfer's own frame, or the box of the operand at its first use.
Frame Compiler::frameOfTransfer(const Transfer& transfer, const Box3* box) {
    if (transfer.frame) return **transfer.frame;
    if (const auto known = in_.frames.find(at_); known != in_.frames.end()) return known->second;
    if (!box)
        throw Error("transfer", "as the component of an STF by itself it has no operand to take its frame from",
                    "give it a `frame`");
    return in_.frames.emplace(at_, frameOf(*box)).first->second;
}

TransferPtr Compiler::identity() {
    return piece<SpatialTransferFunction>(PieceKey("affine", Mat4(1)),
                                          [] { return std::make_shared<const AffineMap>(Mat4(1)); });
}

/// p + amount·Δ(p) (definitions.md §3.1), of the kind that `map` is where that can be.
TransferPtr Compiler::scaled(const TransferPtr& map, double amount) {
    if (amount == 1) return map;
    if (map->cells())
        return piece<SpatialTransferFunction>(PieceKey("scaled cells", map, amount),
                                              [&] { return scaledCells(*map, amount); });
    const FieldPtr by = constant(amount);
    return piece<SpatialTransferFunction>(PieceKey("scaled", by, map), [&]() -> TransferPtr {
        const auto full = map->affine();
        const Mat4 blended = full ? Mat4(1) + amount * (*full - Mat4(1)) : Mat4(0);
        // Half of a half turn flattens space: that has no matrix from q to p.
        if (full && std::abs(glm::determinant(Mat3(blended))) > 1e-9)
            return std::make_shared<const AffineMap>(glm::inverse(blended));
        return std::make_shared<const ScaledMap>(by, map);
    });
}

TransferPtr Compiler::sequence(const Maps& maps) {
    if (maps.size() == 1) return maps.front();
    return piece<SpatialTransferFunction>(PieceKey("sequence", maps),
                                          [&] { return std::make_shared<const SequenceMap>(maps); });
}

}  // namespace voledit
