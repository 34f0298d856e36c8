#include <gtest/gtest.h>

#include "core/expression/syntax.h"
#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

SyntaxTree tree(const std::string& text) {
    return parsedFormula({text, ""});
}

TEST(Print, OneSpellingWithTheFewestBrackets) {
    for (const auto& [text, canonical] : {std::pair{"((x))+(y*(z))", "x + y * z"},
                                          {"(x+y)*z", "(x + y) * z"},
                                          {"x-(y-z)", "x - (y - z)"},
                                          {"(x-y)-z", "x - y - z"},
                                          {"(x^y)^z", "(x^y)^z"},
                                          {"x^(y^z)", "x^y^z"},
                                          {"-(x^2)", "-x^2"},
                                          {"(-x)^2", "(-x)^2"},
                                          {"2^(-x)", "2^-x"},
                                          {"(a<b)==c", "(a < b) == c"},
                                          {"!(a&&b)||c", "!(a && b) || c"},
                                          {"( v + w ) . x", "(v + w).x"},
                                          {"(v)[ 1 ]", "v[1]"},
                                          {"[1,2,x]", "[1, 2, x]"},
                                          {"max( 1 ,x )", "max(1, x)"},
                                          {"let  r=x ;r", "let r = x; r"},
                                          {"x − 1.50", "x - 1.5"},
                                          {"1e3*0.000001", "1000 * 1e-06"}})
        EXPECT_EQ(printedFormula({text, ""}), canonical);
}

TEST(Print, ReadsBackAsTheSameTree) {
    test::RandomFormulas random(11, {});
    for (int i = 0; i < 3000; ++i) {
        const std::string text = random.number(1 + i % 6);
        const std::string canonical = printed(tree(text));
        ASSERT_EQ(tree(canonical), tree(text)) << text << "\n" << canonical;
        ASSERT_EQ(printed(tree(canonical)), canonical);
    }
}

/// `text` without the bracket at `open` and the one that closes it.
std::string without(const std::string& text, std::size_t open) {
    std::size_t close = open;
    for (int depth = 0;; ++close) {
        depth += text[close] == '(' ? 1 : text[close] == ')' ? -1 : 0;
        if (depth == 0) break;
    }
    return text.substr(0, open) + text.substr(open + 1, close - open - 1) + text.substr(close + 1);
}

TEST(Print, EveryBracketIsNeeded) {
    test::RandomFormulas random(12, {});
    int brackets = 0;
    for (int i = 0; i < 5000; ++i) {
        const std::string text = printed(tree(random.number(1 + i % 5)));
        for (std::size_t at = 0; at < text.size(); ++at) {
            if (text[at] != '(' || (at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1])))) continue;
            ++brackets;
            try {
                EXPECT_NE(tree(without(text, at)), tree(text)) << text << "  at " << at;
            } catch (const FormulaError&) {
            }
        }
    }
    EXPECT_GT(brackets, 1000);
}

TEST(Print, LongSumsTakeNoTime) {
    std::string text = "x";
    while (text.size() + 4 <= kLongestFormula) text += " + x";
    EXPECT_EQ(printedFormula({text, ""}), text);
}

}  // namespace
}  // namespace voledit
