// GLSL made from formulas against the double evaluator, on random formulas. The measure: single precision may differ
// from double by 1e-5 of the value plus the bound of what its roundings do (two units an operation, carried along the
// tree to first order); a formula's point is well-conditioned where that bound is itself below 1e-5 of the value.

#include <filesystem>

#include "render/gl_objects.h"
#include "render/shader_library.h"
#include "tests/render/render_fixtures.h"
#include "tests/support/fixtures.h"
#include "tests/support/formula_oracle.h"
#include "tests/support/random_formulas.h"

namespace voledit {
namespace {

using namespace test;

constexpr int kPoints = 64;    // of each formula
constexpr int kTogether = 25;  // formulas in one program: drivers take longer than in proportion for larger ones

/// A compute program that evaluates all of `graphs` at kPoints points.
Program compiled(const std::vector<FormulaGraph>& graphs) {
    const auto library = loadShader(fixture("../shaders"), "common/formula.glsl", {});
    std::string text =
        "#version 450 core\n"
        "layout(local_size_x = " +
        std::to_string(kPoints) +
        ") in;\n"
        "layout(std430, binding = 0) readonly buffer In { float inputs[]; };\n"
        "layout(std430, binding = 1) readonly buffer Uniforms { float uniforms[]; };\n"
        "layout(std430, binding = 2) writeonly buffer Out { float outputs[]; };\n"
        "float formulaUniform(int k) { return uniforms[k]; }\n";
    text += library.text;
    std::string body;
    int base = 0, outputs = 0;
    for (std::size_t f = 0; f < graphs.size(); ++f) {
        const std::string name = "f" + std::to_string(f), count = std::to_string(graphs[f].outputCount());
        const FormulaGlsl glsl = graphs[f].glsl(name);
        text += glsl.text;
        body += "    { float o[" + count + "]; " + name + "(" + std::to_string(base) + ", v, o);\n";
        for (int o = 0; o < graphs[f].outputCount(); ++o)
            body += "      outputs[" + std::to_string(outputs++) + " * " + std::to_string(kPoints) + " + point] = o[" +
                    std::to_string(o) + "];\n";
        body += "    }\n";
        base += glsl.uniforms;
    }
    text += "void main() {\n    int point = int(gl_LocalInvocationID.x);\n    float v[" +
            std::to_string(kRandomVariables) + "];\n    for (int n = 0; n < " + std::to_string(kRandomVariables) +
            "; ++n) v[n] = inputs[n * " + std::to_string(kPoints) + " + point];\n" + body + "}\n";

    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    std::array<char, 4096> log{};
    if (!good) glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
    EXPECT_TRUE(good) << log.data();
    Program program(glCreateProgram());
    glAttachShader(program.name(), shader);
    glLinkProgram(program.name());
    glDeleteShader(shader);
    glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
    EXPECT_TRUE(good);
    return program;
}

/// Points and parameters that single precision holds exactly.
struct Inputs {
    std::vector<double> variables, parameters;  // variable n at point i: n · kPoints + i

