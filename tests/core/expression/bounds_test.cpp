#include <gtest/gtest.h>

#include "core/expression/noise.h"
#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

using test::RandomFormulas;

Interval boundsOf(const std::string& text, Interval a, Interval b = {0, 1}, double p = 2) {
    const FormulaGraph graph({}, {{{text, ""}}}, {{{"a"}, {"b"}}, {{"p"}}, {}});
    const std::array<Interval, 2> in{a, b};
    return graph.bounds(in, {&p, 1})[0];
}

void checkRandomBoxes(unsigned seed, RandomFormulas::Kinds kinds, int formulas) {
    RandomFormulas random(seed, kinds);
    int checked = 0, finite = 0, decided = 0;
    for (int i = 0; i < formulas; ++i) {
        const std::string text = random.number(1 + i % 5);
        const std::array<int, 3> by{0, 1, 2};
        FormulaGraph graph({}, {{{text, ""}}}, test::randomFormulaSymbols());
        if (i % 4 == 0) graph = graph.withDerivatives(by);
        const std::size_t outputs = std::size_t(graph.outputCount());
        std::array<Interval, test::kRandomVariables> box{};
        for (Interval& side : box) {
            const double width = std::array{0.0, 1e-3, 0.1, 0.5, 3.0}[std::size_t(random.below(5))];
            side.low = random.value(-2, 2);
            side.high = side.low + width;
        }
        const std::array<double, test::kRandomParameters> parameter{0.7, 1.3, -0.4, 2, 1.1};
        const auto bounds = graph.bounds(box, parameter);
        constexpr std::size_t kPoints = 64;
        std::array<std::vector<double>, test::kRandomVariables> variable;
        std::array<const double*, test::kRandomVariables> in{};
        for (std::size_t n = 0; n < box.size(); ++n) {
            for (std::size_t k = 0; k < kPoints; ++k) {
                const int where = random.below(4);
                variable[n].push_back(where == 0 ? box[n].low
                                      : where == 1
                                          ? box[n].high
                                          : std::clamp(random.value(box[n].low, box[n].high), box[n].low, box[n].high));
            }
            in[n] = variable[n].data();
        }
        std::vector<double> values(outputs * kPoints);
        std::vector<double*> out;
        for (std::size_t o = 0; o < outputs; ++o) out.push_back(values.data() + o * kPoints);
        graph.evaluate(in, parameter, out, kPoints);
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (values[k] != values[k]) continue;
            const Interval& range = bounds[k / kPoints];
            ASSERT_TRUE(range.contains(values[k])) << text << "\noutput " << k / kPoints << ": " << values[k]
                                                   << " is not in [" << range.low << ", " << range.high << "]";
            ++checked;
        }
        for (const Interval& range : bounds) {
            finite += range.low > -kInfinity && range.high < kInfinity;
            decided += range.low > 0 || range.high < 0;
        }
    }
    EXPECT_GT(checked, 30 * formulas);
    EXPECT_GT(finite, formulas / 2);
    EXPECT_GT(decided, formulas / 5);
}

TEST(Bounds, HoldValuesAndDerivativesOfRandomFormulas) {
    checkRandomBoxes(41, {}, 5000);
}

TEST(Bounds, HoldSmoothFormulas) {
    checkRandomBoxes(42, {.steps = false, .noise = true, .wild = false}, 2000);
}

