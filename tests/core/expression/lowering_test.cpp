#include "core/expression/lowering.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

const FormulaSymbols kSymbols{
    {{"x"}, {"y"}, {"v", 3}}, {{"angle"}, {"scale"}, {"w", 3}}, {{"k", {1}}, {"n", {0, 0, 1}}, {"half", {0.5}}}};

FormulaGraph graphOf(const std::string& text, FormulaType type = FormulaType::Number,
                     const std::vector<FormulaLet>& lets = {}) {
    return FormulaGraph(lets, {{{text, ""}, type}}, kSymbols);
}

std::string errorOf(const std::string& text, FormulaType type = FormulaType::Number,
                    const std::vector<FormulaLet>& lets = {}) {
    try {
        graphOf(text, type, lets);
    } catch (const FormulaError& error) {
        const std::string message = error.what();
        return std::to_string(error.column()) + ": " +
               message.substr(message.find(": ") + 2, message.find('\n') - message.find(": ") - 2);
    }
    ADD_FAILURE() << "no error: " << text;
    return "";
}

TEST(Lowering, UnknownNamesSuggestTheNearest) {
    EXPECT_EQ(errorOf("x + agnle"), "5: 'agnle' has no meaning here; did you mean 'angle'?");
    EXPECT_EQ(errorOf("scal * 2"), "1: 'scal' has no meaning here; did you mean 'scale'?");
    EXPECT_EQ(errorOf("zebra"),
              "1: 'zebra' has no meaning here; the names here are angle, e, half, k, n, pi, scale, v, w, x, y");
    EXPECT_EQ(errorOf("sine(x)"), "1: there is no function 'sine'; did you mean 'sin'?");
    EXPECT_EQ(errorOf("smothstep(0, 1, x)"), "1: there is no function 'smothstep'; did you mean 'smoothstep'?");
    EXPECT_EQ(errorOf("x(2)"), "1: 'x' is no function; a product is a * b");
    EXPECT_EQ(errorOf("2 + sin"), "5: 'sin' is a function; write sin(x)");
}

TEST(Lowering, FunctionsTakeTheirArguments) {
    EXPECT_EQ(errorOf("1 + sin()"), "5: sin takes 1 argument, here are 0; write sin(x)");
    EXPECT_EQ(errorOf("clamp(x, 1)"), "1: clamp takes 3 arguments, here are 2; write clamp(x, low, high)");
    EXPECT_EQ(errorOf("min(x)"), "1: min takes 2 to 16 arguments, here are 1; write min(a, b, …)");
    EXPECT_EQ(errorOf("noise(x, y)"), "1: noise takes one vector or three numbers; write noise(x, y, z) or noise(v)");
    EXPECT_EQ(errorOf("length(x)"),
              "8: argument 1 of length(v) must be a vector, this is a number; a vector is [a, b, c]");
    EXPECT_EQ(errorOf("dot(v, 1)"),
              "8: argument 2 of dot(u, v) must be a vector, this is a number; a vector is [a, b, c]");
    EXPECT_EQ(
        errorOf("rotate(v, w, v).x"),
        "14: argument 3 of rotate(v, axis, angle) must be a number, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("[x, v, 1].x"),
              "5: a vector's component must be a number, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("v < 1"), "1: '<' needs numbers on both sides, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("1 < 2 && v"),
              "10: '&&' needs numbers on both sides, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("!v"), "2: '!' needs a condition or a number, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("x.y"), "2: .y takes a component of a vector, this is a number");
    EXPECT_EQ(errorOf("x[0]"), "1: […] takes a component of a vector, this is a number; a vector is [a, b, c]");
}

