#pragma once
// Random formulas from the grammar, for properties that all formulas have.

#include <random>
#include <string>
#include <vector>

#include "core/expression/formula.h"

namespace voledit::test {

/// The names that random formulas use: numbers x, y, z and a vector v that vary; parameters p, q and a vector w.
inline FormulaSymbols randomFormulaSymbols() {
    return {{{"x"}, {"y"}, {"z"}, {"v", 3}}, {{"p"}, {"q"}, {"w", 3}}, {}};
}
inline constexpr int kRandomVariables = 6, kRandomParameters = 5;  // slots

class RandomFormulas {
public:
    struct Kinds {
        bool steps = true;  // floor, comparisons, min … : else analytic functions only
        bool noise = true;
        bool wild = true;  // also what is undefined or overflows in places: log, tan, division, powers of expressions
    };
    RandomFormulas(unsigned seed, Kinds kinds) : random_(seed), kinds_(kinds) {}

    /// A formula that gives a number, with at most `depth` levels below it.
    std::string number(int depth) {
        if (depth <= 0) return leaf();
        std::vector<int> choices{0, 0, 0, 1, 1, 1, 1, 2, 3, 4};
        if (kinds_.steps) choices.insert(choices.end(), {5, 5, 6});
        if (kinds_.noise) choices.push_back(7);
        switch (choices[std::size_t(below(int(choices.size())))]) {
            case 0:
                return leaf();
            case 1:
                return binary(depth);
            case 2:
                return "-(" + number(depth - 1) + ")";
            case 3:
                return fromVector(depth);
            case 4:
                return smooth(depth);
            case 5:
                return stepped(depth);
            case 6:
                return "select(" + condition(depth - 1) + ", " + number(depth - 1) + ", " + number(depth - 1) + ")";
            default:
                return "noise(" + number(depth - 1) + ", " + number(depth - 1) + ", " + leaf() + ")";
        }
    }

    std::string vector(int depth) {
        if (depth <= 0) return pick({"v", "w", "[x, y, z]", "vec(0.5, y, 2)"});
        switch (below(kinds_.steps ? 8 : 7)) {
            case 0:
                return vector(0);
            case 1:
                return "vec(" + number(depth - 1) + ", " + leaf() + ", " + number(depth - 1) + ")";
            case 2:
                return "(" + vector(depth - 1) + pick({" + ", " - ", " * "}) + vector(depth - 1) + ")";
            case 3:
                return "cross(" + vector(depth - 1) + ", " + vector(depth - 1) + ")";
            case 4:
                return "rotate(" + vector(depth - 1) + ", [0.3, -0.5, 0.8], " + number(depth - 1) + ")";
            case 5:
                return "replace(" + vector(depth - 1) + ", " + pick({"0", "1", "2"}) + ", " + number(depth - 1) + ")";
            case 6:
                return pick({"sin(", "cos("}) + vector(depth - 1) + ")";
            default:
                return "mix(" + vector(depth - 1) + ", " + vector(depth - 1) + ", " + number(depth - 1) + ")";
        }
    }

    std::string condition(int depth) {
        if (depth <= 0 || below(3) > 0)
            return "(" + number(depth - 1) + pick({" < ", " <= ", " > ", " >= ", " == ", " != "}) + number(depth - 1) +
                   ")";
        if (below(3) == 0) return "!" + condition(depth - 1);
        return "(" + condition(depth - 1) + pick({" && ", " || "}) + condition(depth - 1) + ")";
    }

    /// Evenly in [low, high], a single-precision number.
    double value(double low, double high) {
        return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random_));
    }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

private:
    std::string pick(const std::vector<std::string>& from) { return from[std::size_t(below(int(from.size())))]; }

    std::string leaf() {
        return pick(
            {"x", "y", "z", "x", "y", "z", "p", "q", "v.x", "w.y", "v[2]", "0.5", "2", "1.25", "3", "pi", "0.1"});
    }

    std::string binary(int depth) {
        std::string op = pick({" + ", " - ", " * "});
        if (kinds_.wild && below(5) == 0) op = " / ";
        if (below(8) == 0) return "(" + number(depth - 1) + ")^" + pick({"2", "3", "4", "-1", "5"});
        if (kinds_.wild && below(12) == 0) return "(" + number(depth - 1) + ")^(" + number(depth - 1) + ")";
        return "(" + number(depth - 1) + op + number(depth - 1) + ")";
    }

    std::string fromVector(int depth) {
        switch (below(4)) {
            case 0:
                return "dot(" + vector(depth - 1) + ", " + vector(depth - 1) + ")";
            case 1:
                return "length(" + vector(depth - 1) + ")";
            case 2:
                return vector(depth - 1) + pick({".x", ".y", ".z", "[1]"});
            default:
                return "normalize(" + vector(depth - 1) + ").y";
        }
    }

    std::string smooth(int depth) {
        if (kinds_.wild && below(2) == 0)
            return pick({"tan(", "asin(", "acos(", "log(", "log2(", "sqrt(", "exp(", "sinh(", "cosh("}) +
                   number(depth - 1) + ")";
        if (below(8) == 0) return "sqrt(2 + sin(" + number(depth - 1) + "))";
        return pick({"sin(", "cos(", "tanh(", "atan(", "sin(", "cos(", "exp(0.5 * "}) + number(depth - 1) + ")";
    }

    std::string stepped(int depth) {
        const std::string a = number(depth - 1), b = number(depth - 1);
        switch (below(12)) {
            case 0:
                return "min(" + a + ", " + b + ")";
            case 1:
                return "max(" + a + ", " + b + ")";
            case 2:
                return "clamp(" + a + ", -0.5, 1.5)";
            case 3:
                return "mod(" + a + ", " + b + ")";
            case 4:
                return "step(" + a + ", " + b + ")";
            case 5:
                return "smoothstep(-0.5, 1.5, " + a + ")";
            case 6:
                return "atan2(" + a + ", " + b + ")";
            default:
                return pick({"abs(", "sign(", "floor(", "ceil(", "fract("}) + a + ")";
        }
    }

    std::mt19937 random_;
    Kinds kinds_;
};

}  // namespace voledit::test