TEST(Bounds, AreExactForFunctionsOfOneVariable) {
    struct Case {
        std::string text;
        Interval a, expected;
    };
    for (const Case& c : std::vector<Case>{{"2 * a + 1", {0, 3}, {1, 7}},
                                           {"1 - a", {0, 1}, {0, 1}},
                                           {"a * a", {-2, 1}, {0, 4}},
                                           {"a^2", {-2, 1}, {0, 4}},
                                           {"a^3", {-2, 1}, {-8, 1}},
                                           {"a^4", {-2, 1}, {0, 16}},
                                           {"a^p", {-2, 1}, {0, 4}},
                                           {"(1 - clamp(a, 0, 1))^p", {-1, 0.5}, {0.25, 1}},
                                           {"(1 - clamp(a, 0, 1))^(p / 3)", {-1, 3}, {0, 1}},
                                           {"a^-2", {2, 4}, {1.0 / 16, 0.25}},
                                           {"sqrt(a)", {4, 9}, {2, 3}},
                                           {"sqrt(a)", {-4, 9}, {0, 3}},
                                           {"exp(a)", {0, 1}, {1, std::exp(1)}},
                                           {"log(a)", {1, 8}, {0, std::log(8)}},
                                           {"log2(a)", {1, 8}, {0, 3}},
                                           {"sin(a)", {0, 1}, {0, std::sin(1)}},
                                           {"sin(a)", {0, 3}, {0, 1}},
                                           {"sin(a)", {3, 6}, {-1, std::sin(3)}},
                                           {"cos(a)", {-1, 2}, {std::cos(2), 1}},
                                           {"cos(a)", {0, 100}, {-1, 1}},
                                           {"tan(a)", {-1, 1}, {-std::tan(1), std::tan(1)}},
                                           {"asin(a)", {0, 1}, {0, kPi / 2}},
                                           {"acos(a)", {0, 1}, {0, kPi / 2}},
                                           {"atan(a)", {0, 1}, {0, kPi / 4}},
                                           {"atan2(a, 1)", {-1, 1}, {-kPi / 4, kPi / 4}},
                                           {"atan2(1, a)", {-1, 1}, {kPi / 4, 3 * kPi / 4}},
                                           {"atan2(a, -1)", {-1, 1}, {-kPi, kPi}},
                                           {"atan2(a, -1)", {0, 1}, {3 * kPi / 4, kPi}},
                                           {"sinh(a)", {-1, 1}, {-std::sinh(1), std::sinh(1)}},
                                           {"cosh(a)", {-1, 2}, {1, std::cosh(2)}},
                                           {"tanh(a)", {0, 1}, {0, std::tanh(1)}},
                                           {"abs(a)", {-3, 2}, {0, 3}},
                                           {"sign(a)", {-3, 2}, {-1, 1}},
                                           {"floor(a)", {0.5, 2.5}, {0, 2}},
                                           {"ceil(a)", {0.5, 2.5}, {1, 3}},
                                           {"fract(a)", {2.25, 2.5}, {0.25, 0.5}},
                                           {"fract(a)", {2.25, 3.5}, {0, 1}},
                                           {"mod(a, 2)", {4.5, 5}, {0.5, 1}},
                                           {"mod(a, 2)", {4.5, 6.5}, {0, 2}},
                                           {"clamp(a, 0, 1)", {-3, 0.5}, {0, 0.5}},
                                           {"min(a, 1)", {-3, 5}, {-3, 1}},
                                           {"max(a, 1)", {-3, 5}, {1, 5}},
                                           {"smoothstep(0, 2, a)", {1, 5}, {0.5, 1}},
                                           {"step(1, a)", {2, 3}, {1, 1}},
                                           {"step(1, a)", {0, 3}, {0, 1}},
                                           {"1 / a", {2, 4}, {0.25, 0.5}},
                                           {"select(a < 5, a, 100)", {0, 3}, {0, 3}},
                                           {"select(a < 2, a, 100)", {0, 3}, {0, 100}},
                                           {"select(a > 3 && a > 1, -1, a)", {0, 2}, {0, 2}},
                                           {"a - a", {0, 2}, {0, 0}}}) {
        const Interval range = boundsOf(c.text, c.a);
        EXPECT_LE(range.low, c.expected.low) << c.text;
        EXPECT_GE(range.high, c.expected.high) << c.text;
        EXPECT_NEAR(range.low, c.expected.low, 1e-13 * (1 + std::abs(c.expected.low))) << c.text;
        EXPECT_NEAR(range.high, c.expected.high, 1e-13 * (1 + std::abs(c.expected.high))) << c.text;
    }
}

TEST(Bounds, AreEverythingWhereADivisorMayBeZero) {
    const Interval range = boundsOf("1 / a", {-1, 1});
    EXPECT_EQ(range, (Interval{-kInfinity, kInfinity}));
    EXPECT_EQ(boundsOf("mod(1, a)", {-1, 1}), (Interval{-kInfinity, kInfinity}));
    EXPECT_EQ(boundsOf("tan(a)", {1, 2}), (Interval{-kInfinity, kInfinity}));
}

TEST(Bounds, ANumberThatMayBeNaNDecidesNoComparison) {
    // sqrt(a) ≥ 0 wherever it is a number, but at a = −1 the comparison is false.
    EXPECT_EQ(boundsOf("select(sqrt(a) >= 0, 1, 2)", {-1, 1}), (Interval{1, 2}));
    EXPECT_EQ(boundsOf("select(sqrt(a) >= 0, 1, 2)", {0, 1}), (Interval{1, 1}));
    EXPECT_EQ(boundsOf("select(sqrt(a) < 0, 1, 2)", {-1, 1}), (Interval{2, 2}));
}

TEST(Bounds, UniformPartsAreExact) {
    const Interval range = boundsOf("sin(p) / 3", {0, 1}, {0, 1}, 0.4);
    EXPECT_EQ(range, (Interval{std::sin(0.4) / 3, std::sin(0.4) / 3}));
}

TEST(Bounds, OfNoiseShrinkWithTheBox) {
    const Interval wide = boundsOf("noise(a, b, 0)", {0, 9}, {0, 9});
    EXPECT_LE(wide.high, 1.05);
    const Interval small = boundsOf("noise(a, b, 0)", {0.4, 0.401}, {0.3, 0.301});
    EXPECT_LT(small.high - small.low, 0.02);
}

/// A bound of |noise| over a cell's part [low, high]³ from its values' bounds at corners of the parts.
double largestNoise(const std::array<Interval, 3>& part, double enough) {
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<double, 3> distance{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
            const bool upper = corner >> axis & 1;
            weight *= upper ? fade(part[axis].high) : 1 - fade(part[axis].low);
            distance[axis] = upper ? 1 - part[axis].low : part[axis].high;
        }
        std::sort(distance.begin(), distance.end());
        sum += weight * (distance[1] + distance[2]);
    }
    if (sum <= enough || part[0].high - part[0].low < 1e-3) return sum;
    double largest = 0;
    for (unsigned child = 0; child < 8; ++child) {
        auto half = part;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double middle = (part[axis].low + part[axis].high) / 2;
            (child >> axis & 1 ? half[axis].low : half[axis].high) = middle;
        }
        largest = std::max(largest, largestNoise(half, enough));
    }
    return largest;
}

TEST(Bounds, OfNoiseAreProven) {
    // Branch and bound over the cell: weights and distances of each part at their largest.
    EXPECT_LE(largestNoise({{{0, 1}, {0, 1}, {0, 1}}}, noiseBound({0, 0, 0})), noiseBound({0, 0, 0}));
}

}  // namespace
}  // namespace voledit
