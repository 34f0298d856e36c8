#include "core/expression/interval_ops.h"

#include <algorithm>
#include <cmath>

#include "core/expression/noise.h"
#include "core/expression/scalar_ops.h"

namespace voledit {

namespace {

constexpr Range kAnything{};
constexpr double kHalfPi = kPi / 2;

/// From `low` to `high` grown by a few roundings: the C library's functions err by less than two. 0 stays 0, so that
/// what cannot be negative is known not to be.
Range grown(double low, double high, bool mayBeNaN) {
    constexpr double kRoundings = 4 * std::numeric_limits<double>::epsilon();
    constexpr double kLargest = std::numeric_limits<double>::max();
    const auto by = [](double x) {
        return std::max(std::abs(x) * kRoundings, std::numeric_limits<double>::denorm_min());
    };
    if (low != low) low = -kInfinity;
    if (high != high) high = kInfinity;
    // Bounds beyond the largest number: it is the nearest.
    if (low == kInfinity) low = kLargest;
    if (high == -kInfinity) high = -kLargest;
    return {low == 0 ? 0 : low - by(low), high == 0 ? 0 : high + by(high), mayBeNaN};
}

Range cut(const Range& a, double low, double high) {
    return {std::clamp(a.low, low, high), std::clamp(a.high, low, high), a.mayBeNaN};
}

/// Bounds of a function that rises (or falls) all along.
template <class F>
Range monotone(const Range& a, F f) {
    const double first = f(a.low), last = f(a.high);
    return grown(std::min(first, last), std::max(first, last), a.mayBeNaN);
}

/// Product of two bounds. An infinite one is never reached, so 0·∞ is 0; one too small for a number is no 0.
double product(double a, double b) {
    if (a == 0 || b == 0) return 0;
    const double result = a * b;
    return result == 0 ? std::copysign(std::numeric_limits<double>::denorm_min(), result) : result;
}

Range multiplied(const Range& a, const Range& b) {
    const std::array<double, 4> p{product(a.low, b.low), product(a.low, b.high), product(a.high, b.low),
                                  product(a.high, b.high)};
    const auto [low, high] = std::minmax_element(p.begin(), p.end());
    return grown(*low, *high, a.mayBeNaN || b.mayBeNaN || !a.finite() || !b.finite());
}

/// Bounds of an even function that grows away from 0, where it is `least`.
template <class F>
Range even(const Range& a, double least, F f) {
    const double low = f(a.low), high = f(a.high);
    const Range result = grown(std::min(low, high), std::max(low, high), a.mayBeNaN);
    return {a.contains(0) ? least : std::max(result.low, least), result.high, result.mayBeNaN};
}

Range squared(const Range& a) {
    return even(a, 0, [](double x) { return product(x, x); });
}

Range divided(const Range& a, const Range& b) {
    if (b.contains(0)) return kAnything;
    const auto inverse = Range{1 / b.high, 1 / b.low, b.mayBeNaN};
    // Rounded twice: grown once by the inverse, once by the product.
    Range result = multiplied(a, grown(inverse.low, inverse.high, b.mayBeNaN));
    result.mayBeNaN = a.mayBeNaN || b.mayBeNaN || (!a.finite() && !b.finite());
    return result;
}

Range added(const Range& a, const Range& b) {
    return grown(a.low + b.low, a.high + b.high, a.mayBeNaN || b.mayBeNaN || (!a.finite() && !b.finite()));
}

Range negated(const Range& a) {
    return {-a.high, -a.low, a.mayBeNaN};
}

Range integerPower(const Range& a, int n) {
    const auto power = [n](double x) {
        const double result = scalar::integerPower(x, n);
        return result == 0 && x != 0 ? std::copysign(std::numeric_limits<double>::denorm_min(), n % 2 ? x : 1.0)
                                     : result;
    };
    Range result = n % 2 ? monotone(a, power) : even(a, 0, power);
    // Up to n − 1 roundings of half a unit, where `grown` once allows for four units.
    for (int i = 8; i < n; i += 8) result = grown(result.low, result.high, result.mayBeNaN);
    if (n % 2 == 0) result.low = std::max(result.low, 0.0);
    return result;
}

/// True if some offset + k·period lies in [low, high], allowing for rounding: it errs towards true.
bool meets(const Range& a, double offset, double period) {
    const double slack = 1e-9 + 4e-16 * std::max(std::abs(a.low), std::abs(a.high));
    return std::floor((a.high - offset) / period + slack) >= std::ceil((a.low - offset) / period - slack);
}

/// Of a cosine shifted so that it peaks at `peak`.
template <class F>
Range wave(const Range& a, double peak, F f) {
    if (!a.finite() || std::max(std::abs(a.low), std::abs(a.high)) > 1e12) return {-1, 1, a.mayBeNaN || !a.finite()};
    const double first = f(a.low), last = f(a.high);
    Range result = grown(std::min(first, last), std::max(first, last), a.mayBeNaN);
    if (meets(a, peak, 2 * kPi)) result.high = 1;
    if (meets(a, peak + kPi, 2 * kPi)) result.low = -1;
    return cut(result, -1, 1);
}

Range tangent(const Range& a) {
    if (!a.finite() || std::max(std::abs(a.low), std::abs(a.high)) > 1e12 || meets(a, kHalfPi, kPi)) return kAnything;
    return monotone(a, [](double x) { return std::tan(x); });
}

/// An increasing (or decreasing) function on [least, most]; NaN beyond.
template <class F>
Range onDomain(const Range& a, double least, double most, F f) {
    Range result = monotone(cut(a, least, most), f);
    result.mayBeNaN = a.mayBeNaN || a.low < least || a.high > most;
    return result;
}

Range stepped(const Range& a, double (*f)(double)) {
    return {f(a.low), f(a.high), a.mayBeNaN};
}

Range fract(const Range& a) {
    const double base = std::floor(a.low);
    const bool oneCell = a.finite() && base == std::floor(a.high);
    if (!oneCell) return {0, 1, a.mayBeNaN || !a.finite()};
    return {a.low - base, a.high - base, a.mayBeNaN};
}

Range hermite(const Range& a) {
    if (a.low >= 0 && a.high <= 1) return cut(monotone(a, scalar::hermite), 0, 1 + 1e-15);
    return multiplied(squared(a), added({3, 3, false}, negated(multiplied({2, 2, false}, a))));
}

Range modulo(const Range& x, const Range& y) {
    if (y.contains(0) || !x.finite() || !y.finite()) return kAnything;
    const Range quotient = divided(x, y);
    const double k = std::floor(quotient.low);
    const bool mayBeNaN = x.mayBeNaN || y.mayBeNaN;
    if (k == std::floor(quotient.high)) {
        Range result = added(x, negated(multiplied(y, {k, k, false})));
        result.mayBeNaN = mayBeNaN;
        return result;
    }
    // Rounding of the quotient may push the result past 0 or y by this much.
    const double slack =
        4e-16 * (std::max(std::abs(x.low), std::abs(x.high)) + std::max(std::abs(y.low), std::abs(y.high)));
    return y.low > 0 ? Range{-slack, y.high + slack, mayBeNaN} : Range{y.low - slack, slack, mayBeNaN};
}

Range realPower(Range a, const Range& b) {
    if (b.low == b.high && scalar::isIntegerPower(b.low)) {
        const int n = static_cast<int>(b.low);
        if (n == 0) return {1, 1, false};
        if (n == 1) return a;
        if (n > 0) return n == 2 ? squared(a) : integerPower(a, n);
        return divided({1, 1, false}, n == -1 ? a : n == -2 ? squared(a) : integerPower(a, -n));
    }
    if (a.low < 0 && b.low == b.high && b.low != std::floor(b.low)) a = {0, std::max(a.high, 0.0), true};
    if (!(a.low > 0) && !(a.low == 0 && b.low > 0)) return kAnything;
    // The logarithm, y ln x, is linear in y and monotone in x, so extremes are at corners.
    const std::array<double, 4> corners{std::pow(a.low, b.low), std::pow(a.low, b.high), std::pow(a.high, b.low),
                                        std::pow(a.high, b.high)};
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
    Range result = grown(*low, *high, a.mayBeNaN || b.mayBeNaN || !a.finite() || !b.finite());
    // Whole exponents up to 16 in between are multiplied out, with their roundings.
    result = grown(result.low, result.high, result.mayBeNaN);
    if (result.high == 0) result.high = std::numeric_limits<double>::denorm_min();
    result.low = std::max(result.low, 0.0);
    return result;
}

/// Angles of the points of a box.
Range arcTangent2(const Range& y, const Range& x) {
    const bool mayBeNaN = x.mayBeNaN || y.mayBeNaN;
    // The angle jumps below the negative x axis, which itself has +pi. Elsewhere the extremes are at corners.
    if (x.low < 0 && y.low < 0 && y.high >= 0) return grown(-kPi, kPi, mayBeNaN);
    double low = kInfinity, high = -kInfinity;
    for (const double v : {y.low, y.high})
        for (const double u : {x.low, x.high}) {
            const double angle = scalar::arcTangent2(v, u);
            low = std::min(low, angle);
            high = std::max(high, angle);
        }
    return grown(low, high, mayBeNaN);
}

Range truth(bool surelyTrue, bool surelyFalse) {
    return {surelyTrue ? 1.0 : 0.0, surelyFalse ? 0.0 : 1.0, false};
}

Range compared(Op op, const Range& a, const Range& b) {
    const bool numbers = !a.mayBeNaN && !b.mayBeNaN;
    const bool apart = a.high < b.low || b.high < a.low;
    const bool same = a.low == a.high && b.low == b.high && a.low == b.low;
    switch (op) {
        case Op::Less:
            return truth(numbers && a.high < b.low, a.low >= b.high);
        case Op::LessEqual:
            return truth(numbers && a.high <= b.low, a.low > b.high);
        case Op::Equal:
            return truth(numbers && same, apart);
        default:
            return truth(numbers && apart, same);
    }
}

Range selected(const Range& condition, const Range& a, const Range& b) {
    if (condition.low > 0) return a;
    if (condition.high <= 0) return b;
    return {std::min(a.low, b.low), std::max(a.high, b.high), a.mayBeNaN || b.mayBeNaN};
}

Range rangeOfOne(const FormulaNode& node, const Range& a) {
    switch (node.op) {
        case Op::Negate:
            return negated(a);
        case Op::Absolute:
            return {a.contains(0) ? 0 : std::min(std::abs(a.low), std::abs(a.high)),
                    std::max(std::abs(a.low), std::abs(a.high)), a.mayBeNaN};
        case Op::Sign:
            return stepped(a, scalar::sign);
        case Op::Floor:
            return stepped(a, [](double x) { return std::floor(x); });
        case Op::Ceil:
            return stepped(a, [](double x) { return std::ceil(x); });
        case Op::Fract:
            return fract(a);
        case Op::SquareRoot: {
            Range result = onDomain(a, 0, kInfinity, [](double x) { return std::sqrt(x); });
            result.low = std::max(result.low, 0.0);
            return result;
        }
        case Op::Hermite:
            return hermite(a);
        case Op::Sine:
            return wave(a, kHalfPi, [](double x) { return std::sin(x); });
        case Op::Cosine:
            return wave(a, 0, [](double x) { return std::cos(x); });
        case Op::Tangent:
            return tangent(a);
        case Op::ArcSine:
            return onDomain(a, -1, 1, [](double x) { return std::asin(x); });
        case Op::ArcCosine:
            return onDomain(a, -1, 1, [](double x) { return std::acos(x); });
        case Op::ArcTangent:
            return monotone(a, [](double x) { return std::atan(x); });
        case Op::SineH:
            return monotone(a, [](double x) { return std::sinh(x); });
        case Op::CosineH:
            return even(a, 1, [](double x) { return std::cosh(x); });
        case Op::TangentH:
            return cut(monotone(a, [](double x) { return std::tanh(x); }), -1, 1);
        case Op::Exponential: {
            Range result = monotone(a, [](double x) { return std::exp(x); });
            if (result.high == 0) result.high = std::numeric_limits<double>::denorm_min();
            result.low = std::max(result.low, 0.0);
            return result;
        }
        case Op::Logarithm:
            return onDomain(a, 0, kInfinity, [](double x) { return std::log(x); });
        case Op::Logarithm2:
            return onDomain(a, 0, kInfinity, [](double x) { return std::log2(x); });
        case Op::Not:
            return {1 - a.high, 1 - a.low, false};
        case Op::IntegerPower:
            return integerPower(a, static_cast<int>(node.payload));
        default:
            return kAnything;
    }
}

Range rangeOfTwo(const FormulaNode& node, const Range& a, const Range& b) {
    const bool mayBeNaN = a.mayBeNaN || b.mayBeNaN;
    switch (node.op) {
        case Op::Add:
            return added(a, b);
        case Op::Subtract:
            return node.in[0] == node.in[1] ? Range{0, 0, mayBeNaN || !a.finite()} : added(a, negated(b));
        case Op::Multiply:
            return node.in[0] == node.in[1] ? squared(a) : multiplied(a, b);
        case Op::Divide:
            return divided(a, b);
        case Op::Power:
            return realPower(a, b);
        case Op::Modulo:
            return modulo(a, b);
        case Op::Minimum:
            return {std::min(a.low, b.low), std::min(a.high, b.high), mayBeNaN};
        case Op::Maximum:
            return {std::max(a.low, b.low), std::max(a.high, b.high), mayBeNaN};
        case Op::ArcTangent2:
            return arcTangent2(a, b);
        case Op::And:
            return {a.low * b.low, a.high * b.high, false};
        case Op::Or:
            return {std::max(a.low, b.low), std::max(a.high, b.high), false};
        default:
            return compared(node.op, a, b);
    }
}

Range noiseRange(const FormulaNode& node, const std::array<Range, 3>& in) {
    const auto order = noiseOrder(node.payload);
    const double bound = noiseBound(order);
    bool mayBeNaN = false;
    std::array<double, 3> middle{};
    double change = 0;  // largest departure from the value in the middle
    for (std::size_t axis = 0; axis < 3; ++axis) {
        mayBeNaN = mayBeNaN || in[axis].mayBeNaN || !in[axis].finite();
        auto steeper = order;
        ++steeper[axis];
        middle[axis] = 0.5 * in[axis].low + 0.5 * in[axis].high;
        change += (in[axis].high - in[axis].low) / 2 * noiseBound(steeper);
    }
    const int degree = order[0] + order[1] + order[2];
    // Up to the second, derivatives are continuous: they change no faster than the next one allows.
    if (mayBeNaN || degree > 2 || !(change < 2 * bound)) return {-bound, bound, mayBeNaN};
    const double value = noise(middle[0], middle[1], middle[2], order);
    const double slack = 1e-12 * (bound + change);
    return cut({value - change - slack, value + change + slack, false}, -bound, bound);
}

}  // namespace

Range rangeOf(const FormulaNode& node, const std::array<Range, 3>& in) {
    if (node.op == Op::Select) return selected(in[0], in[1], in[2]);
    if (node.op == Op::Noise) return noiseRange(node, in);
    return operandCount(node.op) == 1 ? rangeOfOne(node, in[0]) : rangeOfTwo(node, in[0], in[1]);
}

}  // namespace voledit
