#pragma once
// Formulas by a plain walk over their syntax trees, in any kind of number: the oracle of graphs, derivatives and GLSL.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "core/expression/noise.h"
#include "core/expression/scalar_ops.h"
#include "core/expression/syntax.h"

namespace voledit::test {

/// One scalar operation or function by its name, in real numbers of type T.
template <class T>
T realPrimitive(const std::string& f, T a, T b, T c) {
    using std::abs, std::floor, std::ceil, std::sqrt, std::sin, std::cos, std::tan, std::asin, std::acos, std::atan,
        std::atan2, std::sinh, std::cosh, std::tanh, std::exp, std::log, std::log2;
    const auto truth = [](bool x) { return x ? T(1) : T(0); };
    if (f == "+") return a + b;
    if (f == "-") return a - b;
    if (f == "*") return a * b;
    if (f == "/") return a / b;
    if (f == "negate") return -a;
    if (f == "<") return truth(a < b);
    if (f == "<=") return truth(a <= b);
    if (f == "==") return truth(a == b);
    if (f == "!=") return truth(a < b || a > b);
    if (f == "&&") return truth(a != 0 && b != 0);
    if (f == "||") return truth(a != 0 || b != 0);
    if (f == "!") return truth(a == 0);
    if (f == "select") return a != 0 ? b : c;
    if (f == "abs") return abs(a);
    if (f == "sign") return a > 0 ? T(1) : a < 0 ? T(-1) : a;
    if (f == "floor") return floor(a);
    if (f == "ceil") return ceil(a);
    if (f == "fract") return a - floor(a);
    if (f == "mod") return a - b * floor(a / b);
    // NaN of either side is kept.
    if (f == "min") return a != a || b != b ? a + b : std::min(a, b);
    if (f == "max") return a != a || b != b ? a + b : std::max(a, b);
    if (f == "sqrt") return sqrt(a);
    if (f == "sin") return sin(a);
    if (f == "cos") return cos(a);
    if (f == "tan") return tan(a);
    if (f == "asin") return asin(a);
    if (f == "acos") return acos(a);
    if (f == "atan") return atan(a);
    if (f == "atan2") return atan2(a + T(0), b + T(0));
    if (f == "sinh") return sinh(a);
    if (f == "cosh") return cosh(a);
    if (f == "tanh") return tanh(a);
    if (f == "exp") return exp(a);
    if (f == "log") return log(a);
    if (f == "log2") return log2(a);
    if (f == "noise") return T(noise(double(a), double(b), double(c), {0, 0, 0}));
    throw std::logic_error("no such function: " + f);
}

inline double primitive(const std::string& f, double a, double b, double c) {
    return f == "^" || f == "pow" ? scalar::power(a, b) : realPrimitive(f, a, b, c);
}

inline long double primitive(const std::string& f, long double a, long double b, long double c) {
    return f == "^" || f == "pow" ? std::pow(a, b) : realPrimitive(f, a, b, c);
}

/// Analytic functions only: an imaginary step h gives the derivative to full precision, Im f(x + ih) / h.
using Complex = std::complex<long double>;
inline Complex primitive(const std::string& f, const Complex& a, const Complex& b, const Complex&) {
    if (f == "+") return a + b;
    if (f == "-") return a - b;
    if (f == "*") return a * b;
    if (f == "/") return a / b;
    if (f == "negate") return -a;
    if (f == "^" || f == "pow") {
        if (b.imag() != 0 || b.real() != std::floor(b.real())) return std::pow(a, b);
        // std::pow of a whole exponent takes the logarithm of negative numbers, with an imaginary part of its own.
        Complex result = 1;
        for (int i = 0; i < int(std::abs(b.real())); ++i) result *= a;
        return b.real() < 0 ? Complex(1) / result : result;
    }
    if (f == "sqrt") return std::sqrt(a);
    if (f == "sin") return std::sin(a);
    if (f == "cos") return std::cos(a);
    if (f == "tanh") return std::tanh(a);
    // The library's complex arcs lose tiny imaginary parts.
    if (f == "atan") return {std::atan(a.real()), a.imag() / (1 + a.real() * a.real())};
    if (f == "exp") return std::exp(a);
    throw std::logic_error("no analytic function: " + f);
}

/// A value in double precision with a bound, to first order, of what single precision makes of it: every operation errs
/// by up to two units and is evaluated with its operands at both ends of their errors. An infinite error means that
/// nothing can be said.
struct Rounded {
    double value = 0, error = 0;
    Rounded() = default;
    Rounded(double v) : value(v), error(std::abs(v) * 0x1p-24) {}
    Rounded(double v, double e) : value(v), error(e) {}
};

inline Rounded primitive(const std::string& f, const Rounded& a, const Rounded& b, const Rounded& c) {
    constexpr double kUnits = 2 * 0x1p-23, kLargest = 1e37, kSmallest = 1e-37;
    const double value = primitive(f, a.value, b.value, c.value);
    if (f == "select") {
        if (a.error == 0) return a.value != 0 ? b : c;
        return {value, std::max(b.error, c.error) + std::abs(b.value - c.value)};
    }
    double error = 0;
    for (int corner = 0; corner < 27; ++corner) {
        const auto moved = [](const Rounded& r, int side) { return r.value + (side - 1) * r.error; };
        const double other = primitive(f, moved(a, corner % 3), moved(b, corner / 3 % 3), moved(c, corner / 9));
        double difference = value != value && other != other ? 0 : std::abs(other - value);
        // A sawtooth may fall in between and come back: then nothing but its height is known.
        const auto tooth = [&](double x, double y) { return std::floor(f == "mod" ? x / y : x); };
        if ((f == "mod" || f == "fract") &&
            tooth(moved(a, corner % 3), moved(b, corner / 3 % 3)) != tooth(a.value, b.value))
            difference = f == "mod" ? std::abs(b.value) + b.error : 1;
        error = std::max(error, difference == difference ? difference : kInfinity);
    }
    // Signs, conditions and whole numbers are exact once their operands are known well enough.
    const bool exact = f == "<" || f == "<=" || f == "==" || f == "!=" || f == "&&" || f == "||" || f == "!" ||
                       f == "negate" || f == "abs" || f == "sign" || f == "min" || f == "max" || f == "floor" ||
                       f == "ceil";
    if (!exact) error += std::abs(value) * kUnits + kSmallest;
    // These are sums whose terms may be larger than they: of mod x itself, of noise eight terms of about 1.
    if (f == "mod") error += std::abs(a.value) * kUnits;
    if (f == "noise") error += 4 * kUnits;
    return {value, std::abs(value) > kLargest ? kInfinity : error};
}

/// A number (width 1) or a vector of T.
template <class T>
struct OracleValue {
    int width = 1;
    std::array<T, 3> at{};
    const T& component(int c) const { return at[width == 1 ? 0 : std::size_t(c)]; }
};

template <class T>
class Oracle {
public:
    using Value = OracleValue<T>;
    using Names = std::map<std::string, Value>;

