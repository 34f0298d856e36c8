#include <gtest/gtest.h>

#include "tests/support/formula_oracle.h"
#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

using namespace test;

constexpr std::array<int, 3> kXyz{0, 1, 2};

/// d text / d (a, b, c) at a point, after the value.
std::array<double, 4> derivatives(const std::string& text, double a, double b = 0.7, double c = 0.4) {
    const FormulaGraph graph({}, {{{text, ""}}}, {{{"a"}, {"b"}, {"c"}}, {}, {}});
    const std::array<const double*, 3> in{&a, &b, &c};
    std::array<double, 4> result{};
    const std::array<double*, 4> out{&result[0], &result[1], &result[2], &result[3]};
    graph.withDerivatives(kXyz).evaluate(in, {}, out, 1);
    return result;
}

TEST(Derivatives, EqualAnImaginaryStepForAnalyticFormulas) {
    RandomFormulas random(31, {.steps = false, .noise = false, .wild = false});
    constexpr long double kStep = 1e-200L;
    int compared = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::string text = random.number(1 + i % 4);
        const FormulaGraph graph = FormulaGraph({}, {{{text, ""}}}, randomFormulaSymbols()).withDerivatives(kXyz);
        std::array<double, kRandomVariables> variable{};
        for (double& v : variable) v = random.value(-2, 2);
        const std::array<double, kRandomParameters> parameter{0.7, 1.3, -0.4, 0.9, 1.1};
        // How much rounding does shows by moving the point a little.
        std::array<double, 4> result{}, moved{};
        const auto evaluate = [&](double factor, std::array<double, 4>& values) {
            std::array<double, kRandomVariables> at = variable;
            std::array<const double*, kRandomVariables> in{};
            for (std::size_t n = 0; n < at.size(); ++n) {
                at[n] *= factor;
                in[n] = &at[n];
            }
            const std::array<double*, 4> out{&values[0], &values[1], &values[2], &values[3]};
            graph.evaluate(in, parameter, out, 1);
        };
        evaluate(1, result);
        evaluate(1 + 1e-8, moved);
        for (std::size_t n = 0; n < 3; ++n) {
            const auto z = [&](std::size_t v) { return Complex(variable[v], v == n ? kStep : 0.0L); };
            const Oracle<Complex>::Names names{{"x", {1, {z(0)}}},
                                               {"y", {1, {z(1)}}},
                                               {"z", {1, {z(2)}}},
                                               {"v", {3, {z(3), z(4), z(5)}}},
                                               {"p", {1, {parameter[0]}}},
                                               {"q", {1, {parameter[1]}}},
                                               {"w", {3, {parameter[2], parameter[3], parameter[4]}}}};
            const double expected = double(Oracle<Complex>().evaluate(text, names).at[0].imag() / kStep);
            if (!std::isfinite(expected)) continue;
            const double rounding = 1e-12 * std::abs(expected) + 1e-5 * std::abs(moved[n + 1] - result[n + 1]) + 1e-14;
            ASSERT_NEAR(result[n + 1], expected, rounding) << text << "  by "
                                                           << "xyz"[n];
            ++compared;
        }
    }
    EXPECT_GT(compared, 5500);
}

TEST(Derivatives, EqualDifferenceQuotientsWhereSmooth) {
    RandomFormulas random(32, {});
    int compared = 0, zeros = 0;
    for (int i = 0; i < 6000; ++i) {
        const std::string text = random.number(1 + i % 4);
        const FormulaGraph plain({}, {{{text, ""}}}, randomFormulaSymbols());
        const FormulaGraph graph = plain.withDerivatives(kXyz);
        std::array<double, kRandomVariables> variable{};
        for (double& v : variable) v = random.value(-2, 2);
        const std::array<double, kRandomParameters> parameter{0.7, 1.3, -0.4, 0.9, 1.1};
        std::array<const double*, kRandomVariables> in{};
        for (std::size_t n = 0; n < in.size(); ++n) in[n] = &variable[n];
        std::array<double, 4> result{};
        const std::array<double*, 4> out{&result[0], &result[1], &result[2], &result[3]};
        graph.evaluate(in, parameter, out, 1);
        for (std::size_t n = 0; n < 3; ++n) {
            // Central differences with three steps: where they agree the formula is smooth at this scale and they can
            // be trusted to what they differ by.
            const double x = variable[n];
            const auto quotient = [&](double h) {
                std::array<double, 2> end{};
                for (const int side : {0, 1}) {
                    variable[n] = side ? x + h : x - h;
                    double* value = &end[std::size_t(side)];
                    plain.evaluate(in, parameter, {&value, 1}, 1);
                }
                variable[n] = x;
                return (end[1] - end[0]) / (2 * h);
            };
            const double coarse = quotient(4e-4), middle = quotient(2e-4), fine = quotient(1e-4);
            const double doubt = std::abs(coarse - middle) + std::abs(middle - fine);
            if (!(doubt < 1e-3 * std::abs(fine) + 1e-9) || std::abs(fine) > 1e6) continue;
            const double extrapolated = (4 * fine - middle) / 3;
            ASSERT_NEAR(result[n + 1], extrapolated, doubt + 1e-6 * std::abs(fine) + 1e-8 * (1 + std::abs(result[0])))
                << text << "  by "
                << "xyz"[n];
            ++compared;
            zeros += result[n + 1] == 0;
        }
    }
    EXPECT_GT(compared - zeros, 3000);
}

