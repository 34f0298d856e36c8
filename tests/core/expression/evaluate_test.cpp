#include <gtest/gtest.h>

#include <bit>

#include "core/base/parallel.h"
#include "tests/support/formula_oracle.h"
#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

using namespace test;

/// Points and parameters for random formulas.
struct Inputs {
    std::array<std::vector<double>, kRandomVariables> variable;
    std::vector<double> parameters;

    Inputs(RandomFormulas& random, std::size_t count) {
        for (auto& v : variable)
            for (std::size_t i = 0; i < count; ++i)
                v.push_back(random.below(8) ? random.value(-2, 2) : random.below(5) - 2);
        for (int k = 0; k < kRandomParameters; ++k) parameters.push_back(random.value(0.25, 2));
    }
    std::vector<const double*> pointers() const {
        std::vector<const double*> result;
        for (const auto& v : variable) result.push_back(v.data());
        return result;
    }
    Oracle<double>::Names names(std::size_t i) const {
        return {{"x", {1, {variable[0][i]}}},
                {"y", {1, {variable[1][i]}}},
                {"z", {1, {variable[2][i]}}},
                {"v", {3, {variable[3][i], variable[4][i], variable[5][i]}}},
                {"p", {1, {parameters[0]}}},
                {"q", {1, {parameters[1]}}},
                {"w", {3, {parameters[2], parameters[3], parameters[4]}}}};
    }
};

bool same(double a, double b) {
    return a == b || (a != a && b != b);
}

TEST(Evaluate, EqualsAPlainWalkOverTheTreeToTheBit) {
    RandomFormulas random(21, {});
    int numbers = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::string text = random.number(1 + i % 5);
        const FormulaGraph graph({}, {{{text, "random"}}}, randomFormulaSymbols());
        const std::size_t count = i % 10 ? 3 : kRandomParameters + 600;
        const Inputs inputs(random, count);
        std::vector<double> result(count);
        double* output = result.data();
        graph.evaluate(inputs.pointers(), inputs.parameters, {&output, 1}, count);
        for (std::size_t n = 0; n < count; n += 1 + count / 4) {
            const double expected = Oracle<double>().evaluate(text, inputs.names(n)).at[0];
            ASSERT_TRUE(same(result[n], expected)) << text << "\n" << result[n] << " instead of " << expected;
            numbers += expected == expected;
        }
    }
    EXPECT_GT(numbers, 5000);
}

TEST(Evaluate, VectorsGiveThreeOutputsAndConditionsOne) {
    RandomFormulas random(22, {});
    for (int i = 0; i < 500; ++i) {
        const std::string vector = random.vector(3), condition = random.condition(3);
        const FormulaGraph graph({}, {{{vector, ""}, FormulaType::Vector}, {{condition, ""}, FormulaType::Condition}},
                                 randomFormulaSymbols());
        ASSERT_EQ(graph.outputCount(), 4);
        const Inputs inputs(random, 1);
        std::array<double, 4> result{};
        std::array<double*, 4> outputs{&result[0], &result[1], &result[2], &result[3]};
        graph.evaluate(inputs.pointers(), inputs.parameters, outputs, 1);
        const auto expected = Oracle<double>().evaluate(vector, inputs.names(0));
        for (std::size_t c = 0; c < 3; ++c) ASSERT_TRUE(same(result[c], expected.at[c])) << vector;
        ASSERT_EQ(result[3], Oracle<double>().evaluate(condition, inputs.names(0)).at[0]) << condition;
    }
}

TEST(Evaluate, PointsDoNotDependOnTheirNeighboursOrTheCount) {
    RandomFormulas random(23, {});
    for (int i = 0; i < 60; ++i) {
        const FormulaGraph graph({}, {{{random.number(5), ""}}, {{random.number(5), ""}}}, randomFormulaSymbols());
        const std::size_t count = 1500;
        const Inputs inputs(random, count);
        std::vector<double> together(2 * count), parallel(2 * count), alone(2);
        const std::array<double*, 2> a{together.data(), together.data() + count},
            b{parallel.data(), parallel.data() + count}, c{alone.data(), alone.data() + 1};
        graph.evaluate(inputs.pointers(), inputs.parameters, a, count);
        graph.evaluateParallel(inputs.pointers(), inputs.parameters, b, count);
        for (std::size_t n = 0; n < count; ++n) {
            ASSERT_TRUE(same(together[n], parallel[n]) && same(together[count + n], parallel[count + n]));
            if (n % 97) continue;
            auto pointers = inputs.pointers();
            for (auto& pointer : pointers) pointer += n;
            graph.evaluate(pointers, inputs.parameters, c, 1);
            ASSERT_TRUE(same(together[n], alone[0]) && same(together[count + n], alone[1]));
        }
    }
}

