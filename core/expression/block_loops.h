#pragma once
// The loops of block_kernels.h, included by one file for each kind of processor; everything here is local to it.
// Internal to core/expression.

#include <cmath>

#include "core/expression/block_kernels.h"
#include "core/expression/formula_graph.h"
#include "core/expression/scalar_ops.h"

namespace voledit {
namespace {

template <class F>
void one(F f, const BlockOperand& a, double* r, std::size_t n) {
    const double* x = a.values;
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i) r[i] = f(x[i]);
}

template <class F>
void two(F f, const BlockOperand& a, const BlockOperand& b, double* r, std::size_t n) {
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

/// `from` for all points.
void copyBlock(const BlockOperand& from, double* r, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) r[i] = from.values ? from.values[i] : from.uniform;
}

void selectBlock(const BlockOperand* in, double* r, std::size_t n) {
    const double *c = in[0].values, *x = in[1].values, *y = in[2].values;
    const double u = in[1].uniform, v = in[2].uniform;
    if (!c) {
        copyBlock(in[0].uniform != 0 ? in[1] : in[2], r, n);
    } else if (x && y) {
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

void noiseBlock(const BlockStep& step, std::size_t n) {
    const BlockOperand &a = step.in[0], &b = step.in[1], &c = step.in[2];
    for (std::size_t i = 0; i < n; ++i)
        step.result[i] = appliedNoise(step.payload, a.values ? a.values[i] : a.uniform,
                                      b.values ? b.values[i] : b.uniform, c.values ? c.values[i] : c.uniform);
}

/// The exponents that occur most, as loops without a loop inside; in the order of scalar::integerPower.
void integerPowerBlock(int exponent, const BlockOperand& a, double* r, std::size_t n) {
    switch (exponent) {
        case 1:
            return one([](double x) { return x; }, a, r, n);
        case 2:
            return one([](double x) { return x * x; }, a, r, n);
        case 3:
            return one([](double x) { return x * x * x; }, a, r, n);
        case 4:
            return one([](double x) { return (x * x) * (x * x); }, a, r, n);
        default:
            return one([exponent](double x) { return scalar::powerOfInteger(x, exponent); }, a, r, n);
    }
}

void powerBlock(const BlockOperand& a, const BlockOperand& b, double* r, std::size_t n) {
    if (!b.values && scalar::isIntegerPower(b.uniform)) {
        integerPowerBlock(static_cast<int>(b.uniform), a, r, n);
    } else {
        two([](double x, double y) { return scalar::power(x, y); }, a, b, r, n);
    }
}

void sineBlock(const BlockOperand& a, double* sine, double* cosine, std::size_t n) {
    const double* x = a.values;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = x[i];
        sine[i] = std::sin(angle);
        cosine[i] = std::cos(angle);
    }
}

void oneOperand(const BlockStep& step, std::size_t n) {
    const BlockOperand& a = step.in[0];
    double* r = step.result;
    switch (step.op) {
        case Op::Negate:
            return one([](double x) { return -x; }, a, r, n);
        case Op::Absolute:
            return one([](double x) { return std::abs(x); }, a, r, n);
        case Op::Sign:
            return one([](double x) { return scalar::sign(x); }, a, r, n);
        case Op::Floor:
            return one([](double x) { return std::floor(x); }, a, r, n);
        case Op::Ceil:
            return one([](double x) { return std::ceil(x); }, a, r, n);
        case Op::Fract:
            return one([](double x) { return scalar::fract(x); }, a, r, n);
        case Op::SquareRoot:
            return one([](double x) { return std::sqrt(x); }, a, r, n);
        case Op::Hermite:
            return one([](double x) { return scalar::hermite(x); }, a, r, n);
        case Op::Not:
            return one([](double x) { return 1.0 - x; }, a, r, n);
        case Op::IntegerPower:
            return integerPowerBlock(static_cast<int>(step.payload), a, r, n);
        default:
            return one([op = step.op](double x) { return appliedFunction(op, x); }, a, r, n);
    }
}

void twoOperands(const BlockStep& step, std::size_t n) {
    const BlockOperand &a = step.in[0], &b = step.in[1];
    double* r = step.result;
    switch (step.op) {
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
            return two([](double x, double y) { return scalar::modulo(x, y); }, a, b, r, n);
        case Op::Minimum:
            return two([](double x, double y) { return scalar::minimum(x, y); }, a, b, r, n);
        case Op::Maximum:
            return two([](double x, double y) { return scalar::maximum(x, y); }, a, b, r, n);
        case Op::ArcTangent2:
            return two([](double x, double y) { return scalar::arcTangent2(x, y); }, a, b, r, n);
        case Op::Less:
            return two([](double x, double y) { return scalar::less(x, y); }, a, b, r, n);
        case Op::LessEqual:
            return two([](double x, double y) { return scalar::lessEqual(x, y); }, a, b, r, n);
        case Op::Equal:
            return two([](double x, double y) { return scalar::equal(x, y); }, a, b, r, n);
        case Op::NotEqual:
            return two([](double x, double y) { return scalar::notEqual(x, y); }, a, b, r, n);
        default:
            return two([](double x, double y) { return x + y - x * y; }, a, b, r, n);
    }
}

void runBlock(const BlockStep& step, std::size_t n) {
    if (step.cosine)
        sineBlock(step.in[0], step.result, step.cosine, n);
    else if (step.op == Op::Select)
        selectBlock(step.in, step.result, n);
    else if (step.op == Op::Noise)
        noiseBlock(step, n);
    else if (operandCount(step.op) == 1)
        oneOperand(step, n);
    else
        twoOperands(step, n);
}

}  // namespace
}  // namespace voledit
