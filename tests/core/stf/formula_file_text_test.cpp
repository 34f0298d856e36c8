#include "core/stf/formula_file_text.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

TEST(FormulaFileText, StatementsAreLinesAndWhatIsIndentedBelow) {
    const FormulaFileText text("one\n\n# comment\ntwo # and more\n\tstill two\n\n   # a comment too\n  and this\nthree",
                               "f");
    ASSERT_EQ(text.statements().size(), 3u);
    const auto at = [&](std::size_t n) {
        FormulaFileCursor cursor(text, text.statements()[n]);
        return cursor.line("a text");
    };
    EXPECT_EQ(at(0), "one");
    EXPECT_EQ(at(1), "two still two and this");
    EXPECT_EQ(at(2), "three");
    EXPECT_TRUE(FormulaFileText("\n  \n# nothing\n", "f").statements().empty());
}

TEST(FormulaFileText, QuotesHideCommentsAndEndWithTheStatement) {
    const FormulaFileText text("a \"# one\n  # two\" # gone\nb \"open # \nc # gone\n", "f");
    ASSERT_EQ(text.statements().size(), 3u);
    FormulaFileCursor a(text, text.statements()[0]), b(text, text.statements()[1]), c(text, text.statements()[2]);
    EXPECT_EQ(a.word("a"), "a");
    EXPECT_EQ(a.quoted("text"), "# one # two");
    EXPECT_TRUE(a.atEnd());
    b.word("b");
    EXPECT_THROW(b.quoted("text"), FormulaError);
    EXPECT_EQ(c.line("text"), "c");
}

TEST(FormulaFileText, CursorsReadNumbersAndCutFormulasAtOuterCommas) {
    const FormulaFileText text("-1.5e3 +2 inf .5 f(a, [b, c]), d,\n  e", "f");
    FormulaFileCursor cursor(text, text.statements()[0]);
    EXPECT_EQ(cursor.number("n"), -1500);
    EXPECT_EQ(cursor.number("n"), 2);
    EXPECT_EQ(cursor.number("n"), kInfinity);
    EXPECT_EQ(cursor.number("n"), 0.5);
    const auto formulas = cursor.formulas("a formula");
    ASSERT_EQ(formulas.size(), 3u);
    EXPECT_EQ(formulas[0].text, "f(a, [b, c])");
    EXPECT_EQ(formulas[1].text, "d");
    EXPECT_EQ(formulas[2].text, "e");
    EXPECT_EQ(formulas[2].line, 2);
    EXPECT_EQ(formulas[2].column, 3);
    EXPECT_NO_THROW(cursor.finish());
}

TEST(FormulaFileText, PlacesAreCountedInCharacters) {
    const FormulaFileText text("ä\nöü x", "f");
    EXPECT_EQ(text.lineOf(0), 1);
    const std::size_t x = text.text().find('x');
    EXPECT_EQ(text.lineOf(x), 2);
    EXPECT_EQ(text.columnOf(x), 4);
}

}  // namespace
}  // namespace voledit