    Value evaluate(const std::string& text, const Names& names) {
        tree_ = parsedFormula({text, ""});
        names_ = names;
        names_["pi"] = {1, {T(kPi)}};
        for (const SyntaxLet& let : tree_.lets) names_[let.name] = walk(let.node);
        return walk(tree_.root);
    }

private:
    static Value number(const T& x) { return {1, {x}}; }

    Value each(const std::string& f, const Value& a, const Value& b = {}, const Value& c = {}) {
        Value result{std::max({a.width, b.width, c.width}), {}};
        for (int i = 0; i < result.width; ++i)
            result.at[std::size_t(i)] = primitive(f, a.component(i), b.component(i), c.component(i));
        return result;
    }
    T dot(const Value& a, const Value& b) {
        const Value products = each("*", a, b);
        return primitive("+", primitive("+", products.at[0], products.at[1], T()), products.at[2], T());
    }

    Value walk(int n) {
        const SyntaxNode& node = tree_.nodes[std::size_t(n)];
        const auto operand = [&](std::size_t i) { return walk(node.operands[i]); };
        switch (node.kind) {
            case Syntax::Number:
                return number(T(node.number));
            case Syntax::Name:
                return names_.at(node.name);
            case Syntax::Minus:
                return each("negate", operand(0));
            case Syntax::Not:
                return each("!", operand(0));
            case Syntax::Member:
                return number(operand(0).component(node.component));
            case Syntax::Index:
                return number(operand(0).component(int(tree_.nodes[std::size_t(node.operands[1])].number)));
            case Syntax::Vector:
                return {3, {operand(0).at[0], operand(1).at[0], operand(2).at[0]}};
            case Syntax::Call:
                return call(node);
            case Syntax::Greater:
                return each("<", operand(1), operand(0));
            case Syntax::GreaterEqual:
                return each("<=", operand(1), operand(0));
            default: {
                static const std::map<Syntax, std::string> kNames{
                    {Syntax::Or, "||"},      {Syntax::And, "&&"},      {Syntax::Less, "<"}, {Syntax::LessEqual, "<="},
                    {Syntax::Equal, "=="},   {Syntax::NotEqual, "!="}, {Syntax::Add, "+"},  {Syntax::Subtract, "-"},
                    {Syntax::Multiply, "*"}, {Syntax::Divide, "/"},    {Syntax::Power, "^"}};
                return each(kNames.at(node.kind), operand(0), operand(1));
            }
        }
    }

