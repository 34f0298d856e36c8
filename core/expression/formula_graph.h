#pragma once
// A compiled formula inside: scalar operations in order, each operand before its use. Internal to core/expression.

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/expression/formula.h"
#include "core/expression/program.h"

namespace voledit {

/// What a node computes from its operands a, b, c; exact definitions: scalar_ops.h.
enum class Op : std::uint8_t {
    Constant,   // payload: the bits of a double
    Variable,   // payload: slot
    Parameter,  // payload: slot
    Negate,
    Absolute,
    Sign,
    Floor,
    Ceil,
    Fract,
    SquareRoot,
    Hermite,  // a²(3 − 2a)
    Sine,
    Cosine,
    Tangent,
    ArcSine,
    ArcCosine,
    ArcTangent,
    SineH,
    CosineH,
    TangentH,
    Exponential,
    Logarithm,
    Logarithm2,
    Not,
    IntegerPower,  // payload: exponent, 3 … 16
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Modulo,
    Minimum,
    Maximum,
    ArcTangent2,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Select,
    Noise,  // payload: how often differentiated by x, y, z (8 bits each, x lowest)
};

/// Operands that `op` has, 0 … 3.
int operandCount(Op op);
/// True for operations that give 1 (true) or 0 and never NaN.
bool isCondition(Op op);

struct FormulaNode {
    Op op = Op::Constant;
    std::array<std::int32_t, 3> in{-1, -1, -1};
    std::uint64_t payload = 0;

    double value() const { return std::bit_cast<double>(payload); }
    bool operator==(const FormulaNode&) const = default;
};

struct FormulaGraph::Nodes {
    std::vector<FormulaNode> nodes;  // operands before their uses; all are needed by some output
    std::vector<std::int32_t> outputs;
    int variables = 0, parameters = 0;  // slots
    // Made from the above:
    std::vector<std::uint8_t> uniform;  // per node: the same for all points
    FormulaProgram program;
};

/// One operation on numbers; `node` is no Variable and no Parameter.
double applied(const FormulaNode& node, double a, double b, double c);
/// The same for an operation with one operand and without a payload, and for noise.
double appliedFunction(Op op, double a);
double appliedNoise(std::uint64_t payload, double x, double y, double z);

/// Values of all uniform nodes for `parameters`; those of others stay as they are. `values` has one entry a node.
void evaluateUniform(const FormulaGraph::Nodes& graph, std::span<const double> parameters, std::span<double> values);

}  // namespace voledit
