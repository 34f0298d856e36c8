#include "app/editor/formula_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/expression/formula.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::HasSubstr;

TEST(FormulaProblemTest, AFormulaErrorComesInParts) {
    const FormulaProblem problem = problemOf(FormulaError("x: line 1, column 3: a number is missing\nx +\n  ^", 1, 3));
    EXPECT_EQ(problem.message, "x: line 1, column 3: a number is missing");
    EXPECT_EQ(problem.excerpt, "x +\n  ^");
    EXPECT_EQ(problem.line, 1);
    EXPECT_EQ(problem.column, 3);
}

TEST(FormulaProblemTest, OtherErrorsHaveNoExcerpt) {
    EXPECT_EQ(problemOf(Error("no\nsuch\nthing")).message, "no\nsuch\nthing");
    EXPECT_EQ(problemOf(Error("no\nsuch\nthing")).excerpt, "");
    EXPECT_EQ(problemOf(Error("^")).excerpt, "");
    EXPECT_EQ(problemOf(Error("a\n^")).message, "a\n^");
}

/// A scene's text, edited by one field; texts with a '!' are wrong, at the '!'.
struct FormulaFieldTest : testing::Test {
    std::string committed = "x", shown = "x";
    FormulaFields fields;
    int steps = 0;
    test::PanelHarness ui{[this] {
        std::string text = shown;
        const Edit edit = fields.draw("Formula", "/x", text, [](const std::string& t) {
            const auto at = t.find('!');
            if (at != t.npos) throw FormulaError("wrong\n" + t + "\n" + std::string(at, ' ') + "^", 1, int(at) + 1);
        });
        if (edit.changed) shown = text;
        if (edit.cancelled) shown = committed;
        if (edit.finished && shown != committed) {
            committed = shown;
            ++steps;
        }
    }};
    void type(const std::string& text) {
        for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        ui.frame(2);
    }
    /// Clicks into the field, behind its text.
    void begin() { ui.click(Vec2(ui.place("Formula").max.x - 4, ui.at("Formula").y)); }
};

TEST_F(FormulaFieldTest, ARightTextIsPreviewedWhileTypingAndOneStepInTheEnd) {
    begin();
    type("+1");
    EXPECT_EQ(shown, "x+1");
    EXPECT_EQ(committed, "x");
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(committed, "x+1");
    EXPECT_EQ(steps, 1);
}

TEST_F(FormulaFieldTest, AWrongTextChangesNothingAndIsToldWithItsCaret) {
    begin();
    type("+");
    type("!");
    EXPECT_EQ(shown, "x+");  // the last right one
    ASSERT_NE(fields.problem("/x"), nullptr);
    EXPECT_EQ(fields.problem("/x")->excerpt, "x+!\n  ^");
    EXPECT_TRUE(ui.has("Mistake"));
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(shown, "x");
    EXPECT_EQ(steps, 0);
    // The text stays, to be mended.
    EXPECT_NE(fields.problem("/x"), nullptr);
    begin();
    ui.press(Key::Backspace);
    type("2");
    EXPECT_EQ(shown, "x+2");
    EXPECT_EQ(fields.problem("/x"), nullptr);
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(committed, "x+2");
    EXPECT_EQ(steps, 1);
}

TEST_F(FormulaFieldTest, EscapeRestores) {
    begin();
    type("+1");
    ui.press(Key::Escape);
    ui.frame(2);
    EXPECT_EQ(shown, "x");
    EXPECT_EQ(steps, 0);
    begin();
    type("!");
    ui.press(Key::Escape);
    ui.frame(2);
    EXPECT_EQ(fields.problem("/x"), nullptr);
}

TEST_F(FormulaFieldTest, AChangeFromElsewhereDropsAWrongDraft) {
    begin();
    type("!");
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_NE(fields.problem("/x"), nullptr);
    shown = committed = "y";
    ui.frame(2);
    EXPECT_EQ(fields.problem("/x"), nullptr);
}

}  // namespace
}  // namespace voledit