    Value call(const SyntaxNode& node) {
        std::vector<Value> a;
        for (const int operand : node.operands) a.push_back(walk(operand));
        const std::string& f = node.name;
        if (f == "vec") return {3, {a[0].at[0], a[1].at[0], a[2].at[0]}};
        if (f == "replace") {
            a[0].at[std::size_t(tree_.nodes[std::size_t(node.operands[1])].number)] = a[2].at[0];
            return a[0];
        }
        if (f == "clamp") return each("min", each("max", a[0], a[1]), a[2]);
        if (f == "mix") return each("+", each("*", a[0], each("-", number(T(1)), a[2])), each("*", a[1], a[2]));
        if (f == "step") return each("select", each("<", a[1], a[0]), number(T(0)), number(T(1)));
        if (f == "smoothstep") {
            Value t = each("/", each("-", a[2], a[0]), each("-", a[1], a[0]));
            t = each("min", each("max", t, number(T(0))), number(T(1)));
            return each("*", each("*", t, t), each("-", number(T(3)), each("*", number(T(2)), t)));
        }
        if (f == "dot") return number(dot(a[0], a[1]));
        if (f == "length") return each("sqrt", number(dot(a[0], a[0])));
        if (f == "normalize") return each("/", a[0], each("sqrt", number(dot(a[0], a[0]))));
        if (f == "cross") return cross(a[0], a[1]);
        if (f == "noise" && a.size() == 1) return number(primitive(f, a[0].at[0], a[0].at[1], a[0].at[2]));
        if (f == "rotate") return rotate(a[0], a[1], a[2]);
        return each(f, a[0], a.size() > 1 ? a[1] : Value{}, a.size() > 2 ? a[2] : Value{});
    }

    Value cross(const Value& a, const Value& b) {
        const auto turned = [](const Value& v, std::size_t by) {
            return Value{3, {v.at[by], v.at[(by + 1) % 3], v.at[(by + 2) % 3]}};
        };
        return each("-", each("*", turned(a, 1), turned(b, 2)), each("*", turned(a, 2), turned(b, 1)));
    }

    // v cos + (k × v) sin + k (k·v)(1 − cos).
    Value rotate(const Value& v, const Value& axis, const Value& angle) {
        const Value k = each("/", axis, each("sqrt", number(dot(axis, axis))));
        const Value cosine = each("cos", angle), sine = each("sin", angle);
        const Value along = number(dot(k, v));
        const Value turned = each("+", each("*", v, cosine), each("*", cross(k, v), sine));
        return each("+", turned, each("*", k, each("*", along, each("-", number(T(1)), cosine))));
    }

    SyntaxTree tree_;
    Names names_;
};

}  // namespace voledit::test
