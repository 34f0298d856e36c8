#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "core/base/parallel.h"
#include "core/expression/formula_graph.h"
#include "core/expression/noise.h"
#include "core/expression/scalar_ops.h"

namespace voledit {

namespace {

using Kind = FormulaPlace::Kind;

/// An operand over a block: one number for each point, or one for all.
struct Operand {
    const double* values = nullptr;  // null: `uniform`
    double uniform = 0;
};

template <class F>
void one(F f, const Operand& a, double* r, std::size_t n) {
    const double* x = a.values;
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i) r[i] = f(x[i]);
}

template <class F>
void two(F f, const Operand& a, const Operand& b, double* r, std::size_t n) {
    const double *x = a.values, *y = b.values;
    if (x && y) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = f(x[i], y[i]);
    } else if (x) {
        const double u = b.uniform;
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = f(x[i], u);
    } else {
        const double u = a.uniform;
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = f(u, y[i]);
    }
}

void selectBlock(const Operand& condition, const Operand& a, const Operand& b, double* r, std::size_t n) {
    const double *x = a.values, *y = b.values;
    if (!condition.values) {
        const Operand& chosen = condition.uniform != 0 ? a : b;
        if (chosen.values)
            std::copy_n(chosen.values, n, r);
        else
            std::fill_n(r, n, chosen.uniform);
        return;
    }
    const double* c = condition.values;
    const double u = a.uniform, v = b.uniform;
    if (x && y) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = c[i] != 0 ? x[i] : y[i];
    } else if (x) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = c[i] != 0 ? x[i] : v;
    } else if (y) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = c[i] != 0 ? u : y[i];
    } else {
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) r[i] = c[i] != 0 ? u : v;
    }
}

void noiseBlock(std::uint64_t payload, const std::array<Operand, 3>& in, double* r, std::size_t n) {
    const auto order = noiseOrder(payload);
    const auto at = [&](const Operand& o, std::size_t i) { return o.values ? o.values[i] : o.uniform; };
    for (std::size_t i = 0; i < n; ++i) r[i] = noise(at(in[0], i), at(in[1], i), at(in[2], i), order);
}

void powerBlock(const Operand& a, const Operand& b, double* r, std::size_t n) {
    if (!b.values && scalar::isIntegerPower(b.uniform)) {
        const int exponent = static_cast<int>(b.uniform);
        one([exponent](double x) { return scalar::powerOfInteger(x, exponent); }, a, r, n);
    } else {
        two([](double x, double y) { return scalar::power(x, y); }, a, b, r, n);
    }
}

void sineBlock(const Operand& a, double* sine, double* cosine, std::size_t n) {
    const double* x = a.values;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = x[i];
        sine[i] = std::sin(angle);
        cosine[i] = std::cos(angle);
    }
}

void oneOperand(const FormulaStep& step, const Operand& a, double* r, std::size_t n) {
    switch (step.op) {
        case Op::Negate:
            return one([](double x) { return -x; }, a, r, n);
        case Op::Absolute:
            return one([](double x) { return std::abs(x); }, a, r, n);
        case Op::Sign:
            return one(scalar::sign, a, r, n);
        case Op::Floor:
            return one([](double x) { return std::floor(x); }, a, r, n);
        case Op::Ceil:
            return one([](double x) { return std::ceil(x); }, a, r, n);
        case Op::Fract:
            return one(scalar::fract, a, r, n);
        case Op::SquareRoot:
            return one([](double x) { return std::sqrt(x); }, a, r, n);
        case Op::Hermite:
            return one(scalar::hermite, a, r, n);
        case Op::Not:
            return one([](double x) { return 1.0 - x; }, a, r, n);
        case Op::IntegerPower: {
            const int exponent = static_cast<int>(step.payload);
            return one([exponent](double x) { return scalar::integerPower(x, exponent); }, a, r, n);
        }
        default: {
            const FormulaNode node{.op = step.op, .payload = step.payload};
            return one([&node](double x) { return applied(node, x, 0, 0); }, a, r, n);
        }
    }
}

void twoOperands(Op op, const Operand& a, const Operand& b, double* r, std::size_t n) {
    switch (op) {
        case Op::Add:
            return two([](double x, double y) { return x + y; }, a, b, r, n);
        case Op::Subtract:
            return two([](double x, double y) { return x - y; }, a, b, r, n);
        case Op::Multiply:
        case Op::And:
            return two([](double x, double y) { return x * y; }, a, b, r, n);
        case Op::Divide:
            return two([](double x, double y) { return x / y; }, a, b, r, n);
        case Op::Power:
            return powerBlock(a, b, r, n);
        case Op::Modulo:
            return two(scalar::modulo, a, b, r, n);
        case Op::Minimum:
            return two(scalar::minimum, a, b, r, n);
        case Op::Maximum:
            return two(scalar::maximum, a, b, r, n);
        case Op::ArcTangent2:
            return two(scalar::arcTangent2, a, b, r, n);
        case Op::Less:
            return two(scalar::less, a, b, r, n);
        case Op::LessEqual:
            return two(scalar::lessEqual, a, b, r, n);
        case Op::Equal:
            return two(scalar::equal, a, b, r, n);
        case Op::NotEqual:
            return two(scalar::notEqual, a, b, r, n);
        default:
            return two([](double x, double y) { return x + y - x * y; }, a, b, r, n);
    }
}

