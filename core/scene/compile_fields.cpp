// Scalar fields of a scene → evaluators.
#include "core/base/error.h"
#include "core/fields/simple_fields.h"
#include "core/objects/attribute_field.h"
#include "core/scene/compiler.h"
#include "core/stf/component_field.h"

namespace voledit {

FieldPtr Compiler::field(const Field& field) {
    return std::visit([this](const auto& kind) { return made(kind); }, field.kind);
}

std::array<FieldPtr, 3> Compiler::xyzFields(const std::array<FieldRef, 3>& fields) {
    std::array<FieldPtr, 3> result;
    for (std::size_t a = 0; a < 3; ++a) {
        const At at(*this, std::array{"x", "y", "z"}[a]);
        result[a] = field(*fields[a]);
    }
    return result;
}

FieldPtr Compiler::constant(double value) {
    return piece<ScalarField>(PieceKey("number", value), [&] { return std::make_shared<const ConstantField>(value); });
}

FieldPtr Compiler::made(const NumberField& number) {
    return constant(number.value);
}

FieldPtr Compiler::made(const FormulaField& formula) {
    const double time = timeFor(formulaReadsTime(formula.expression));
    return piece<ScalarField>(PieceKey("formula", formula.expression, time), [&] {
        return std::make_shared<const ExpressionField>(FormulaText{formula.expression, at_ + "/expression"}, time);
    });
}

FieldPtr Compiler::made(const ComponentOf& component) {
    const At at(*this, "of");
    const auto* transfer = std::get_if<TransferRef>(&component.of);
    const TransferPtr of =
        transfer ? map(**transfer, nullptr) : displacement(*std::get<DisplacementRef>(component.of), nullptr);
    return piece<ScalarField>(PieceKey("component", component.axis, transfer == nullptr, of), [&] {
        return std::make_shared<const ComponentField>(of, component.axis, transfer == nullptr);
    });
}

FieldPtr Compiler::made(const AttributeOf& attribute) {
    const At at(*this, "of");
    const TermPtr of = object(*attribute.of);
    return piece<ScalarField>(PieceKey("attribute", attribute.name, of),
                              [&] { return std::make_shared<const AttributeField>(attribute.name, of); });
}

FieldPtr Compiler::made(const AssetField& asset) {
    return assetChannel(asset.asset, asset.channel);
}

FieldPtr Compiler::made(const MappedField& mapped) {
    const At at(*this, "of");
    const FieldPtr of = field(*mapped.of);
    return piece<ScalarField>(PieceKey("map", mapped.table, of),
                              [&] { return std::make_shared<const MapField>(*mapped.table, of); });
}

int Compiler::channelsOf(const std::string& asset) const {
    if (const auto found = in_.assets.volumes.find(asset); found != in_.assets.volumes.end() && found->second)
        return found->second->grid().channels;
    if (const auto found = in_.assets.meshes.find(asset); found != in_.assets.meshes.end() && found->second)
        return found->second->channels();
    throw Error("asset \"" + asset + "\"", "its volume is not loaded",
                "add it to the scene's assets with kind \"volume\"");
}

FieldPtr Compiler::assetChannel(const std::string& asset, int channel) {
    const int channels = channelsOf(asset);
    if (channel < 0 || channel >= channels)
        throw Error("asset \"" + asset + "\"",
                    "it has no channel " + std::to_string(channel) + " (it has " + std::to_string(channels) +
                        ", counted from 0)",
                    "change the `channel`");
    if (const auto found = in_.assets.volumes.find(asset); found != in_.assets.volumes.end() && found->second)
        return piece<ScalarField>(PieceKey("volume field", found->second, channel),
                                  [&] { return std::make_shared<const VolumeField>(found->second, channel); });
    const std::shared_ptr<const Mesh>& mesh = in_.assets.meshes.at(asset);
    return piece<ScalarField>(PieceKey("mesh field", mesh, channel),
                              [&] { return std::make_shared<const MeshField>(mesh, channel); });
}

}  // namespace voledit
