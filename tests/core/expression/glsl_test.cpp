#include <gtest/gtest.h>

#include <cmath>

#include "core/expression/formula.h"

namespace voledit {
namespace {

const FormulaSymbols kSymbols{{{"x"}, {"y"}}, {{"angle"}, {"k"}}, {}};

FormulaGraph graphOf(const std::string& text) {
    return FormulaGraph({}, {{{text, ""}}}, kSymbols);
}

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST(Glsl, IsOneFunctionOfVariablesAndOutputs) {
    const FormulaGlsl glsl = graphOf("x * y").glsl("twist7");
    EXPECT_EQ(glsl.text,
              "void twist7(const int base, const float v[2], out float o[1]) {\n"
              "    precise float n2 = v[0] * v[1];\n"
              "    o[0] = n2;\n"
              "}\n");
    EXPECT_EQ(glsl.uniforms, 0);
}

TEST(Glsl, ArraysHaveAtLeastOneElement) {
    const FormulaGlsl glsl = FormulaGraph({}, {{{"3", ""}}}, {}).glsl("f");
    EXPECT_NE(glsl.text.find("const float v[1], out float o[1]"), std::string::npos);
}

TEST(Glsl, WhatDoesNotVaryIsComputedInDoubleOutside) {
    const FormulaGraph graph = graphOf("x * sin(angle) + cos(angle) * k");
    const FormulaGlsl glsl = graph.glsl("f");
    EXPECT_EQ(glsl.uniforms, 2);
    EXPECT_EQ(count(glsl.text, "formulaSin"), 0);
    EXPECT_EQ(count(glsl.text, "formulaUniform(base + "), 2);
    const std::array<double, 2> parameters{0.7, 3};
    const auto uniforms = graph.glslUniforms(parameters);
    ASSERT_EQ(uniforms.size(), 2u);
    EXPECT_EQ(std::max(uniforms[0], uniforms[1]), std::cos(0.7) * 3);
    EXPECT_EQ(std::min(uniforms[0], uniforms[1]), std::sin(0.7));
}

TEST(Glsl, DependsOnTheGraphAlone) {
    // Parameters that happen to be 0 or 1 must not change the text: dragging a slider compiles nothing.
    EXPECT_EQ(graphOf("x * k").glsl("f").text, graphOf("x * angle").glsl("f").text);
    EXPECT_EQ(graphOf("x * k + y").glsl("f").text, graphOf("k * x + y").glsl("f").text);
}

TEST(Glsl, LiteralsBringBackEveryFloat) {
    for (const double value : {0.1, 1.0 / 3, 1e-30, 123456.789, 16777216.0}) {
        std::array<char, 64> spelled{};
        std::snprintf(spelled.data(), spelled.size(), "%.17g", value);
        const std::string text = graphOf("x * " + std::string(spelled.data())).glsl("f").text;
        const std::size_t at = text.find("* ") + 2;
        EXPECT_EQ(std::strtof(text.c_str() + at, nullptr), float(value));
        // GLSL takes a number without point or exponent for an integer.
        EXPECT_NE(text.substr(at, text.find(';', at) - at).find_first_of(".e"), std::string::npos);
    }
}

TEST(Glsl, InfinityAndNaNAreNoLiterals) {
    EXPECT_NE(graphOf("x * (1 / 0)").glsl("f").text.find("formulaInfinity()"), std::string::npos);
    EXPECT_NE(graphOf("x * (-1 / 0)").glsl("f").text.find("-formulaInfinity()"), std::string::npos);
    EXPECT_NE(graphOf("x * (0 / 0)").glsl("f").text.find("formulaNaN()"), std::string::npos);
    EXPECT_NE(graphOf("x * 1e300").glsl("f").text.find("formulaInfinity()"), std::string::npos);
}

TEST(Glsl, AValueComparedWithItselfAsksForNaN) {
    EXPECT_NE(graphOf("!(x == x)").glsl("f").text.find("formulaIsNaN(v[0])"), std::string::npos);
}

}  // namespace
}  // namespace voledit
