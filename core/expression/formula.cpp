#include "core/expression/formula.h"

#include "core/expression/formula_graph.h"
#include "core/expression/lowering.h"

namespace voledit {

FormulaGraph::FormulaGraph(const std::vector<FormulaLet>& lets, const std::vector<FormulaOutput>& outputs,
                           const FormulaSymbols& symbols) {
    Lowering lowering(symbols);
    for (const FormulaLet& let : lets) lowering.let(let);
    std::vector<int> nodes;
    for (const FormulaOutput& output : outputs)
        for (const int node : lowering.output(output)) nodes.push_back(node);
    nodes_ = finished(lowering.graph(), nodes, lowering.variables(), lowering.parameters());
}

int FormulaGraph::variableCount() const {
    return nodes_->variables;
}

int FormulaGraph::parameterCount() const {
    return nodes_->parameters;
}

int FormulaGraph::outputCount() const {
    return static_cast<int>(nodes_->outputs.size());
}

bool FormulaGraph::isConstant(int output) const {
    const int node = nodes_->outputs[static_cast<std::size_t>(output)];
    return nodes_->uniform[static_cast<std::size_t>(node)] != 0;
}

bool FormulaGraph::operator==(const FormulaGraph& other) const {
    const Nodes &a = *nodes_, &b = *other.nodes_;
    return &a == &b ||
           (a.variables == b.variables && a.parameters == b.parameters && a.outputs == b.outputs && a.nodes == b.nodes);
}

}  // namespace voledit
