// Scalar fields, SD objects and formulas of a scene file.
#include <algorithm>

#include "core/scene/json_schema.h"
#include "core/scene/scene_reader.h"

namespace voledit {

Field SceneReader::field(const JsonView& view) {
    if (view.value.is_number() || view.has("keys")) return {NumberField{number(view)}};
    if (view.has("expression")) return {FormulaField{formula(view["expression"], "xyz")}};
    if (view.has("component")) return {component(view)};
    if (view.has("attribute")) return {AttributeOf{view["attribute"].text(), object(view["of"])}};
    if (view.has("map")) return {MappedField{piecewiseLinear(view["map"]), field(view["of"])}};
    AssetField result{volumeAsset(view["asset"])};
    if (view.has("channel")) result.channel = view.value["channel"].get<int>();
    return {std::move(result)};
}

std::array<FieldRef, 3> SceneReader::fields(const JsonView& view) {
    return {field(view["x"]), field(view["y"]), field(view["z"])};
}

ComponentOf SceneReader::component(const JsonView& view) {
    static const std::vector<std::string> ofDisplacements{"of", "scale", "sum", "union", "intersection", "blend"};
    ComponentOf result;
    result.axis = view["component"].text()[0] - 'x';
    const JsonView of = view["of"];
    // A name is looked for in `transfers` first, then in `displacements`.
    const bool isUse = !of.has("type");
    const std::string& word = isUse ? of["use"].text() : "";
    bool isDisplacement = isUse && !namesOfTransfers_.contains(word) && namesOfDisplacements_.contains(word);
    if (!isUse && of["type"].value.is_string())
        isDisplacement =
            std::find(ofDisplacements.begin(), ofDisplacements.end(), of["type"].text()) != ofDisplacements.end();
    if (isDisplacement)
        result.of = DisplacementRef(displacement(of));
    else
        result.of = TransferRef(transfer(of));
    return result;
}

Displacement SceneReader::displacement(const JsonView& view) {
    if (view.has("use") && !view.has("type")) {
        displacementUses_.push_back({view["use"].text(), view["use"].place.pointer()});
        return {DisplacementUse{displacementUses_.back().name}};
    }
    const std::string& type = view["type"].text();
    if (type == "of") return {OfDisplacement{transfer(view["transfer"])}};
    if (type == "fields") return {FieldsDisplacement{fields(view)}};
    const JsonView of = view["of"];
    if (type == "scale") return {ScaleDisplacement{field(view["by"]), displacement(of)}};
    if (type == "blend") return {BlendDisplacement{field(view["weight"]), displacement(of[0]), displacement(of[1])}};
    CombinedDisplacement result;
    result.kind = type == "sum"     ? CombinedDisplacement::Kind::Sum
                  : type == "union" ? CombinedDisplacement::Kind::Union
                                    : CombinedDisplacement::Kind::Intersection;
    for (std::size_t i = 0; i < of.value.size(); ++i) result.of.emplace_back(displacement(of[i]));
    return {std::move(result)};
}

std::string SceneReader::volumeAsset(const JsonView& name) {
    assetUses_.push_back({name.text(), name.place.pointer()});
    return name.text();
}

FormulaText SceneReader::formulaText(const JsonView& view) const {
    return {view.text(), file_ + ": " + view.place.pointer()};
}

/// A formula that gives a number over `variables`, of one letter each, and t.
std::string SceneReader::formula(const JsonView& view, const char* variables) const {
    FormulaSymbols symbols;
    for (const char* v = variables; *v; ++v) symbols.variables.push_back({std::string(1, *v)});
    symbols.parameters = {{"t"}};
    const FormulaGraph checked({}, {{formulaText(view), FormulaType::Number}}, symbols);
    return view.text();
}

}  // namespace voledit
