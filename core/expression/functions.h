#pragma once
// The functions that formulas call, each as scalar operations. Definitions: README.md. Internal to core/expression.

#include <array>
#include <string_view>

#include "core/expression/graph_builder.h"

namespace voledit {

/// A number (width 1) or a vector (3) as nodes of a graph.
struct FormulaValue {
    int width = 1;
    std::array<int, 3> node{-1, -1, -1};

    /// A number stands for a vector of three times itself.
    int component(int c) const { return width == 1 ? node[0] : node[static_cast<std::size_t>(c)]; }
};

struct FormulaFunction {
    std::string_view name;
    int fewest, most;              // arguments
    std::string_view form;         // "clamp(x, low, high)", for errors
    std::string_view description;  // one line
    /// Null in a table entry whose call the lowering treats itself.
    FormulaValue (*make)(GraphBuilder& graph, std::span<const FormulaValue> arguments);
    /// For each argument 'n': a number, 'v': a vector, 'a': either; the last stands for all further ones.
    std::string_view types;
};

std::span<const FormulaFunction> formulaFunctions();
/// Null where there is none of that name.
const FormulaFunction* formulaFunction(std::string_view name);

/// `op` on each component, a number standing for each component of a vector.
FormulaValue componentwise(GraphBuilder& graph, Op op, const FormulaValue& a, const FormulaValue& b);

}  // namespace voledit