TEST(Lowering, ComponentsAreChosenByConstants) {
    EXPECT_TRUE(graphOf("v[k]") == graphOf("v.y"));
    EXPECT_TRUE(graphOf("v[k + 1]") == graphOf("v.z"));
    EXPECT_TRUE(graphOf("replace(v, k, x)", FormulaType::Vector) == graphOf("[v.x, x, v.z]", FormulaType::Vector));
    EXPECT_EQ(errorOf("v[x]"), "3: the number of a component must be a constant: 0, 1 or 2");
    EXPECT_EQ(errorOf("v[angle]"), "3: the number of a component must be a constant: 0, 1 or 2");
    EXPECT_EQ(errorOf("v[3]"), "3: the number of a component must be a constant: 0, 1 or 2");
    EXPECT_EQ(errorOf("v[half]"), "3: the number of a component must be a constant: 0, 1 or 2");
    EXPECT_EQ(errorOf("replace(v, x, 1).x"), "12: the number of a component must be a constant: 0, 1 or 2");
}

TEST(Lowering, OutputsHaveTheTypeThatIsWanted) {
    EXPECT_EQ(errorOf("v * 2"), "3: a number is wanted, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(errorOf("x", FormulaType::Vector), "1: a vector is wanted, this is a number; a vector is [a, b, c]");
    EXPECT_EQ(errorOf("v", FormulaType::Condition),
              "1: a condition is wanted, this is a vector; take a component: .x, .y, .z");
    EXPECT_EQ(graphOf("v", FormulaType::Vector).outputCount(), 3);
    EXPECT_EQ(graphOf("x < 1", FormulaType::Condition).outputCount(), 1);
    // A number is a condition, as in select.
    EXPECT_TRUE(graphOf("x", FormulaType::Condition) == graphOf("x != 0", FormulaType::Condition));
}

TEST(Lowering, ANumberStandsForEachComponent) {
    const auto same = [](const std::string& a, const std::string& b) {
        EXPECT_TRUE(graphOf(a, FormulaType::Vector) == graphOf(b, FormulaType::Vector)) << a;
    };
    same("2 * v", "[2 * v.x, 2 * v.y, 2 * v.z]");
    same("v - x", "[v.x - x, v.y - x, v.z - x]");
    same("v^2", "v * v");
    same("max(v, 0)", "[max(v.x, 0), max(v.y, 0), max(v.z, 0)]");
    same("clamp(x, v, 1)", "[clamp(x, v.x, 1), clamp(x, v.y, 1), clamp(x, v.z, 1)]");
    same("select(x > 0, v, 0)", "[select(x > 0, v.x, 0), select(x > 0, v.y, 0), select(x > 0, v.z, 0)]");
    same("smoothstep(0, w, v)", "[smoothstep(0, w.x, v.x), smoothstep(0, w.y, v.y), smoothstep(0, w.z, v.z)]");
    same("sin(v)", "[sin(v.x), sin(v.y), sin(v.z)]");
    same("-v", "[-v.x, -v.y, -v.z]");
}

TEST(Lowering, LetsInTheTextAndBesideIt) {
    EXPECT_TRUE(graphOf("let r = x + y; r * r") == graphOf("(x + y) * (x + y)"));
    EXPECT_TRUE(graphOf("r * s", FormulaType::Number, {{"r", {"x + y", ""}}, {"s", {"r * 2", ""}}}) ==
                graphOf("(x + y) * ((x + y) * 2)"));
    // A text's own names end with it.
    EXPECT_EQ(errorOf("s", FormulaType::Number, {{"r", {"let s = x; s", ""}}}).substr(0, 26),
              "1: 's' has no meaning here");
    EXPECT_EQ(errorOf("let x = 1; x"), "5: 'x' already has a meaning; choose another name");
    EXPECT_EQ(errorOf("let r = 1; let r = 2; r"), "16: 'r' already has a meaning; choose another name");
    EXPECT_EQ(errorOf("let pi = 3; pi"), "5: 'pi' already has a meaning; choose another name");
    EXPECT_EQ(errorOf("r", FormulaType::Number, {{"r", {"r + 1", ""}}}).substr(0, 26), "1: 'r' has no meaning here");
}

TEST(Lowering, FunctionsAndNamesDoNotMix) {
    const FormulaSymbols symbols{{{"x"}}, {{"rotate"}, {"scale"}, {"e"}}, {}};
    const FormulaGraph graph({}, {{{"cos(rotate) * rotate([x, 0, 0], [0, 0, 1], rotate).x + e", ""}}}, symbols);
    const double x = 2;
    const double* in = &x;
    const std::array<double, 3> parameters{0.5, 1, 100};
    double value = 0;
    double* out = &value;
    graph.evaluate({&in, 1}, parameters, {&out, 1}, 1);
    EXPECT_NEAR(value, 2 * std::cos(0.5) * std::cos(0.5) + 100, 1e-12);
}

TEST(Lowering, CountsSlots) {
    const FormulaGraph graph = graphOf("v.z + w.y");
    EXPECT_EQ(graph.variableCount(), 5);
    EXPECT_EQ(graph.parameterCount(), 5);
    EXPECT_EQ(graph.outputCount(), 1);
}

TEST(Lowering, SharedLetsStaySmallAndLargeFormulasEnd) {
    // Doubles with every let: 2^100 additions unshared.
    std::string text;
    std::string last = "x";
    for (int i = 0; i < 100; ++i) {
        const std::string name = "a" + std::to_string(i);
        text += "let " + name + " = " + last + " + " + last + "; ";
        last = name;
    }
    EXPECT_NO_THROW(graphOf(text + last));

    std::string large;
    for (int i = 0; large.size() < kLongestFormula - 50; ++i) large += "sin(x+" + std::to_string(i) + ")+";
    const std::string message = errorOf(large + "x");
    EXPECT_NE(message.find("operations here"), std::string::npos) << message;
}

TEST(Lowering, DamagedFormulasCompileOrSayWhere) {
    test::RandomFormulas random(61, {});
    const std::vector<std::string> pieces{
        "(",  ")",    "[",        "]", ",",    ";",        "let ",   "=",  "x",  "v",
        " ",  ".",    ".x",       "^", "-",    "−",        "!",      "1e", "&&", "|",
        "\n", "\xff", "\xe2\x88", "ü", "sin(", "replace(", "rotate", "9",  "?",  std::string(1, '\0')};
    int errors = 0, compiled = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text = random.below(2) ? random.number(3) : random.vector(3);
        for (int damage = random.below(3); damage >= 0; --damage) {
            const std::size_t at = std::size_t(random.below(int(text.size()) + 1));
            if (random.below(2))
                text.insert(at, pieces[std::size_t(random.below(int(pieces.size())))]);
            else
                text.erase(at, std::size_t(1 + random.below(4)));
        }
        try {
            FormulaGraph({}, {{{text, "damaged"}}}, test::randomFormulaSymbols());
            ++compiled;
        } catch (const FormulaError& error) {
            ++errors;
            const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
            ASSERT_GE(error.line(), 1) << text;
            ASSERT_LE(error.line(), lines) << text;
            ASSERT_GE(error.column(), 1) << text;
            ASSERT_LE(error.column(), int(text.size()) + 1) << text;
            const std::string message = error.what();
            ASSERT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
            ASSERT_EQ(message.back(), '^') << message;
        }
    }
    EXPECT_GT(errors, 10'000);
    EXPECT_GT(compiled, 500);
}

TEST(Lowering, OrderOfErrorsFollowsTheTexts) {
    try {
        FormulaGraph({{"r", {"x + 1", "a"}}}, {{{"r", "b"}}, {{"r + q", "file.stf", 12, 5}}}, kSymbols);
        FAIL();
    } catch (const FormulaError& error) {
        EXPECT_EQ(error.line(), 12);
        EXPECT_EQ(error.column(), 9);
        EXPECT_EQ(std::string(error.what()).substr(0, 30), "file.stf, line 12, column 9: '");
    }
}

}  // namespace
}  // namespace voledit
