#include <gtest/gtest.h>

#include <clocale>

#include "core/expression/syntax.h"

namespace voledit {
namespace {

SyntaxTree tree(const std::string& text) {
    return parsedFormula({text, ""});
}

/// The error that a text gives; fails the test where it gives none.
FormulaError errorOf(const FormulaText& text) {
    try {
        parsedFormula(text);
    } catch (const FormulaError& error) {
        return error;
    }
    ADD_FAILURE() << "no error: " << text.text.substr(0, 100);
    return {"", 0, 0};
}
FormulaError errorOf(const std::string& text) {
    return errorOf(FormulaText{text, ""});
}

void expectSame(const std::string& a, const std::string& b) {
    EXPECT_EQ(tree(a), tree(b)) << a << "   " << b;
}
void expectDifferent(const std::string& a, const std::string& b) {
    EXPECT_NE(tree(a), tree(b)) << a << "   " << b;
}

TEST(Parser, OperatorsBindAsInMathematics) {
    expectSame("a + b * c", "a + (b * c)");
    expectSame("a - b - c", "(a - b) - c");
    expectDifferent("a - b - c", "a - (b - c)");
    expectSame("a / b / c", "(a / b) / c");
    expectSame("a ^ b ^ c", "a ^ (b ^ c)");
    expectSame("-x^2", "-(x^2)");
    expectDifferent("-x^2", "(-x)^2");
    expectSame("2^-x", "2^(-x)");
    expectSame("2^-x^2", "2^(-(x^2))");
    expectSame("a * -b", "a * (-b)");
    expectSame("a < b + 1 && c || !d", "((a < (b + 1)) && c) || (!d)");
    expectSame("!a < b", "(!a) < b");
    expectSame("--x", "-(-x)");
    expectSame("+x", "x");
    expectSame("v.x^2", "(v.x)^2");
    expectSame("-v[1]", "-(v[1])");
}

TEST(Parser, ReadsNumbers) {
    for (const auto& [text, value] : {std::pair{"1", 1.0},
                                      {".5", 0.5},
                                      {"1e-3", 1e-3},
                                      {"2.", 2.0},
                                      {"1.5E+2", 150.0},
                                      {"0.1", 0.1},
                                      {"1e-999", 0.0},
                                      {"1e308", 1e308},
                                      {"007", 7.0}})
        EXPECT_EQ(tree(text).nodes.back().number, value) << text;
    EXPECT_EQ(errorOf("1 + 1e999").column(), 5);
    EXPECT_EQ(errorOf("1" + std::string(400, '0')).column(), 1);
    EXPECT_EQ(tree("0." + std::string(400, '0') + "1").nodes.back().number, 0);
    // A name after a number is a mistake, not part of it.
    EXPECT_EQ(errorOf("2e").column(), 2);
    EXPECT_EQ(errorOf("2pi").column(), 2);
}

TEST(Parser, ReadsNumbersWhateverTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
        std::setlocale(LC_ALL, locale);
        EXPECT_EQ(tree("1.5").nodes.back().number, 1.5) << locale;
    }
    std::setlocale(LC_ALL, before.c_str());
}

TEST(Parser, TakesTheTrueMinusSign) {
    expectSame("1 − x − −2", "1 - x - -2");
}

TEST(Parser, ReadsLets) {
    const SyntaxTree both = tree("let r = x + 1; let s = r * 2; r + s");
    ASSERT_EQ(both.lets.size(), 2u);
    EXPECT_EQ(both.lets[0].name, "r");
    EXPECT_EQ(both.lets[1].name, "s");
    expectSame("let r=x;r", "let r = x ;\n r");
    // Names that begin so are names.
    EXPECT_TRUE(tree("letter + 1").lets.empty());
}

TEST(Parser, TellsLineAndColumn) {
    struct Case {
        std::string text;
        int line, column;
        std::string says;
    };
    const std::vector<Case> cases{
        {"", 1, 1, "empty"},
        {"  \n ", 1, 1, "empty"},
        {"x +", 1, 4, "found the end"},
        {"x +\n  * y", 2, 3, "found '*'"},
        {"(x + 1", 1, 7, "'(' at column 1"},
        {"sin(x", 1, 6, "'(' at column 4"},
        {"v[1", 1, 4, "'[' at column 2"},
        {"(x]", 1, 3, "expected ')'"},
        {"x)", 1, 2, "')' without a '('"},
        {"x]", 1, 2, "']' without a '['"},
        {"a < b < c", 1, 7, "do not chain"},
        {"a == b != c", 1, 8, "do not chain"},
        {"x = 3", 1, 3, "=="},
        {"x y", 1, 3, "operator is missing"},
        {"2 (x)", 1, 3, "operator is missing"},
        {"(x y)", 1, 4, "operator is missing"},
        {"x & y", 1, 3, "&&"},
        {"x | y", 1, 3, "||"},
        {"x % 2", 1, 3, "mod(a, b)"},
        {"x $ y", 1, 3, "'$' cannot stand"},
        {"größe", 1, 3, "'ö' cannot stand"},
        {"α + 1", 1, 1, "'α' cannot stand"},
        {"x # \xff", 1, 3, "'#'"},
        {"x + \xff", 1, 5, "no UTF-8"},
        {"x + \x01", 1, 5, "control character"},
        {"[1, 2]", 1, 1, "three components"},
        {"v.w", 1, 3, "x, y or z"},
        {"f(,)", 1, 3, "found ','"},
        {"f(1,)", 1, 5, "found ')'"},
        {"let = 3; x", 1, 5, "a name after 'let'"},
        {"let r 3; x", 1, 7, "expected '='"},
        {"let r = 3", 1, 10, "expected ';'"},
        {"let r = 3, x", 1, 10, "found ','"},
        {"1 + let r = 3; r", 1, 5, "at a formula's start"},
        {"let r = 3;", 1, 11, "found the end"},
        {"x − − α", 1, 7, "'α'"},
    };
    for (const Case& c : cases) {
        const FormulaError error = errorOf(c.text);
        EXPECT_EQ(error.line(), c.line) << c.text;
        EXPECT_EQ(error.column(), c.column) << c.text;
        EXPECT_NE(std::string(error.what()).find(c.says), std::string::npos) << error.what();
    }
}

TEST(Parser, PlacesErrorsInTheFileTheTextStandsIn) {
    const FormulaError first = errorOf(FormulaText{"x + ?", "twist.stf", 7, 11});
    EXPECT_EQ(first.line(), 7);
    EXPECT_EQ(first.column(), 15);
    EXPECT_EQ(std::string(first.what()),
              "twist.stf, line 7, column 15: '?' cannot stand in a formula\n    x + ?\n        ^");
    const FormulaError second = errorOf(FormulaText{"x +\n ?", "twist.stf", 7, 11});
    EXPECT_EQ(second.line(), 8);
    EXPECT_EQ(second.column(), 2);
}

TEST(Parser, PutsTheCaretBelowTheMistakeWhateverStandsBefore) {
    EXPECT_EQ(std::string(errorOf("x − ?").what()),
              "formula, line 1, column 5: '?' cannot stand in a formula\n    x − ?\n        ^");
    // A tab is one column, in the line shown as in the count.
    EXPECT_EQ(std::string(errorOf("x\t?").what()),
              "formula, line 1, column 3: '?' cannot stand in a formula\n    x ?\n      ^");
}

TEST(Parser, ShowsLongLinesAroundTheMistakeOnly) {
    std::string text;
    for (int i = 0; i < 3000; ++i) text += "x + ";
    const FormulaError error = errorOf(text + "? + " + text + "x");
    EXPECT_EQ(error.column(), 12001);
    const std::string message = error.what();
    EXPECT_LT(message.size(), 400u);
    const auto lines = message.substr(message.find('\n') + 1);
    const std::string shown = lines.substr(0, lines.find('\n')), caret = lines.substr(lines.find('\n') + 1);
    // The ellipsis in front is three bytes and one column.
    EXPECT_EQ(shown.find('?'), caret.find('^') + 2);
}

TEST(Parser, BoundsLengthAndDepth) {
    const auto nested = [](std::size_t levels, const std::string& open, const std::string& close) {
        std::string text;
        for (std::size_t i = 0; i < levels; ++i) text += open;
        text += "x";
        for (std::size_t i = 0; i < levels; ++i) text += close;
        return text;
    };
    for (const auto& [open, close] :
         {std::pair<std::string, std::string>{"(", ")"}, {"sin(", ")"}, {"-", ""}, {"!", ""}, {"2^", ""}, {"+", ""}}) {
        EXPECT_NO_THROW(tree(nested(kDeepestFormula, open, close))) << open;
        EXPECT_NE(std::string(errorOf(nested(kDeepestFormula + 1, open, close)).what()).find("levels deep"),
                  std::string::npos);
        EXPECT_THROW(tree(nested(20'000, open, close)), FormulaError);
    }
    // The brackets alone, as a file cut short has them.
    EXPECT_THROW(tree(std::string(100'000, '(')), FormulaError);
    std::string longest = "x";
    while (longest.size() + 2 <= kLongestFormula) longest += "+x";
    EXPECT_NO_THROW(tree(longest));
    EXPECT_NE(std::string(errorOf(longest + "+x").what()).find("characters long"), std::string::npos);
    EXPECT_THROW(tree(std::string(1'000'000, '(')), FormulaError);
}

}  // namespace
}  // namespace voledit
