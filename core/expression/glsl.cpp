#include <charconv>
#include <cmath>

#include "core/expression/formula_graph.h"
#include "core/expression/noise.h"

namespace voledit {

namespace {

/// Numbers that every point needs but that are the same for all: nodes, in the order of the uniforms.
std::vector<int> hoistedNodes(const FormulaGraph::Nodes& graph) {
    std::vector<std::uint8_t> isUsed(graph.nodes.size(), 0);
    const auto use = [&](int n) { isUsed[static_cast<std::size_t>(n)] = 1; };
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (!graph.uniform[n])
            for (const int in : graph.nodes[n].in)
                if (in >= 0) use(in);
    for (const int o : graph.outputs) use(o);
    std::vector<int> result;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (isUsed[n] && graph.uniform[n] && graph.nodes[n].op != Op::Constant) result.push_back(static_cast<int>(n));
    return result;
}

/// Nine digits bring every float back.
std::string literal(double value) {
    const float number = static_cast<float>(value);
    if (number != number) return "formulaNaN()";
    if (std::isinf(number)) return number > 0 ? "formulaInfinity()" : "-formulaInfinity()";
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::scientific);
    const std::string digits(text.data(), end.ptr);
    return std::signbit(number) ? "(" + digits + ")" : digits;
}

const char* functionName(Op op) {
    switch (op) {
        case Op::Absolute:
            return "abs";
        case Op::Sign:
            return "formulaSign";
        case Op::Floor:
            return "floor";
        case Op::Ceil:
            return "ceil";
        case Op::Fract:
            return "formulaFract";
        case Op::SquareRoot:
            return "formulaSqrt";
        case Op::Hermite:
            return "formulaHermite";
        case Op::Sine:
            return "formulaSin";
        case Op::Cosine:
            return "formulaCos";
        case Op::Tangent:
            return "formulaTan";
        case Op::ArcSine:
            return "formulaAsin";
        case Op::ArcCosine:
            return "formulaAcos";
        case Op::ArcTangent:
            return "formulaAtan";
        case Op::SineH:
            return "formulaSinh";
        case Op::CosineH:
            return "formulaCosh";
        case Op::TangentH:
            return "formulaTanh";
        case Op::Exponential:
            return "formulaExp";
        case Op::Logarithm:
            return "formulaLog";
        case Op::Logarithm2:
            return "formulaLog2";
        case Op::IntegerPower:
            return "formulaIntegerPower";
        case Op::Power:
            return "formulaPow";
        case Op::Modulo:
            return "formulaMod";
        case Op::Minimum:
            return "formulaMin";
        case Op::Maximum:
            return "formulaMax";
        case Op::ArcTangent2:
            return "formulaAtan2";
        default:
            return "formulaNoise";
    }
}

const char* infix(Op op) {
    switch (op) {
        case Op::Add:
            return " + ";
        case Op::Subtract:
            return " - ";
        case Op::Multiply:
            return " * ";
        case Op::Divide:
            return " / ";
        case Op::Less:
            return " < ";
        case Op::LessEqual:
            return " <= ";
        case Op::Equal:
            return " == ";
        case Op::And:
            return " && ";
        case Op::Or:
            return " || ";
        default:
            return nullptr;
    }
}

/// Writes one statement a node. Conditions are `bool`, all else `float`; everything is `precise`, since compilers that
/// rearrange sums or take NaN for impossible would part from the CPU.
class Writer {
public:
    Writer(const FormulaGraph::Nodes& graph, std::string& text)
        : graph_(graph), text_(text), name_(graph.nodes.size()) {
        for (std::size_t n = 0; n < graph.nodes.size(); ++n)
            if (graph.nodes[n].op == Op::Constant) name_[n] = literal(graph.nodes[n].value());
    }

    void hoisted(int node, int uniform) {
        name_[index(node)] = "u" + std::to_string(uniform);
        text_ += "    float " + name_[index(node)] + " = formulaUniform(base + " + std::to_string(uniform) + ");\n";
    }

    void statement(int n) {
        const FormulaNode& node = graph_.nodes[index(n)];
        if (node.op == Op::Variable) {
            name_[index(n)] = "v[" + std::to_string(node.payload) + "]";
            return;
        }
        name_[index(n)] = "n" + std::to_string(n);
        text_ += isCondition(node.op) ? "    precise bool " : "    precise float ";
        text_ += name_[index(n)] + " = " + expression(node) + ";\n";
    }

