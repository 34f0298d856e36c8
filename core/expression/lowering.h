#pragma once
// Syntax trees to graphs: names, types, limits. Internal to core/expression.

#include <map>

#include "core/expression/functions.h"
#include "core/expression/syntax.h"

namespace voledit {

/// Turns the formulas of one FormulaGraph into nodes, one after the other.
class Lowering {
public:
    explicit Lowering(const FormulaSymbols& symbols);

    /// `let name = formula`: later formulas may use the name. Throws FormulaError.
    void let(const FormulaLet& let);
    /// Nodes of the output's numbers. Throws FormulaError.
    std::vector<int> output(const FormulaOutput& output);

    const GraphBuilder& graph() const { return graph_; }
    int variables() const { return variables_; }
    int parameters() const { return parameters_; }

private:
    class OneFormula;

    void define(const FormulaSymbol& symbol, int& slots, bool parameter);

    GraphBuilder graph_;
    std::map<std::string, FormulaValue, std::less<>> names_;
    int variables_ = 0, parameters_ = 0;
};

}  // namespace voledit