/// One call of `evaluate`: its arrays and the values that are the same for all points.
class Evaluation {
public:
    Evaluation(const FormulaGraph::Nodes& graph, std::span<const double* const> variables,
               std::span<const double> parameters, std::span<double* const> outputs, std::size_t count)
        : program_(graph.program),
          variables_(variables),
          outputs_(outputs),
          uniform_(program_.hasUniforms ? graph.nodes.size() : 0) {
        if (program_.hasUniforms) evaluateUniform(graph, parameters, uniform_);
        stride_ = std::min(count, kFormulaBlock);
        registers_ = std::make_unique_for_overwrite<double[]>(stride_ * static_cast<std::size_t>(program_.registers));
    }

    /// Points from `begin` on, at most kFormulaBlock.
    void run(std::size_t begin, std::size_t n) {
        begin_ = begin;
        for (const FormulaStep& step : program_.steps) runStep(step, n);
        for (const auto& [output, from] : program_.copies) {
            const Operand source = operand(from);
            if (source.values)
                std::copy_n(source.values, n, outputs_[static_cast<std::size_t>(output)] + begin);
            else
                std::fill_n(outputs_[static_cast<std::size_t>(output)] + begin, n, source.uniform);
        }
    }

private:
    Operand operand(const FormulaPlace& place) const {
        const std::size_t index = static_cast<std::size_t>(place.index);
        switch (place.kind) {
            case Kind::Register:
                return {registers_.get() + index * stride_};
            case Kind::Variable:
                return {variables_[index] + begin_};
            case Kind::Output:
                return {outputs_[index] + begin_};
            case Kind::Uniform:
                return {nullptr, uniform_[index]};
            default:
                return {};
        }
    }
    double* target(const FormulaPlace& place) const {
        const std::size_t index = static_cast<std::size_t>(place.index);
        return place.kind == Kind::Output ? outputs_[index] + begin_ : registers_.get() + index * stride_;
    }

    void runStep(const FormulaStep& step, std::size_t n) const {
        const std::array<Operand, 3> in{operand(step.in[0]), operand(step.in[1]), operand(step.in[2])};
        double* result = target(step.out);
        if (step.cosine.kind != Kind::None)
            sineBlock(in[0], result, target(step.cosine), n);
        else if (step.op == Op::Select)
            selectBlock(in[0], in[1], in[2], result, n);
        else if (step.op == Op::Noise)
            noiseBlock(step.payload, in, result, n);
        else if (operandCount(step.op) == 1)
            oneOperand(step, in[0], result, n);
        else
            twoOperands(step.op, in[0], in[1], result, n);
    }

    const FormulaProgram& program_;
    std::span<const double* const> variables_;
    std::span<double* const> outputs_;
    std::vector<double> uniform_;
    std::size_t stride_ = 0, begin_ = 0;
    std::unique_ptr<double[]> registers_;
};

void evaluateRange(const FormulaGraph::Nodes& graph, std::span<const double* const> variables,
                   std::span<const double> parameters, std::span<double* const> outputs, std::size_t begin,
                   std::size_t end) {
    Evaluation evaluation(graph, variables, parameters, outputs, end - begin);
    for (; begin < end; begin += kFormulaBlock) evaluation.run(begin, std::min(kFormulaBlock, end - begin));
}

}  // namespace

void FormulaGraph::evaluate(std::span<const double* const> variables, std::span<const double> parameters,
                            std::span<double* const> outputs, std::size_t count) const {
    assert(variables.size() >= static_cast<std::size_t>(variableCount()));
    assert(parameters.size() >= static_cast<std::size_t>(parameterCount()));
    assert(outputs.size() >= static_cast<std::size_t>(outputCount()));
    if (count) evaluateRange(*nodes_, variables, parameters, outputs, 0, count);
}

void FormulaGraph::evaluateParallel(std::span<const double* const> variables, std::span<const double> parameters,
                                    std::span<double* const> outputs, std::size_t count) const {
    constexpr std::size_t kGrain = 32 * kFormulaBlock;
    parallelFor(count, kGrain, [&](std::size_t begin, std::size_t end) {
        evaluateRange(*nodes_, variables, parameters, outputs, begin, end);
    });
}

}  // namespace voledit