    /// A node's value as a float.
    std::string number(int n) const { return isBool(n) ? "float(" + name_[index(n)] + ")" : name_[index(n)]; }

private:
    static std::size_t index(int n) { return static_cast<std::size_t>(n); }
    bool isZero(int n) const {
        const FormulaNode& node = graph_.nodes[index(n)];
        return node.op == Op::Constant && node.value() == 0;
    }
    /// Uniform conditions arrive as numbers.
    bool isBool(int n) const { return isCondition(graph_.nodes[index(n)].op) && !graph_.uniform[index(n)]; }
    std::string condition(int n) const { return isBool(n) ? name_[index(n)] : "(" + name_[index(n)] + " != 0.0)"; }

    std::string expression(const FormulaNode& node) const {
        const auto [a, b, c] = node.in;
        switch (node.op) {
            case Op::Negate:
                return "-" + number(a);
            case Op::Not:
                return "!" + condition(a);
            case Op::And:
            case Op::Or:
                return condition(a) + infix(node.op) + condition(b);
            case Op::Select:
                return condition(a) + " ? " + number(b) + " : " + number(c);
            case Op::NotEqual:
                return number(a) + " < " + number(b) + " || " + number(a) + " > " + number(b);
            // Compilers take 0·x and x − x for 0, which infinity and NaN do not give.
            case Op::Multiply:
                for (const auto& [zero, other] : {std::pair{a, b}, std::pair{b, a}})
                    if (isZero(zero)) return "formulaTimesZero(" + number(other) + ", " + number(zero) + ")";
                break;
            case Op::Subtract:
                if (a == b) return "abs(formulaTimesZero(" + number(a) + ", 0.0))";
                break;
            case Op::IntegerPower:
                return "formulaIntegerPower(" + number(a) + ", " + std::to_string(node.payload) + ")";
            case Op::Noise: {
                const auto order = noiseOrder(node.payload);
                std::string orders;
                for (const int o : order) orders += ", " + std::to_string(o);
                return "formulaNoise(vec3(" + number(a) + ", " + number(b) + ", " + number(c) + "), ivec3(" +
                       orders.substr(2) + "))";
            }
            // A value compared with itself asks whether it is NaN, which compilers may not know of.
            case Op::Equal:
            case Op::LessEqual:
                if (a == b) return "!formulaIsNaN(" + number(a) + ")";
                break;
            default:
                break;
        }
        if (const char* between = infix(node.op)) return number(a) + between + number(b);
        return std::string(functionName(node.op)) + "(" + number(a) + (b >= 0 ? ", " + number(b) : "") + ")";
    }

    const FormulaGraph::Nodes& graph_;
    std::string& text_;
    std::vector<std::string> name_;
};

}  // namespace

FormulaGlsl FormulaGraph::glsl(const std::string& name) const {
    const Nodes& graph = *nodes_;
    const auto atLeastOne = [](int n) { return std::to_string(n > 0 ? n : 1); };
    FormulaGlsl result;
    result.text = "void " + name + "(const int base, const float v[" + atLeastOne(graph.variables) + "], out float o[" +
                  atLeastOne(outputCount()) + "]) {\n";
    Writer writer(graph, result.text);
    for (const int node : hoistedNodes(graph)) writer.hoisted(node, result.uniforms++);
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (!graph.uniform[n]) writer.statement(static_cast<int>(n));
    for (std::size_t o = 0; o < graph.outputs.size(); ++o)
        result.text += "    o[" + std::to_string(o) + "] = " + writer.number(graph.outputs[o]) + ";\n";
    if (graph.outputs.empty()) result.text += "    o[0] = 0.0;\n";
    result.text += "}\n";
    return result;
}

std::vector<double> FormulaGraph::glslUniforms(std::span<const double> parameters) const {
    std::vector<double> values(nodes_->nodes.size()), result;
    evaluateUniform(*nodes_, parameters, values);
    for (const int node : hoistedNodes(*nodes_)) result.push_back(values[static_cast<std::size_t>(node)]);
    return result;
}

}  // namespace voledit
