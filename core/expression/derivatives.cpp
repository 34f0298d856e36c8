#include <algorithm>
#include <cassert>
#include <numbers>

#include "core/expression/graph_builder.h"
#include "core/expression/noise.h"

namespace voledit {

namespace {

/// Node of a derivative that is 0 whatever the point: what it would multiply is never computed, so 0·∞ does not arise.
constexpr int kZero = -1;

/// Derivatives of all nodes by one variable, by forward differentiation.
class Forward {
public:
    Forward(GraphBuilder& graph, std::size_t nodes, int slot) : g_(graph), derivative_(nodes, kZero) {
        for (std::size_t n = 0; n < nodes; ++n) derivative_[n] = of(static_cast<int>(n), slot);
    }
    int operator[](int node) const { return derivative_[static_cast<std::size_t>(node)]; }

private:
    int multiply(int a, int b) { return a == kZero || b == kZero ? kZero : g_.make(Op::Multiply, a, b); }
    int add(int a, int b) { return a == kZero ? b : b == kZero ? a : g_.make(Op::Add, a, b); }
    int negate(int a) { return a == kZero ? kZero : g_.make(Op::Negate, a); }
    int subtract(int a, int b) {
        if (b == kZero) return a;
        return a == kZero ? negate(b) : g_.make(Op::Subtract, a, b);
    }
    int divide(int a, int b) { return a == kZero ? kZero : g_.make(Op::Divide, a, b); }
    int number(int a) { return a == kZero ? g_.constant(0) : a; }
    int constant(double value) { return g_.constant(value); }
    int chosen(int condition, int a, int b) {
        return a == kZero && b == kZero ? kZero : g_.make(Op::Select, condition, number(a), number(b));
    }
    /// `a`, or 0 where `at` is 0: there the slope is infinite or has no direction.
    int zeroWhereZero(int at, int a) { return chosen(g_.make(Op::Equal, at, constant(0)), kZero, a); }

    int of(int n, int slot) {
        const FormulaNode node = g_.node(n);
        if (node.op == Op::Variable) return node.payload == static_cast<std::uint64_t>(slot) ? constant(1) : kZero;
        std::array<int, 3> d{kZero, kZero, kZero};
        for (std::size_t i = 0; i < 3; ++i)
            if (node.in[i] >= 0) d[i] = (*this)[node.in[i]];
        if (std::all_of(d.begin(), d.end(), [](int x) { return x == kZero; })) return kZero;
        if (node.op == Op::Select) return chosen(node.in[0], d[1], d[2]);
        if (node.op == Op::Noise) return ofNoise(node, d);
        return operandCount(node.op) == 1 ? ofOne(n, node, d[0]) : ofTwo(n, node, d[0], d[1]);
    }

    int ofOne(int n, const FormulaNode& node, int d) {
        const int a = node.in[0];
        switch (node.op) {
            case Op::Negate:
                return negate(d);
            case Op::Absolute:
                return multiply(g_.make(Op::Sign, a), d);
            case Op::Fract:
                return d;
            case Op::SquareRoot:
                return zeroWhereZero(n, divide(d, multiply(constant(2), n)));
            case Op::Hermite:
                return multiply(multiply(constant(6), subtract(a, g_.power(a, 2))), d);
            case Op::Sine:
                return multiply(g_.make(Op::Cosine, a), d);
            case Op::Cosine:
                return negate(multiply(g_.make(Op::Sine, a), d));
            case Op::Tangent:
                return multiply(add(constant(1), g_.power(n, 2)), d);
            case Op::ArcSine:
                return overRootOfOneLessSquare(a, d);
            case Op::ArcCosine:
                return negate(overRootOfOneLessSquare(a, d));
            case Op::ArcTangent:
                return divide(d, add(constant(1), g_.power(a, 2)));
            case Op::SineH:
                return multiply(g_.make(Op::CosineH, a), d);
            case Op::CosineH:
                return multiply(g_.make(Op::SineH, a), d);
            case Op::TangentH:
                return multiply(subtract(constant(1), g_.power(n, 2)), d);
            case Op::Exponential:
                return multiply(n, d);
            case Op::Logarithm:
                return divide(d, a);
            case Op::Logarithm2:
                return divide(d, multiply(constant(std::numbers::ln2), a));
            case Op::IntegerPower: {
                const int exponent = static_cast<int>(node.payload);
                return multiply(multiply(constant(exponent), g_.power(a, exponent - 1)), d);
            }
            default:
                return kZero;  // floor, ceil, sign, not: steps
        }
    }

