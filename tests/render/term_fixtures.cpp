#include "tests/render/term_fixtures.h"

#include "core/fields/simple_fields.h"

namespace voledit::test {

TermPtr solid(const SolidShape& shape, const Vec3& color, double falloff, const std::string& opacity) {
    FormulaSymbols symbols;
    symbols.variables = {{"x"}, {"y"}, {"z"}, {"r"}, {"d"}};
    const FormulaGraph formula({}, {{{opacity, ""}, FormulaType::Number}}, symbols);
    const SolidDistance distance = distanceOf(shape, 0);
    return makeSolidTerm({distance.distance, distance.center, distance.box, color, formula, {}, falloff});
}

FieldPtr expression(const std::string& formula) {
    return std::make_shared<ExpressionField>(FormulaText{formula, ""}, 0);
}

TermPtr through(const TransferPtr& map, const TermPtr& of, Combine combine) {
    return makeTransferTerm(map, of, combine, "");
}

TransferPtr library(const std::string& name, const Box3& box, const std::map<std::string, TransferArgument>& arguments,
                    double amount) {
    const TransferDefinitionPtr definition = libraryTransfer(name);
    TransferDefinition::Use use;
    for (const TransferParameter& parameter : definition->parameters())
        use.arguments[parameter.name] = parameter.suggested;
    for (const auto& [parameter, value] : arguments) use.arguments[parameter] = value;
    use.frame = frameOf(box);
    use.amount = amount;
    return definition->make(use);
}

}  // namespace voledit::test