TEST(Evaluate, InParallelOverManyPoints) {
    const FormulaGraph graph({}, {{{"x * x + p", ""}}}, {{{"x"}}, {{"p"}}, {}});
    std::vector<double> x(100'001), result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = double(i);
    const double *in = x.data(), p = 0.5;
    double* out = result.data();
    graph.evaluateParallel({&in, 1}, {&p, 1}, {&out, 1}, x.size());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(result[i], x[i] * x[i] + 0.5);
}

TEST(Evaluate, OutputsThatAreVariablesParametersOrEachOther) {
    const FormulaGraph graph(
        {}, {{{"x", ""}}, {{"p", ""}}, {{"x + p", ""}}, {{"p + x", ""}}, {{"3", ""}}, {{"2 * (x + p)", ""}}},
        {{{"x"}}, {{"p"}}, {}});
    std::vector<double> x(700);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = double(i);
    std::vector<double> result(6 * x.size());
    std::array<double*, 6> outputs{};
    for (std::size_t o = 0; o < 6; ++o) outputs[o] = result.data() + o * x.size();
    const double *in = x.data(), p = 0.25;
    graph.evaluate({&in, 1}, {&p, 1}, outputs, x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_EQ(outputs[0][i], x[i]);
        EXPECT_EQ(outputs[1][i], 0.25);
        EXPECT_EQ(outputs[2][i], x[i] + 0.25);
        EXPECT_EQ(outputs[3][i], x[i] + 0.25);
        EXPECT_EQ(outputs[4][i], 3);
        EXPECT_EQ(outputs[5][i], 2 * (x[i] + 0.25));
    }
}

TEST(Evaluate, NothingForNoPoints) {
    const FormulaGraph graph({}, {{{"x", ""}}}, {{{"x"}}, {}, {}});
    const double* in = nullptr;
    double* out = nullptr;
    graph.evaluate({&in, 1}, {}, {&out, 1}, 0);
    graph.evaluateParallel({&in, 1}, {}, {&out, 1}, 0);
}

/// A formula without names as a number.
double valueOf(const std::string& text) {
    const FormulaGraph graph({}, {{{text, ""}}}, {});
    double result = 0;
    double* out = &result;
    graph.evaluate({}, {}, {&out, 1}, 1);
    return result;
}

/// The same with every number given as a variable, so that nothing is folded.
double valueAt(const std::string& text, double a, double b = 0, double c = 0) {
    const FormulaGraph graph({}, {{{text, ""}}}, {{{"a"}, {"b"}, {"c"}}, {}, {}});
    std::array<const double*, 3> in{&a, &b, &c};
    double result = 0;
    double* out = &result;
    graph.evaluate(in, {}, {&out, 1}, 1);
    return result;
}

TEST(Evaluate, FunctionsByTheirDefinitions) {
    EXPECT_EQ(valueOf("mod(-1, 3)"), 2);
    EXPECT_EQ(valueOf("mod(1, -3)"), -2);
    EXPECT_EQ(valueOf("fract(-0.25)"), 0.75);
    EXPECT_EQ(valueOf("sign(-3) + 10 * sign(0) + 100 * sign(2)"), 99);
    EXPECT_EQ(valueOf("floor(-0.5) + 10 * ceil(-0.5)"), -1);
    EXPECT_NEAR(valueOf("atan2(1, -1)"), 3 * kPi / 4, 1e-15);
    EXPECT_NEAR(valueOf("atan2(-0, -1)"), kPi, 1e-15);  // zeros have no sign
    EXPECT_EQ(valueOf("step(1, 0.5) + 10 * step(1, 1) + 100 * step(1, 2)"), 110);
    EXPECT_EQ(valueOf("smoothstep(1, 3, 2)"), 0.5);
    EXPECT_EQ(valueOf("smoothstep(1, 3, 0) + 2 * smoothstep(1, 3, 9)"), 2);
    EXPECT_EQ(valueOf("clamp(5, 0, 2) + 10 * clamp(-5, 0, 2)"), 2);
    EXPECT_EQ(valueOf("mix(2, 6, 0.25)"), 3);
    EXPECT_EQ(valueOf("min(3, 1, 2) + 10 * max(3, 1, 2)"), 31);
    EXPECT_EQ(valueOf("length(3, 4) + length(2, 3, 6) + length([2, 3, 6])"), 19);
    EXPECT_EQ(valueOf("dot([1, 2, 3], [4, 5, 6])"), 32);
    EXPECT_EQ(valueOf("cross([1, 0, 0], [0, 1, 0]).z"), 1);
    EXPECT_EQ(valueOf("normalize([0, 3, 4]).z"), 0.8);
    EXPECT_NEAR(valueOf("rotate([1, 0, 0], [0, 0, 5], pi / 2).y"), 1, 1e-15);  // right-handed, axis of any length
    EXPECT_NEAR(valueOf("rotate([1, 2, 3], [1, 1, 1], 2 * pi / 3).x"), 3, 1e-14);
    EXPECT_EQ(valueOf("log2(8) + log(e)"), 4);
    EXPECT_EQ(valueOf("2^3^2"), 512);
    EXPECT_EQ(valueOf("-2^2"), -4);
    EXPECT_EQ(valueOf("replace([1, 2, 3], 1, 9)[1]"), 9);
    EXPECT_EQ(valueOf("1 < 2 && !(2 < 1) || 1 == 2"), 1);
    EXPECT_EQ(valueOf("3 && 2"), 1);  // numbers other than 0 are true
    EXPECT_EQ(valueOf("select(0.1, 5, 6)"), 5);
}

TEST(Evaluate, PowersOfWholeNumbersAreMultipliedOut) {
    const double x = 1.1;
    EXPECT_EQ(valueAt("a^2", x), x * x);
    EXPECT_EQ(valueAt("a^3", x), x * x * x);
    EXPECT_EQ(valueAt("a^4", x), (x * x) * (x * x));
    EXPECT_EQ(valueAt("a^5", x), (x * x) * (x * x) * x);
    EXPECT_EQ(valueAt("a^-3", x), 1 / (x * x * x));
    // The same by an exponent that is known only later.
    for (int n = -16; n <= 16; ++n) {
        EXPECT_EQ(valueAt("a^b", x, n), valueAt("a^(" + std::to_string(n) + ")", x));
        EXPECT_NEAR(valueAt("a^b", x, n), std::pow(x, n), 1e-14 * std::pow(x, n));
    }
    EXPECT_EQ(valueAt("a^b", -2, 3), -8);
    EXPECT_EQ(valueAt("a^b", -2, 17), -131072);
    EXPECT_TRUE(std::isnan(valueAt("a^b", -2, 0.5)));
    EXPECT_EQ(valueAt("a^b", 0, 0), 1);
    EXPECT_EQ(valueAt("a^b", 0, -1), kInfinity);
    EXPECT_EQ(valueAt("a^b", 9, 0.5), 3);
}

TEST(Evaluate, NaNStaysWithWhatItConcerns) {
    EXPECT_EQ(valueAt("select(a > 0, 1 / a, 7)", 0), 7);
    EXPECT_EQ(valueAt("select(a >= 0, sqrt(a), -1)", -4), -1);
    for (const std::string text :
         {"a + b", "b - a", "a * 0", "min(a, b)", "min(b, a)", "max(a, b)", "max(b, a)", "clamp(a, 0, 1)", "floor(a)",
          "sign(a)", "abs(a)", "noise(b, a, b)", "smoothstep(0, 1, a)", "mod(b, a)", "atan2(a, b)", "a^b",
          "length(a, b)", "fract(a)"})
        EXPECT_TRUE(std::isnan(valueAt(text, kNaN, 0.5))) << text;
    for (const std::string text :
         {"a < b", "a <= b", "a > b", "a >= b", "a == b", "a != b", "a == a", "a < a", "a <= a", "a != a", "a && 1"})
        EXPECT_EQ(valueAt(text, kNaN, 0.5), 0) << text;
    EXPECT_EQ(valueAt("!(a == a)", kNaN), 1);
    EXPECT_EQ(valueAt("select(a, 1, 2)", kNaN), 2);
}

TEST(Evaluate, DivisionByZeroAndOverflowAreIeee) {
    EXPECT_EQ(valueAt("1 / a", 0), kInfinity);
    EXPECT_EQ(valueAt("-1 / a", 0), -kInfinity);
    EXPECT_TRUE(std::isnan(valueAt("a / a", 0)));
    EXPECT_EQ(valueAt("exp(a)", 1000), kInfinity);
    EXPECT_EQ(valueAt("log(a)", 0), -kInfinity);
    EXPECT_TRUE(std::isnan(valueAt("0 * a", kInfinity)));
    EXPECT_TRUE(std::isnan(valueAt("normalize([a, a, a]).x", 0)));
}

}  // namespace
}  // namespace voledit
