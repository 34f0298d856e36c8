#pragma once
// The order in which a graph's nodes are evaluated over a block of points, and where their values are kept. Internal to
// core/expression.

#include <array>
#include <cstdint>
#include <vector>

#include "core/expression/formula.h"

namespace voledit {

enum class Op : std::uint8_t;

/// Points that are evaluated together: few enough that the working registers stay in the nearest caches.
inline constexpr std::size_t kFormulaBlock = 256;

/// Where an operand is or a result goes.
struct FormulaPlace {
    enum class Kind : std::uint8_t { None, Register, Variable, Output, Uniform };
    Kind kind = Kind::None;
    std::int32_t index = 0;  // of the register, variable slot, output, or uniform node
};

struct FormulaStep {
    Op op{};
    std::uint64_t payload = 0;
    std::array<FormulaPlace, 3> in{};
    FormulaPlace out{};
    FormulaPlace cosine{};  // with Op::Sine: also takes the cosine
};

struct FormulaProgram {
    std::vector<FormulaStep> steps;
    int registers = 0;
    /// Outputs that no step writes: (output, what it equals: a variable, a uniform node, another output).
    std::vector<std::pair<std::int32_t, FormulaPlace>> copies;
    bool hasUniforms = false;  // some uniform node is used by a step or a copy
};

/// Needs nodes, outputs and uniform of `graph`.
FormulaProgram makeProgram(const FormulaGraph::Nodes& graph);

}  // namespace voledit
