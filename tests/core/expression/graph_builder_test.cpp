#include "core/expression/graph_builder.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

const FormulaSymbols kSymbols{{{"x"}, {"y"}}, {{"p"}}, {}};

FormulaGraph graphOf(const std::string& text) {
    return FormulaGraph({}, {{{text, ""}}}, kSymbols);
}

void expectSame(const std::string& a, const std::string& b) {
    EXPECT_TRUE(graphOf(a) == graphOf(b)) << a << "   " << b;
}
void expectDifferent(const std::string& a, const std::string& b) {
    EXPECT_FALSE(graphOf(a) == graphOf(b)) << a << "   " << b;
}

TEST(GraphBuilder, EqualNodesAreOne) {
    GraphBuilder builder;
    const int x = builder.variable(0), y = builder.variable(1);
    EXPECT_EQ(builder.make(Op::Add, x, y), builder.make(Op::Add, y, x));
    EXPECT_NE(builder.make(Op::Subtract, x, y), builder.make(Op::Subtract, y, x));
    EXPECT_EQ(builder.variable(0), x);
    EXPECT_EQ(builder.constant(0.5), builder.constant(0.5));
    EXPECT_NE(builder.constant(0.0), builder.constant(-0.0));
    EXPECT_EQ(builder.constant(kNaN), builder.constant(-kNaN));
    const std::size_t before = builder.nodes().size();
    builder.make(Op::Sine, builder.make(Op::Add, x, y));
    builder.make(Op::Sine, builder.make(Op::Add, y, x));
    EXPECT_EQ(builder.nodes().size(), before + 1);
}

TEST(GraphBuilder, FoldsConstants) {
    expectSame("x * (2 + 3 * 4)", "x * 14");
    expectSame("x + sin(pi / 6)", "x + " + std::to_string(0) + ".49999999999999994");
    expectSame("select(2 > 1, x, y)", "x");
    expectSame("x * noise(0, 0, 0)", "x * 0");
    expectDifferent("x * p", "x * 1");
}

TEST(GraphBuilder, UsesIdentitiesThatHoldToTheBit) {
    for (const std::string text : {"x * 1", "1 * x", "x / 1", "x - 0", "-(-x)", "x^1", "--x", "min(x, x)",
                                   "select(p > 0, x, x)", "select(y > 0 || 1, x, y)"})
        expectSame(text, "x");
    expectSame("x - -y", "x + y");
    expectSame("x + -y", "x - y");
    expectSame("x * -1", "-x");
    expectSame("x / 4", "x * 0.25");
    expectSame("x^2", "x * x");
    expectSame("abs(-x)", "abs(x)");
    expectSame("floor(ceil(x))", "ceil(x)");
    expectSame("!!(x < y)", "x < y");
    expectSame("x < y && 1", "x < y");
    expectSame("x > y", "y < x");
    expectSame("x^0", "1");
}

TEST(GraphBuilder, KeepsWhatOnlySeemsToBeSo) {
    expectDifferent("0 * x", "0");  // NaN where x is infinite
    expectDifferent("x - x", "0");  // likewise
    expectDifferent("x / x", "1");  // NaN at 0
    expectDifferent("x + 0", "x");  // −0 + 0 is +0
    expectDifferent("x / 3", "x * (1 / 3)");
    expectDifferent("x <= x", "1");  // false for NaN
    expectDifferent("!(x < y)", "x >= y");
    expectDifferent("(x + y) + 1", "x + (y + 1)");
    expectDifferent("abs(sqrt(x))", "sqrt(x)");  // of −0
}

TEST(GraphBuilder, KeepsWhatOutputsNeedOnly) {
    const FormulaGraph unused({{"r", {"sin(x) * 7", ""}}}, {{{"y", ""}}}, kSymbols), plain({}, {{{"y", ""}}}, kSymbols);
    EXPECT_TRUE(unused == plain);
}

TEST(GraphBuilder, KnowsWhatIsTheSameForAllPoints) {
    const FormulaGraph graph(
        {}, {{{"p * 2", ""}}, {{"p * x", ""}}, {{"3", ""}}, {{"select(p > 0, 1, 2)", ""}}, {{"y", ""}}}, kSymbols);
    EXPECT_TRUE(graph.isConstant(0));
    EXPECT_FALSE(graph.isConstant(1));
    EXPECT_TRUE(graph.isConstant(2));
    EXPECT_TRUE(graph.isConstant(3));
    EXPECT_FALSE(graph.isConstant(4));
}

}  // namespace
}  // namespace voledit
