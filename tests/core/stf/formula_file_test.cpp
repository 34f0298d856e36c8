#include "core/stf/formula_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace voledit {
namespace {

using testing::HasSubstr;

FormulaFile read(const std::string& text) {
    return parseFormulaFile(text, "test.stf");
}

struct Mistake {
    std::string text, message;
    int line, column;
};

void expectMistake(const Mistake& mistake) {
    try {
        read(mistake.text);
        ADD_FAILURE() << "accepted: " << mistake.text;
    } catch (const FormulaError& error) {
        EXPECT_THAT(error.what(), HasSubstr(mistake.message)) << mistake.text;
        EXPECT_THAT(error.what(), HasSubstr("test.stf, line " + std::to_string(mistake.line)));
        EXPECT_EQ(error.line(), mistake.line) << mistake.text;
        EXPECT_EQ(error.column(), mistake.column) << mistake.text << "\n" << error.what();
    }
}

TEST(FormulaFile, ReadsEveryStatement) {
    const FormulaFile file = read(R"(# comment
title: A title: with a colon
description: Two
    lines.
source: Somebody 1999   # comment
space: world
bounded: yes

parameter a  number = -1.5e-1  allowed (-1, inf)  slider [-2, 2]  degrees, strength from 1   "A # within quotes"
parameter b  pair suggested [1, 2] length "b"
parameter c  vector = 2 uniform
    "c over
     two lines"   # and a comment
parameter d  line suggested [1, 2, 3] along [0, 0, -1] "d"
parameter f  axis = z "f"
parameter g  axes suggested [x, z] "g"
error "no" when a > 0 &&
    b[0] < 1
warning "hm" when true_one

let h = a +
    1
[map]
let i = x
q = p * h
undefined = i > 3
[image]
let j = low[0]
over k = j, clamp(j, 0, 1), [1, 2, 3][0]
over l = 0
let m = k
point = [k, l, m]
)");
    EXPECT_EQ(file.title, "A title: with a colon");
    EXPECT_EQ(file.description, "Two lines.");
    EXPECT_EQ(file.source, "Somebody 1999");
    EXPECT_TRUE(file.world);
    EXPECT_TRUE(file.bounded);
    ASSERT_EQ(file.parameters.size(), 6u);
    const TransferParameter& a = file.parameters[0];
    EXPECT_EQ(a.initial, TransferArgument(std::vector<double>{-0.15}));
    EXPECT_EQ(a.suggested, *a.initial);
    EXPECT_EQ(a.description, "A # within quotes");
    EXPECT_GT(a.allowed.low, -1);
    EXPECT_LT(a.allowed.low, -0.999999);
    EXPECT_EQ(a.allowed.high, kInfinity);
    EXPECT_EQ(a.slider, (Interval{-2, 2}));
    EXPECT_EQ(a.unit, "degrees");
    EXPECT_TRUE(a.strength);
    EXPECT_EQ(a.identity, 1);
    EXPECT_FALSE(file.parameters[1].initial);
    EXPECT_EQ(file.parameters[1].suggested, TransferArgument(std::vector<double>{1, 2}));
    EXPECT_EQ(file.parameters[2].initial, TransferArgument(std::vector<double>{2, 2, 2}));
    EXPECT_TRUE(file.parameters[2].uniform);
    EXPECT_EQ(file.parameters[2].description, "c over two lines");
    EXPECT_EQ(file.parameters[3].suggested, TransferArgument(LineValue{{1, 2, 3}, {0, 0, -1}}));
    EXPECT_EQ(file.parameters[4].initial, TransferArgument(std::vector<int>{2}));
    EXPECT_EQ(file.parameters[5].suggested, TransferArgument(std::vector<int>{0, 2}));
    ASSERT_EQ(file.checks.size(), 2u);
    EXPECT_TRUE(file.checks[0].isError);
    EXPECT_EQ(file.checks[0].message, "no");
    EXPECT_EQ(file.checks[0].condition.text, "a > 0 &&\n    b[0] < 1");
    EXPECT_EQ(file.checks[0].condition.line, 17);
    EXPECT_EQ(file.checks[0].condition.column, 17);
    EXPECT_FALSE(file.checks[1].isError);
    ASSERT_EQ(file.lets.size(), 1u);
    EXPECT_EQ(file.lets[0].formula.text, "a +\n    1");
    EXPECT_EQ(file.mapLets[0].name, "i");
    EXPECT_EQ(file.point->text, "p * h");
    EXPECT_EQ(file.point->line, 25);
    EXPECT_EQ(file.point->column, 5);
    EXPECT_EQ(file.point->where, "test.stf");
    EXPECT_EQ(file.undefined->text, "i > 3");
    ASSERT_TRUE(file.image);
    ASSERT_EQ(file.image->overs.size(), 2u);
    ASSERT_EQ(file.image->overs[0].values.size(), 3u);
    EXPECT_EQ(file.image->overs[0].values[1].text, "clamp(j, 0, 1)");
    EXPECT_EQ(file.image->overs[0].values[1].column, 13);
    EXPECT_EQ(file.image->overs[0].values[2].text, "[1, 2, 3][0]");
    EXPECT_EQ(file.image->lets.size(), 1u);
    EXPECT_EQ(file.image->laterLets.size(), 1u);
}

TEST(FormulaFile, ReadsCoordinatesOneByOneAndForeignLineEnds) {
    const FormulaFile file = read("\xEF\xBB\xBF[map]\r\nx = x +\r\n\ty\r\nz = 2\r\n");
    EXPECT_EQ(file.x->text, "x + \n\ty");
    EXPECT_FALSE(file.y);
    EXPECT_EQ(file.z->line, 4);
    EXPECT_FALSE(file.world || file.bounded || file.image || file.point);
}

TEST(FormulaFile, SaysWhatIsWrongAndWhere) {
    const std::string end = "\n[map]\nq = u\n";
    for (const Mistake& mistake : std::vector<Mistake>{
             {"", "[map]", 1, 1},
             {"   title: x", "continues the one above", 1, 4},
             {"titel: x", "\"titel\" is not known", 1, 1},
             {"title x", "expected \":\"", 1, 7},
             {"title:", "expected a text", 1, 7},
             {"title: a\ntitle: b", "said before", 2, 8},
             {"space: moon", "\"frame\" or \"world\"", 1, 8},
             {"bounded: yes please", "ended here", 1, 14},
             {"= 3", "expected title", 1, 1},
             {"parameter", "expected a name", 1, 10},
             {"parameter 2a number", "begins with a letter", 1, 11},
             {"parameter x number = 1 \"\"", "something else", 1, 11},
             {"parameter amount number = 1 \"\"", "something else", 1, 11},
             {"parameter a number = 1 \"\"\nparameter a number = 1 \"\"", "already", 2, 11},
             {"parameter l line suggested [0,0,0] along [0,0,1] \"\"\nparameter l_point number = 1 \"\"", "already", 2,
              11},
             {"parameter a matrix", "kind", 1, 13},
             {"parameter a number \"no value\"", "default", 1, 20},
             {"parameter a number = 1", "expected", 1, 23},
             {"parameter a number = one \"\"", "a number", 1, 22},
             {"parameter a number = nan \"\"", "a number", 1, 22},
             {"parameter a number = inf \"\"", "not allowed", 1, 26},
             {"parameter a pair = [1 2] \"\"", "\",\"", 1, 23},
             {"parameter a pair = 1 \"\"", "two numbers", 1, 20},
             {"parameter a vector = [1, 2, 3, 4] \"\"", "\"]\"", 1, 30},
             {"parameter a vector = 1 \"\"", "three numbers", 1, 24},
             {"parameter a line = [0, 0, 0] \"\"", "along", 1, 30},
             {"parameter a line = [0, 0, 0] along [0, 0, 0] \"\"", "direction", 1, 46},
             {"parameter a axis = w \"\"", "x, y or z", 1, 20},
             {"parameter a axis = xy \"\"", "x, y or z", 1, 20},
             {"parameter a axes = [x, y \"\"", "\"]\"", 1, 26},
             {"parameter a axis = x slider [0, 1] \"\"", "only numbers", 1, 22},
             {"parameter a number = 1 uniform \"\"", "only a vector", 1, 24},
             {"parameter a number = 3 allowed [0, 1] \"\"", "not allowed", 1, 39},
             {"parameter a number = 3 allowed [5, 1] \"\"", "empty", 1, 39},
             {"parameter a number = 3 slider [0, inf] \"\"", "two ends", 1, 40},
             {"parameter a number = 3 slidder [0, 1] \"\"", "slider", 1, 24},
             {"parameter a number = 3 \"open", "does not end", 1, 24},
             {"let a 3", "\"=\"", 1, 7},
             {"let a =", "a formula", 1, 8},
             {"error when 1", "a message", 1, 7},
             {"error \"x\" if 1", "when", 1, 11},
             {"[image]", "[map]", 1, 2},
             {"[map]\n[map]", "[map]", 2, 2},
             {"[map]\nr = 1", "q =", 2, 1},
             {"[map]\nq = 1\nq = 2", "given before", 3, 1},
             {"[map]\nq = 1\nx = 2", "not both", 3, 1},
             {"[map]\nundefined = 1\n", "gives no point", 3, 1},
             {"title: a" + end + "[image]\n[image]", "[image]", 5, 2},
             {"title: a" + end + "[image]\n", "needs either", 5, 1},
             {"title: a" + end + "[image]\nmin = low", "needs either", 5, 10},
             {"title: a" + end + "[image]\nover a = 1,", "a formula", 5, 12},
             {"title: a" + end + "[image]\nover low = 1", "something else", 5, 6},
             {"title: a" + end + "[image]\nover a = 1\nlet b = a\nover c = 1", "together", 7, 6},
             {"title: a" + end + "[image]\nover a = 1\nmin = low\nmax = high", "goes with point", 7, 11},
             {"título: x", "not known", 1, 1},
         })
        expectMistake(mistake);
}

TEST(FormulaFile, CountsColumnsInCharactersAndDrawsTheCaretBelow) {
    try {
        read("title: x\nparameter d number = 1  \"Ψ₂ und äöü\" more");
        FAIL();
    } catch (const FormulaError& error) {
        EXPECT_EQ(error.column(), 38);
        const std::string message = error.what();
        const std::size_t caret = message.rfind('^'), line = message.rfind('\n');
        EXPECT_EQ(caret - line - 1, 2u + 37u);
    }
    try {
        read("title: x\nwarning \"" + std::string(100'000, 'm') + "\" when");
        FAIL();
    } catch (const FormulaError& error) {
        EXPECT_LT(std::string(error.what()).size(), 400u);  // a line that long is shown in part
    }
}

TEST(FormulaFile, LimitsCombinations) {
    std::string text = "[map]\nq = u\n[image]\n";
    for (char c = 'a'; c < 'n'; ++c) text += std::string("over o") + c + " = 0, 1\n";
    expectMistake({text + "point = low\n", "combinations", 16, 15});
}

TEST(FormulaFile, MutilatedFilesAreErrorsOrFine) {
    const std::string whole =
        "title: a\nparameter a number = 1 allowed [0, 2] slider [0, 1] strength from 0 \"b\"\n"
        "parameter l line suggested [0, 0, 0] along [0, 0, 1] \"d\"\nlet b = a\n"
        "error \"no\" when a > 1\n[map]\nlet c = b\nq = u * c\nundefined = c > 2\n[image]\n"
        "over i = 0, 1\npoint = mix(low, high, i)\n";
    EXPECT_NO_THROW(read(whole));
    std::mt19937 random(1);
    int refused = 0;
    for (int n = 0; n < 20000; ++n) {
        std::string text = whole;
        for (unsigned k = random() % 4 + 1; k > 0; --k) {
            const std::size_t at = random() % text.size();
            switch (random() % 3) {
                case 0:
                    text[at] = char(random() % 256);
                    break;
                case 1:
                    text.erase(at, random() % 20);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 20));
            }
        }
        try {
            read(text);
        } catch (const FormulaError& error) {
            ++refused;
            ASSERT_GE(error.line(), 1);
            ASSERT_GE(error.column(), 1);
        }
    }
    EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace voledit
