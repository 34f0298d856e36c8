#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/expression/formula_graph.h"
#include "core/expression/interval_ops.h"

namespace voledit {

std::vector<Interval> FormulaGraph::bounds(std::span<const Interval> variables,
                                           std::span<const double> parameters) const {
    const Nodes& graph = *nodes_;
    assert(variables.size() >= static_cast<std::size_t>(graph.variables));
    std::vector<double> uniform(graph.nodes.size());
    evaluateUniform(graph, parameters, uniform);
    std::vector<Range> ranges(graph.nodes.size());
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const FormulaNode& node = graph.nodes[n];
        if (graph.uniform[n]) {
            ranges[n] = Range::of(uniform[n]);
        } else if (node.op == Op::Variable) {
            const Interval& v = variables[node.payload];
            ranges[n] = {v.low, v.high, false};
        } else {
            std::array<Range, 3> in{};
            for (std::size_t i = 0; i < 3; ++i)
                if (node.in[i] >= 0) in[i] = ranges[static_cast<std::size_t>(node.in[i])];
            ranges[n] = rangeOf(node, in);
        }
    }
    std::vector<Interval> result;
    for (const int o : graph.outputs) {
        const Range& range = ranges[static_cast<std::size_t>(o)];
        result.push_back({range.low, range.high});
    }
    return result;
}

}  // namespace voledit
