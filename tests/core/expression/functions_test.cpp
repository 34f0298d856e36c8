#include "core/expression/functions.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voledit {
namespace {

TEST(Functions, AreSortedByNameEachOnce) {
    const auto functions = formulaFunctions();
    for (std::size_t i = 1; i < functions.size(); ++i) EXPECT_LT(functions[i - 1].name, functions[i].name);
    for (const FormulaFunction& f : functions) EXPECT_EQ(formulaFunction(f.name), &f);
    EXPECT_EQ(formulaFunction("none"), nullptr);
}

TEST(Functions, AllOfThePublicContractAreThere) {
    for (const char* name : {"select",     "sin",    "cos",   "tan",   "asin",      "acos",   "atan",  "atan2", "sinh",
                             "cosh",       "tanh",   "exp",   "log",   "log2",      "pow",    "sqrt",  "abs",   "sign",
                             "floor",      "ceil",   "fract", "mod",   "min",       "max",    "clamp", "mix",   "step",
                             "smoothstep", "length", "dot",   "cross", "normalize", "rotate", "noise"})
        EXPECT_NE(formulaFunction(name), nullptr) << name;
}

TEST(Functions, FormsShowTheFewestArguments) {
    for (const FormulaFunction& f : formulaFunctions()) {
        const std::string form(f.form.substr(0, f.form.find(" or ")));
        if (form.find("…") != std::string::npos) continue;
        const int shown = 1 + int(std::count(form.begin(), form.end(), ','));
        EXPECT_GE(shown, f.fewest) << form;
        EXPECT_LE(shown, f.most) << form;
        EXPECT_EQ(form.substr(0, f.name.size() + 1), std::string(f.name) + "(");
        EXPECT_FALSE(f.description.empty());
    }
}

TEST(Functions, RotationsAboutACoordinateAxisCostNoMoreThanByHand) {
    const FormulaSymbols symbols{{{"v", 3}}, {{"angle"}}, {}};
    const FormulaGraph rotated({}, {{{"rotate(v, [0, 0, 1], angle)", ""}, FormulaType::Vector}}, symbols);
    // Four products and two sums; the sine and the cosine are the same for all points.
    const std::string text = rotated.glsl("f").text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '*'), 4);
    EXPECT_EQ(rotated.glsl("f").uniforms, 2);
    const FormulaGraph along({}, {{{"rotate(v, [0, 0, -3], angle).z", ""}}}, symbols),
        itself({}, {{{"v.z", ""}}}, symbols);
    EXPECT_TRUE(along == itself);
}

}  // namespace
}  // namespace voledit
