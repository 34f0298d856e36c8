#include "core/expression/graph_builder.h"

#include <cassert>
#include <cmath>

#include "core/expression/noise.h"
#include "core/expression/scalar_ops.h"

namespace voledit {

namespace {

bool commutes(Op op) {
    return op == Op::Add || op == Op::Multiply || op == Op::Equal || op == Op::NotEqual || op == Op::And ||
           op == Op::Or;
}

/// True for a power of two whose reciprocal is exact, so that x / c = x · (1/c) to the bit.
bool hasExactReciprocal(double c) {
    int exponent = 0;
    return std::isfinite(c) && std::abs(std::frexp(c, &exponent)) == 0.5 && std::abs(exponent) < 1000;
}

std::uint64_t bitsOf(double value) {
    return std::bit_cast<std::uint64_t>(value == value ? value : kNaN);
}

}  // namespace

std::size_t GraphBuilder::Hash::operator()(const FormulaNode& node) const {
    std::uint64_t h = node.payload ^ static_cast<std::uint64_t>(node.op) << 56;
    for (const int in : node.in) h = (h ^ static_cast<std::uint32_t>(in)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    return h;
}

GraphBuilder::GraphBuilder(const std::vector<FormulaNode>& nodes) : nodes_(nodes) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) numbers_.emplace(nodes_[n], static_cast<int>(n));
}

bool GraphBuilder::isConstant(int n, double value) const {
    return isConstant(n) && node(n).payload == bitsOf(value);
}

int GraphBuilder::add(const FormulaNode& node) {
    const auto [place, isNew] = numbers_.emplace(node, static_cast<int>(nodes_.size()));
    if (isNew) nodes_.push_back(node);
    return place->second;
}

int GraphBuilder::constant(double value) {
    return add({.op = Op::Constant, .payload = bitsOf(value)});
}

int GraphBuilder::variable(int slot) {
    return add({.op = Op::Variable, .payload = static_cast<std::uint64_t>(slot)});
}

int GraphBuilder::parameter(int slot) {
    return add({.op = Op::Parameter, .payload = static_cast<std::uint64_t>(slot)});
}

int GraphBuilder::make(Op op, int a, int b, int c, std::uint64_t payload) {
    if (commutes(op) && b < a) std::swap(a, b);
    const FormulaNode made{.op = op, .in = {a, b, c}, .payload = payload};
    const int count = operandCount(op);
    bool constants = true;
    std::array<double, 3> value{};
    for (int i = 0; i < count; ++i) {
        const std::size_t n = static_cast<std::size_t>(i);
        assert(made.in[n] >= 0 && made.in[n] < static_cast<int>(nodes_.size()));
        constants = constants && isConstant(made.in[n]);
        if (constants) value[n] = node(made.in[n]).value();
    }
    if (constants) return constant(applied(made, value[0], value[1], value[2]));
    const int simple = simplified(made);
    return simple >= 0 ? simple : add(made);
}

int GraphBuilder::power(int x, int n) {
    if (n < 0) return make(Op::Divide, constant(1), power(x, -n));
    if (n == 0) return constant(1);
    if (n == 1) return x;
    if (n == 2) return make(Op::Multiply, x, x);
    return make(Op::IntegerPower, x, -1, -1, static_cast<std::uint64_t>(n));
}

int GraphBuilder::truth(int a) {
    if (isCondition(node(a).op)) return a;
    return make(Op::NotEqual, a, constant(0));
}

int GraphBuilder::noise(const std::array<int, 3>& point, const std::array<int, 3>& order) {
    return make(Op::Noise, point[0], point[1], point[2], noisePayload(order));
}

int GraphBuilder::simplified(const FormulaNode& made) {
    const int arithmetic = simplifiedArithmetic(made);
    return arithmetic >= 0 ? arithmetic : simplifiedLogic(made);
}