TEST(Derivatives, OfEveryFunction) {
    struct Case {
        std::string text;
        double at, expected;
    };
    const double b = 0.7;
    for (const Case& c : std::vector<Case>{{"sin(a)", 0.5, std::cos(0.5)},
                                           {"cos(a)", 0.5, -std::sin(0.5)},
                                           {"tan(a)", 0.5, 1 / std::pow(std::cos(0.5), 2)},
                                           {"asin(a)", 0.5, 1 / std::sqrt(0.75)},
                                           {"acos(a)", 0.5, -1 / std::sqrt(0.75)},
                                           {"atan(a)", 0.5, 0.8},
                                           {"atan2(a, b)", 0.5, b / (0.25 + b * b)},
                                           {"atan2(b, a)", 0.5, -b / (0.25 + b * b)},
                                           {"sinh(a)", 0.5, std::cosh(0.5)},
                                           {"cosh(a)", 0.5, std::sinh(0.5)},
                                           {"tanh(a)", 0.5, 1 - std::pow(std::tanh(0.5), 2)},
                                           {"exp(a)", 0.5, std::exp(0.5)},
                                           {"log(a)", 0.5, 2},
                                           {"log2(a)", 0.5, 2 / std::log(2.0)},
                                           {"sqrt(a)", 4, 0.25},
                                           {"a^3", 2, 12},
                                           {"a^7", 2, 448},
                                           {"a^-2", 2, -0.25},
                                           {"a^b", 2, b * std::pow(2, b - 1)},
                                           {"b^a", 2, b * b * std::log(b)},
                                           {"a^a", 2, 4 * (1 + std::log(2.0))},
                                           {"a * a", 3, 6},
                                           {"1 / a", 2, -0.25},
                                           {"abs(a)", -2, -1},
                                           {"floor(a) + ceil(a) + sign(a) + (a < 1)", 0.5, 0},
                                           {"fract(a)", 0.5, 1},
                                           {"mod(a, b)", 1.5, 1},
                                           {"mod(5, a)", 1.5, -3},
                                           {"min(a, b)", 0.5, 1},
                                           {"min(a, b)", 0.9, 0},
                                           {"max(b, a)", 0.9, 1},
                                           {"clamp(a, 0, 1)", 0.5, 1},
                                           {"clamp(a, 0, 1)", 1.5, 0},
                                           {"mix(2, 5, a)", 0.5, 3},
                                           {"step(0.2, a)", 0.5, 0},
                                           {"smoothstep(0, 2, a)", 0.5, 0.5625},
                                           {"select(a > 1, a, 3 * a)", 0.5, 3},
                                           {"length(a, 4)", 3, 0.6},
                                           {"normalize([a, 4, 0]).x", 3, 0.128}})
        EXPECT_NEAR(derivatives(c.text, c.at)[1], c.expected, 1e-13 * (1 + std::abs(c.expected))) << c.text;
}