    int overRootOfOneLessSquare(int a, int d) {
        // (1 − a)(1 + a) loses nothing near ±1, where 1 − a² would.
        const int square = multiply(subtract(constant(1), a), add(constant(1), a));
        return zeroWhereZero(square, divide(d, g_.make(Op::SquareRoot, square)));
    }

    int ofTwo(int n, const FormulaNode& node, int da, int db) {
        const int a = node.in[0], b = node.in[1];
        switch (node.op) {
            case Op::Add:
                return add(da, db);
            case Op::Subtract:
                return subtract(da, db);
            case Op::Multiply:
                // The square is common and costs one product less so.
                if (a == b) return multiply(multiply(constant(2), a), da);
                return add(multiply(da, b), multiply(a, db));
            case Op::Divide:
                return divide(subtract(da, multiply(n, db)), b);
            case Op::Power:
                return ofPower(n, a, b, da, db);
            case Op::Modulo:
                return subtract(da, multiply(g_.make(Op::Floor, g_.make(Op::Divide, a, b)), db));
            case Op::Minimum:
                return chosen(g_.make(Op::Less, b, a), db, da);
            case Op::Maximum:
                return chosen(g_.make(Op::Less, a, b), db, da);
            case Op::ArcTangent2: {
                const int square = add(g_.power(a, 2), g_.power(b, 2));
                return zeroWhereZero(square, divide(subtract(multiply(da, b), multiply(a, db)), square));
            }
            default:
                return kZero;  // conditions
        }
    }

    /// a^b: b a^(b−1) da + a^b ln(a) db. At a = 0 the first is 0 for b < 1, the second always; and that is 0 where b
    /// rests, since a negative number may have its whole powers.
    int ofPower(int n, int a, int b, int da, int db) {
        int first = kZero;
        if (da != kZero) {
            first = multiply(multiply(b, g_.make(Op::Power, a, subtract(b, constant(1)))), da);
            const int steep = g_.make(Op::And, g_.make(Op::Equal, a, constant(0)), g_.make(Op::Less, b, constant(1)));
            first = chosen(steep, kZero, first);
        }
        if (db == kZero) return first;
        const int second = zeroWhereZero(a, multiply(multiply(n, g_.make(Op::Logarithm, a)), db));
        return add(first, zeroWhereZero(db, second));
    }

    int ofNoise(const FormulaNode& node, const std::array<int, 3>& d) {
        int sum = kZero;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto order = noiseOrder(node.payload);
            ++order[axis];
            // A product of polynomials of degree 5 and 1: nothing is left of the seventh derivative.
            if (d[axis] != kZero && order[axis] <= 6) sum = add(sum, multiply(g_.noise(node.in, order), d[axis]));
        }
        return sum;
    }

    GraphBuilder& g_;
    std::vector<int> derivative_;
};

}  // namespace

FormulaGraph FormulaGraph::withDerivatives(std::span<const int> by) const {
    GraphBuilder builder(nodes_->nodes);
    const std::size_t count = nodes_->nodes.size();
    std::vector<Forward> derivatives;
    for (const int slot : by) {
        assert(slot >= 0 && slot < nodes_->variables);
        derivatives.emplace_back(builder, count, slot);
    }
    std::vector<int> outputs = nodes_->outputs;
    for (const int output : nodes_->outputs)
        for (const Forward& derivative : derivatives) {
            const int d = derivative[output];
            outputs.push_back(d == kZero ? builder.constant(0) : d);
        }
    return FormulaGraph(finished(builder, outputs, nodes_->variables, nodes_->parameters));
}

}  // namespace voledit