    explicit Inputs(RandomFormulas& random) {
        for (int n = 0; n < kRandomVariables * kPoints; ++n) variables.push_back(random.value(-2, 2));
        for (int n = 0; n < kRandomParameters; ++n) parameters.push_back(random.value(0.25, 2));
    }
    Oracle<Rounded>::Names names(std::size_t point) const {
        const auto exact = [](double x) { return Rounded(x, 0); };
        const auto v = [&](std::size_t n) { return exact(variables[n * kPoints + point]); };
        const auto p = [&](std::size_t n) { return exact(parameters[n]); };
        return {{"x", {1, {v(0)}}},
                {"y", {1, {v(1)}}},
                {"z", {1, {v(2)}}},
                {"v", {3, {v(3), v(4), v(5)}}},
                {"p", {1, {p(0)}}},
                {"q", {1, {p(1)}}},
                {"w", {3, {p(2), p(3), p(4)}}}};
    }
};

/// All outputs of all graphs, one after the other, kPoints each.
std::vector<float> onGpu(const std::vector<FormulaGraph>& graphs, const Inputs& inputs) {
    Program program = compiled(graphs);
    const std::vector<float> variables(inputs.variables.begin(), inputs.variables.end());
    std::vector<float> uniforms;
    std::size_t count = 0;
    for (const FormulaGraph& graph : graphs) {
        for (const double u : graph.glslUniforms(inputs.parameters)) uniforms.push_back(float(u));
        count += std::size_t(graph.outputCount()) * kPoints;
    }
    uniforms.push_back(0);
    const Buffer in = makeBuffer(), uniform = makeBuffer(), out = makeBuffer();
    std::vector<float> result(count, -1234);
    fill<float>(in, variables);
    fill<float>(uniform, uniforms);
    fill<float>(out, result);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, uniform.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, out.name());
    program.use();
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(out.name(), 0, GLsizeiptr(count * sizeof(float)), result.data());
    glUseProgram(0);
    return result;
}

struct Tally {
    int compared = 0, wellConditioned = 0, undefined = 0;
};

void compare(const std::string& text, const Inputs& inputs, std::span<const float> gpu, Tally& tally) {
    for (std::size_t point = 0; point < kPoints; ++point) {
        const Rounded expected = Oracle<Rounded>().evaluate(text, inputs.names(point)).at[0];
        if (!(expected.error < kInfinity)) continue;
        const double value = gpu[point];
        ++tally.compared;
        if (expected.value != expected.value) {
            ++tally.undefined;
            ASSERT_TRUE(value != value) << text << "\n" << value << " instead of NaN at point " << point;
            continue;
        }
        const double near = 1e-5 * std::abs(expected.value);
        tally.wellConditioned += expected.error <= near;
        ASSERT_LE(std::abs(value - expected.value), near + expected.error)
            << text << "\n"
            << value << " instead of " << expected.value << " at point " << point;
    }
}

void compareRandom(unsigned seed, RandomFormulas::Kinds kinds, int batches) {
    offscreen().makeCurrent();
    RandomFormulas random(seed, kinds);
    Tally tally;
    for (int batch = 0; batch < batches; ++batch) {
        std::vector<std::string> texts;
        std::vector<FormulaGraph> graphs;
        for (int i = 0; i < kTogether; ++i) {
            texts.push_back(random.number(1 + i % 4));
            graphs.push_back(FormulaGraph({}, {{{texts.back(), ""}}}, randomFormulaSymbols()));
        }
        const Inputs inputs(random);
        const auto gpu = onGpu(graphs, inputs);
        for (std::size_t f = 0; f < texts.size(); ++f) {
            compare(texts[f], inputs, std::span(gpu).subspan(f * kPoints, kPoints), tally);
            if (testing::Test::HasFatalFailure()) return;
        }
    }
    const int all = batches * kTogether * kPoints;
    testing::Test::RecordProperty("compared", tally.compared);
    testing::Test::RecordProperty("well_conditioned", tally.wellConditioned);
    EXPECT_GT(tally.compared, all * 7 / 10);
    EXPECT_GT(tally.wellConditioned, all / 2);
    if (kinds.wild) {
        EXPECT_GT(tally.undefined, all / 1000);
    }
}

TEST(FormulaParity, RandomFormulas) {
    compareRandom(51, {}, 80);
}

TEST(FormulaParity, SmoothFormulas) {
    compareRandom(52, {.steps = false, .noise = false, .wild = false}, 20);
}

TEST(FormulaParity, Derivatives) {
    offscreen().makeCurrent();
    RandomFormulas random(53, {.steps = true, .noise = false, .wild = false});
    const std::array<int, 3> by{0, 1, 2};
    const Inputs inputs(random);
    std::vector<std::string> texts;
    std::vector<FormulaGraph> graphs;
    for (int i = 0; i < 100; ++i) {
        texts.push_back(random.number(1 + i % 3));
        graphs.push_back(FormulaGraph({}, {{{texts.back(), ""}}}, randomFormulaSymbols()).withDerivatives(by));
    }
    const auto gpu = onGpu(graphs, inputs);
    int compared = 0;
    for (std::size_t f = 0; f < graphs.size(); ++f)
        for (std::size_t point = 0; point < kPoints; ++point) {
            // How much rounding does shows by moving the point by single-precision units.
            std::array<std::array<double, 4>, 3> values{};
            for (const int move : {0, 1, 2}) {
                std::array<double, kRandomVariables> at{};
                std::array<const double*, kRandomVariables> in{};
                std::array<double*, 4> out{};
                for (std::size_t n = 0; n < at.size(); ++n) {
                    at[n] = inputs.variables[n * kPoints + point] * (1 + (move == 1   ? 1
                                                                          : move == 2 ? -1
                                                                                      : 0) *
                                                                             (n % 2 ? -1 : 1) * 1e-6);
                    in[n] = &at[n];
                }
                for (std::size_t o = 0; o < 4; ++o) out[o] = &values[std::size_t(move)][o];
                graphs[f].evaluate(in, inputs.parameters, out, 1);
            }
            for (std::size_t o = 1; o < 4; ++o) {
                const double expected = values[0][o];
                const double moved = std::abs(values[1][o] - expected) + std::abs(values[2][o] - expected);
                if (!(moved < 1e-4 * std::abs(expected))) continue;
                ASSERT_NEAR(gpu[(f * 4 + o) * kPoints + point], expected, 1e-5 * std::abs(expected) + 3 * moved)
                    << texts[f];
                ++compared;
            }
        }
    EXPECT_GT(compared, 3000);
}

TEST(FormulaParity, DerivativesOfNoise) {
    offscreen().makeCurrent();
    RandomFormulas random(56, {});
    const Inputs inputs(random);
    const std::array<int, 3> by{0, 1, 2};
    const FormulaGraph graph =
        FormulaGraph({}, {{{"noise(x, y, z)", ""}}}, randomFormulaSymbols()).withDerivatives(by).withDerivatives(by);
    const auto gpu = onGpu({graph}, inputs);
    for (std::size_t o = 0; o < 16; ++o) {
        std::array<int, 3> order{};
        if (o / 4 > 0) ++order[o / 4 - 1];
        if (o % 4 > 0) ++order[o % 4 - 1];
        // Output 4a + b of the second graph: the ath of the first, differentiated by the bth; but values come first.
        const std::size_t output = o % 4 == 0 ? o / 4 : 4 + 3 * (o / 4) + o % 4 - 1;
        for (std::size_t point = 0; point < kPoints; ++point) {
            const auto at = [&](std::size_t n) { return inputs.variables[n * kPoints + point]; };
            EXPECT_NEAR(gpu[output * kPoints + point], noise(at(0), at(1), at(2), order), 1e-6 * noiseBound(order));
        }
    }
}

TEST(FormulaParity, EveryFunctionOverItsDomain) {
    offscreen().makeCurrent();
    RandomFormulas random(54, {});
    Inputs inputs(random);
    // x over wide ranges of either sign, y near 1, z within (0, 1).
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double wide = std::pow(10.0, random.value(-6, 1.5)) * (i % 2 ? 1 : -1);
        inputs.variables[i] = float(wide);
        inputs.variables[kPoints + i] = float(1 + wide / 100);
        inputs.variables[2 * kPoints + i] = random.value(0, 1);
    }
    std::vector<std::string> texts;
    std::vector<FormulaGraph> graphs;
    for (const std::string f : {"sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log",
                                "log2", "sqrt", "abs", "sign", "floor", "ceil", "fract"})
        for (const std::string argument : {"x", "y", "z", "-z", "1 - z / 1000", "20 * x"})
            texts.push_back(f + "(" + argument + ")");
    for (const std::string f : {"atan2(x, y)",
                                "atan2(x, v.x)",
                                "atan2(v.y, v.x)",
                                "mod(x, z)",
                                "mod(x, v.x)",
                                "x^y",
                                "abs(x)^y",
                                "abs(x)^z",
                                "y^x",
                                "z^v.x",
                                "x^3",
                                "x^-3",
                                "x^13",
                                "min(x, z)",
                                "max(x, z)",
                                "noise(x, y, z)",
                                "noise(7 * v)",
                                "smoothstep(0, 1, x)",
                                "step(x, z)",
                                "rotate(v, [x, 1, z], y).x",
                                "normalize(v).z"})
        texts.push_back(f);
    for (const std::string& text : texts) graphs.push_back(FormulaGraph({}, {{{text, ""}}}, randomFormulaSymbols()));
    const auto gpu = onGpu(graphs, inputs);
    Tally tally;
    for (std::size_t f = 0; f < texts.size(); ++f)
        compare(texts[f], inputs, std::span(gpu).subspan(f * kPoints, kPoints), tally);
    EXPECT_GT(tally.wellConditioned, int(texts.size()) * kPoints / 2);
}