TEST(Derivatives, OfNoiseAreExact) {
    // Noise is a polynomial within a cell: central differences converge fast and tell every digit they have.
    RandomFormulas random(33, {});
    for (int i = 0; i < 200; ++i) {
        const std::array<double, 3> at{random.value(-5, 5), random.value(-5, 5), random.value(-5, 5)};
        for (const std::array<int, 3> order : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {2, 0, 1}})
            for (std::size_t axis = 0; axis < 3; ++axis) {
                constexpr double h = 1e-4;
                if (at[axis] - std::floor(at[axis]) < 3 * h || std::ceil(at[axis]) - at[axis] < 3 * h) continue;
                const auto value = [&](double by) {
                    auto moved = at;
                    moved[axis] += by * h;
                    return noise(moved[0], moved[1], moved[2], order);
                };
                const double difference = (8 * (value(1) - value(-1)) - (value(2) - value(-2))) / (12 * h);
                auto steeper = order;
                ++steeper[axis];
                EXPECT_NEAR(noise(at[0], at[1], at[2], steeper), difference, 1e-8 * noiseBound(steeper));
            }
    }
    const auto by = derivatives("noise(2 * a, b, c)", 0.3, 0.6, 1.7);
    EXPECT_EQ(by[1], 2 * noise(0.6, 0.6, 1.7, {1, 0, 0}));
    EXPECT_EQ(by[3], noise(0.6, 0.6, 1.7, {0, 0, 1}));
}

TEST(Derivatives, CanBeTakenAgain) {
    const FormulaGraph graph({}, {{{"sin(a) * b^3 + noise(a, b, 0.5)", ""}}}, {{{"a"}, {"b"}}, {}, {}});
    const std::array<int, 2> by{0, 1};
    const FormulaGraph twice = graph.withDerivatives(by).withDerivatives(by);
    ASSERT_EQ(twice.outputCount(), 9);
    const double a = 0.3, b = 0.6;
    const std::array<const double*, 2> in{&a, &b};
    std::array<double, 9> value{};
    std::array<double*, 9> out{};
    for (std::size_t n = 0; n < 9; ++n) out[n] = &value[n];
    twice.evaluate(in, {}, out, 1);
    EXPECT_NEAR(value[5], -std::sin(a) * b * b * b + noise(a, b, 0.5, {2, 0, 0}), 1e-14);
    EXPECT_NEAR(value[6], 3 * b * b * std::cos(a) + noise(a, b, 0.5, {1, 1, 0}), 1e-14);
    EXPECT_EQ(value[6], value[7]);
    EXPECT_NEAR(value[8], 6 * b * std::sin(a) + noise(a, b, 0.5, {0, 2, 0}), 1e-13);
}

TEST(Derivatives, AreZeroWhereTheSlopeIsInfiniteOrHasNoDirection) {
    for (const std::string text : {"sqrt(a)", "length([a, a, 0])", "length(a, 0)", "atan2(a, a)", "a^0.5", "a^c",
                                   "asin(1 + a)", "acos(a - 1)", "sqrt(a * a + a * a)"}) {
        const auto value = derivatives(text, 0);
        EXPECT_TRUE(std::isfinite(value[0])) << text;
        EXPECT_EQ(value[1], 0) << text;
    }
    // Where the value is NaN, so is the derivative.
    EXPECT_TRUE(std::isnan(derivatives("sqrt(a)", -1)[1]));
}

TEST(Derivatives, OfTheSideThatIsNotTakenDoNotLeak) {
    EXPECT_EQ(derivatives("select(a > 0, sqrt(a), 2 * a)", -1)[1], 2);
    EXPECT_EQ(derivatives("select(a > 0, log(a), 2 * a)", 0)[1], 2);
    EXPECT_EQ(derivatives("max(sqrt(abs(a)), 3)", 0)[1], 0);
}

TEST(Derivatives, FollowTheOutputs) {
    const FormulaGraph graph =
        FormulaGraph({}, {{{"a + 2 * b", ""}}, {{"[a * b, b, 7]", ""}, FormulaType::Vector}}, {{{"a"}, {"b"}}, {}, {}});
    const std::array<int, 2> by{1, 0};
    const FormulaGraph all = graph.withDerivatives(by);
    ASSERT_EQ(all.outputCount(), 12);
    const double a = 3, b = 5;
    const std::array<const double*, 2> in{&a, &b};
    std::array<double, 12> value{};
    std::array<double*, 12> out{};
    for (std::size_t n = 0; n < 12; ++n) out[n] = &value[n];
    all.evaluate(in, {}, out, 1);
    EXPECT_EQ(value, (std::array<double, 12>{13, 15, 5, 7, 2, 1, 3, 5, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace voledit
