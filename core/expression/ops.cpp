#include <cassert>
#include <cmath>

#include "core/expression/formula_graph.h"
#include "core/expression/noise.h"
#include "core/expression/scalar_ops.h"

namespace voledit {

int operandCount(Op op) {
    if (op <= Op::Parameter) return 0;
    if (op <= Op::IntegerPower) return 1;
    return op <= Op::Or ? 2 : 3;
}

bool isCondition(Op op) {
    return op == Op::Not || (op >= Op::Less && op <= Op::Or);
}

double appliedFunction(Op op, double a) {
    switch (op) {
        case Op::Negate:
            return -a;
        case Op::Absolute:
            return std::abs(a);
        case Op::Sign:
            return scalar::sign(a);
        case Op::Floor:
            return std::floor(a);
        case Op::Ceil:
            return std::ceil(a);
        case Op::Fract:
            return scalar::fract(a);
        case Op::SquareRoot:
            return std::sqrt(a);
        case Op::Hermite:
            return scalar::hermite(a);
        case Op::Sine:
            return std::sin(a);
        case Op::Cosine:
            return std::cos(a);
        case Op::Tangent:
            return std::tan(a);
        case Op::ArcSine:
            return std::asin(a);
        case Op::ArcCosine:
            return std::acos(a);
        case Op::ArcTangent:
            return std::atan(a);
        case Op::SineH:
            return std::sinh(a);
        case Op::CosineH:
            return std::cosh(a);
        case Op::TangentH:
            return std::tanh(a);
        case Op::Exponential:
            return std::exp(a);
        case Op::Logarithm:
            return std::log(a);
        case Op::Logarithm2:
            return std::log2(a);
        case Op::Not:
            return 1.0 - a;
        default:
            assert(false);
            return kNaN;
    }
}

namespace {

double appliedToTwo(Op op, double a, double b) {
    switch (op) {
        case Op::Add:
            return a + b;
        case Op::Subtract:
            return a - b;
        case Op::Multiply:
            return a * b;
        case Op::Divide:
            return a / b;
        case Op::Power:
            return scalar::power(a, b);
        case Op::Modulo:
            return scalar::modulo(a, b);
        case Op::Minimum:
            return scalar::minimum(a, b);
        case Op::Maximum:
            return scalar::maximum(a, b);
        case Op::ArcTangent2:
            return scalar::arcTangent2(a, b);
        case Op::Less:
            return scalar::less(a, b);
        case Op::LessEqual:
            return scalar::lessEqual(a, b);
        case Op::Equal:
            return scalar::equal(a, b);
        case Op::NotEqual:
            return scalar::notEqual(a, b);
        case Op::And:
            return a * b;
        case Op::Or:
            return a + b - a * b;
        default:
            assert(false);
            return kNaN;
    }
}

}  // namespace

double appliedNoise(std::uint64_t payload, double x, double y, double z) {
    return noise(x, y, z, noiseOrder(payload));
}

double applied(const FormulaNode& node, double a, double b, double c) {
    if (node.op == Op::Constant) return node.value();
    if (node.op == Op::Select) return scalar::select(a, b, c);
    if (node.op == Op::Noise) return appliedNoise(node.payload, a, b, c);
    if (node.op == Op::IntegerPower) return scalar::integerPower(a, static_cast<int>(node.payload));
    return operandCount(node.op) == 1 ? appliedFunction(node.op, a) : appliedToTwo(node.op, a, b);
}

void evaluateUniform(const FormulaGraph::Nodes& graph, std::span<const double> parameters, std::span<double> values) {
    const auto operand = [&](int n) { return n < 0 ? 0.0 : values[static_cast<std::size_t>(n)]; };
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (!graph.uniform[n]) continue;
        const FormulaNode& node = graph.nodes[n];
        values[n] = node.op == Op::Parameter
                        ? parameters[node.payload]
                        : applied(node, operand(node.in[0]), operand(node.in[1]), operand(node.in[2]));
    }
}

}  // namespace voledit