TEST(FormulaParity, NaNAndInfinity) {
    offscreen().makeCurrent();
    RandomFormulas random(55, {});
    Inputs inputs(random);
    inputs.variables[0] = 0;  // x
    inputs.parameters[0] = 0;
    struct Case {
        std::string text;
        double expected;
    };
    const std::vector<Case> cases{{"sqrt(x - 1)", kNaN},
                                  {"log(x - 1)", kNaN},
                                  {"log(x)", -kInfinity},
                                  {"1 / x", kInfinity},
                                  {"x / x", kNaN},
                                  {"1 / p + x", kInfinity},
                                  {"min(x / x, 1)", kNaN},
                                  {"max(1, x / x)", kNaN},
                                  {"clamp(x / x, 0, 1)", kNaN},
                                  {"select(x > 0, 1 / x, 7)", 7},
                                  {"select(x / x < 1, 1, 2)", 2},
                                  {"select(x / x >= 1, 1, 2)", 2},
                                  {"select(!(x / x < 1), 1, 2)", 1},
                                  {"select(x / x == x / x, 1, 2)", 2},
                                  {"select(x / x != x / x, 1, 2)", 2},
                                  {"asin(x + 2)", kNaN},
                                  {"(x - 2)^0.5", kNaN},
                                  {"(x - 2)^3", -8},
                                  {"x^0", 1},
                                  {"x^p", 1},
                                  {"(x - 2)^(x + 17)", -131072},
                                  {"normalize([x, x, x]).x", kNaN},
                                  {"sin(1 / x)", kNaN},
                                  {"exp(1 / x)", kInfinity},
                                  {"exp(-1 / x)", 0},
                                  {"atan(1 / x)", kPi / 2},
                                  {"tanh(1 / x)", 1},
                                  {"atan2(x, x)", 0},
                                  {"atan2(x, -1)", kPi},
                                  {"noise(x / x, 0, 0)", kNaN},
                                  {"floor(x / x)", kNaN},
                                  {"sign(x / x)", kNaN},
                                  {"0 * (1 / x)", kNaN},
                                  {"1 / x - 1 / x", kNaN},
                                  {"1 / (-0 * (x + 1))", -kInfinity}};
    std::vector<FormulaGraph> graphs;
    for (const Case& c : cases) graphs.push_back(FormulaGraph({}, {{{c.text, ""}}}, randomFormulaSymbols()));
    const auto gpu = onGpu(graphs, inputs);
    for (std::size_t f = 0; f < cases.size(); ++f) {
        const double expected = cases[f].expected, value = gpu[f * kPoints];
        double cpu = 0;
        std::array<const double*, kRandomVariables> in{};
        for (std::size_t n = 0; n < in.size(); ++n) in[n] = &inputs.variables[n * kPoints];
        double* out = &cpu;
        graphs[f].evaluate(in, inputs.parameters, {&out, 1}, 1);
        if (expected != expected) {
            EXPECT_TRUE(value != value) << cases[f].text << " gives " << value;
            EXPECT_TRUE(cpu != cpu) << cases[f].text << " gives " << cpu;
        } else {
            EXPECT_FLOAT_EQ(float(value), float(expected)) << cases[f].text;
            EXPECT_FLOAT_EQ(float(cpu), float(expected)) << cases[f].text;
        }
    }
}

}  // namespace
}  // namespace voledit