// Only what holds for every number, infinity and NaN, with the signs of zeros: 0·x and x + 0 stay.
int GraphBuilder::simplifiedArithmetic(const FormulaNode& made) {
    const auto [a, b, c] = made.in;
    // make() may grow the nodes, so operators are copied out.
    const FormulaNode left = node(a), right = b >= 0 ? node(b) : FormulaNode{};
    switch (made.op) {
        case Op::Negate:
            return left.op == Op::Negate ? left.in[0] : -1;
        case Op::Absolute:
            if (left.op == Op::Absolute) return a;
            return left.op == Op::Negate ? make(Op::Absolute, left.in[0]) : -1;
        case Op::Floor:
        case Op::Ceil:
            return left.op == Op::Floor || left.op == Op::Ceil || isCondition(left.op) ? a : -1;
        case Op::Add:
            if (isConstant(a, -0.0)) return b;
            if (isConstant(b, -0.0)) return a;
            if (right.op == Op::Negate) return make(Op::Subtract, a, right.in[0]);
            return left.op == Op::Negate ? make(Op::Subtract, b, left.in[0]) : -1;
        case Op::Subtract:
            if (isConstant(b, 0.0)) return a;
            if (isConstant(a, -0.0)) return make(Op::Negate, b);
            return right.op == Op::Negate ? make(Op::Add, a, right.in[0]) : -1;
        case Op::Multiply:
            if (isConstant(a, 1)) return b;
            if (isConstant(b, 1)) return a;
            if (isConstant(a, -1)) return make(Op::Negate, b);
            return isConstant(b, -1) ? make(Op::Negate, a) : -1;
        case Op::Divide:
            if (isConstant(b, 1)) return a;
            if (isConstant(b, -1)) return make(Op::Negate, a);
            return right.op == Op::Constant && hasExactReciprocal(right.value())
                       ? make(Op::Multiply, a, constant(1 / right.value()))
                       : -1;
        case Op::Power:
            return right.op == Op::Constant && scalar::isIntegerPower(right.value())
                       ? power(a, static_cast<int>(right.value()))
                       : -1;
        default:
            return -1;
    }
}

int GraphBuilder::simplifiedLogic(const FormulaNode& made) {
    const auto [a, b, c] = made.in;
    switch (made.op) {
        case Op::Not:
            return node(a).op == Op::Not ? node(a).in[0] : -1;
        case Op::And:
            if (a == b || isConstant(b, 1)) return a;
            if (isConstant(a, 1)) return b;
            return isConstant(a) || isConstant(b) ? constant(0) : -1;
        case Op::Or:
            if (a == b || isConstant(b, 0)) return a;
            if (isConstant(a, 0)) return b;
            return isConstant(a) || isConstant(b) ? constant(1) : -1;
        case Op::Select:
            if (isConstant(a)) return node(a).value() != 0 ? b : c;
            return b == c ? b : -1;
        case Op::Less:
        case Op::NotEqual:
            return a == b ? constant(0) : -1;
        case Op::Minimum:
        case Op::Maximum:
            return a == b ? a : -1;
        default:
            return -1;
    }
}

std::shared_ptr<const FormulaGraph::Nodes> finished(const GraphBuilder& builder, const std::vector<int>& outputs,
                                                    int variables, int parameters) {
    const auto& all = builder.nodes();
    std::vector<int> number(all.size(), -1);
    for (const int o : outputs) number[static_cast<std::size_t>(o)] = 0;
    for (std::size_t n = all.size(); n-- > 0;)
        if (number[n] == 0)
            for (const int in : all[n].in)
                if (in >= 0) number[static_cast<std::size_t>(in)] = 0;
    auto graph = std::make_shared<FormulaGraph::Nodes>();
    graph->variables = variables;
    graph->parameters = parameters;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (number[n] < 0) continue;
        FormulaNode node = all[n];
        bool uniform = node.op != Op::Variable;
        for (auto& in : node.in)
            if (in >= 0) {
                in = number[static_cast<std::size_t>(in)];
                uniform = uniform && graph->uniform[static_cast<std::size_t>(in)];
            }
        number[n] = static_cast<int>(graph->nodes.size());
        graph->nodes.push_back(node);
        graph->uniform.push_back(uniform);
    }
    for (const int o : outputs) graph->outputs.push_back(number[static_cast<std::size_t>(o)]);
    graph->program = makeProgram(*graph);
    return graph;
}

}  // namespace voledit
