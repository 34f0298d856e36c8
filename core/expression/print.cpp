#include <charconv>

#include "core/expression/syntax.h"

namespace voledit {

namespace {

// How tightly a node's text holds together; the parser's levels.
constexpr int kOr = 1, kAnd = 2, kComparison = 3, kSum = 4, kProduct = 5, kSign = 6, kPower = 7, kPostfix = 8;

int precedence(Syntax kind) {
    switch (kind) {
        case Syntax::Or:
            return kOr;
        case Syntax::And:
            return kAnd;
        case Syntax::Less:
        case Syntax::LessEqual:
        case Syntax::Greater:
        case Syntax::GreaterEqual:
        case Syntax::Equal:
        case Syntax::NotEqual:
            return kComparison;
        case Syntax::Add:
        case Syntax::Subtract:
            return kSum;
        case Syntax::Multiply:
        case Syntax::Divide:
            return kProduct;
        case Syntax::Minus:
        case Syntax::Not:
            return kSign;
        case Syntax::Power:
            return kPower;
        default:
            return kPostfix;
    }
}

std::string_view symbol(Syntax kind) {
    switch (kind) {
        case Syntax::Or:
            return " || ";
        case Syntax::And:
            return " && ";
        case Syntax::Less:
            return " < ";
        case Syntax::LessEqual:
            return " <= ";
        case Syntax::Greater:
            return " > ";
        case Syntax::GreaterEqual:
            return " >= ";
        case Syntax::Equal:
            return " == ";
        case Syntax::NotEqual:
            return " != ";
        case Syntax::Add:
            return " + ";
        case Syntax::Subtract:
            return " - ";
        case Syntax::Multiply:
            return " * ";
        case Syntax::Divide:
            return " / ";
        default:
            return "^";
    }
}

std::string number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

/// Texts of a tree's nodes, each made from its operands' and then taken by the node above.
class Printer {
public:
    explicit Printer(const SyntaxTree& tree) : tree_(tree), text_(tree.nodes.size()) {
        for (std::size_t n = 0; n < tree.nodes.size(); ++n) text_[n] = print(tree.nodes[n]);
    }
    std::string& text(int node) { return text_[static_cast<std::size_t>(node)]; }

private:
    /// An operand's text, in brackets where it holds less tightly than `least`.
    std::string operand(int node, int least) {
        std::string inner = std::move(text(node));
        if (precedence(tree_.nodes[static_cast<std::size_t>(node)].kind) >= least) return inner;
        return "(" + std::move(inner) + ")";
    }

    std::string joined(std::string result, const std::vector<int>& operands, char closing) {
        for (std::size_t i = 0; i < operands.size(); ++i) result.append(i ? ", " : "").append(text(operands[i]));
        return result + closing;
    }

    std::string print(const SyntaxNode& node) {
        const int level = precedence(node.kind);
        switch (node.kind) {
            case Syntax::Number:
                return number(node.number);
            case Syntax::Name:
                return node.name;
            case Syntax::Call:
                return joined(node.name + "(", node.operands, ')');
            case Syntax::Vector:
                return joined("[", node.operands, ']');
            case Syntax::Minus:
                return "-" + operand(node.operands[0], level);
            case Syntax::Not:
                return "!" + operand(node.operands[0], level);
            case Syntax::Member:
                return operand(node.operands[0], level) + "." + static_cast<char>('x' + node.component);
            case Syntax::Index: {
                std::string vector = operand(node.operands[0], level);
                return std::move(vector) + "[" + text(node.operands[1]) + "]";
            }
            default:
                return binary(node, level);
        }
    }

    // Appends to the left operand's text: a long sum is printed in one pass.
    std::string binary(const SyntaxNode& node, int level) {
        const bool power = node.kind == Syntax::Power;
        const bool comparison = level == kComparison;
        std::string result = operand(node.operands[0], power ? kPostfix : comparison ? level + 1 : level);
        result += symbol(node.kind);
        result += operand(node.operands[1], power ? kSign : level + 1);
        return result;
    }

    const SyntaxTree& tree_;
    std::vector<std::string> text_;
};

}  // namespace

std::string printed(const SyntaxTree& tree) {
    Printer printer(tree);
    std::string result;
    for (const SyntaxLet& let : tree.lets) result += "let " + let.name + " = " + printer.text(let.node) + "; ";
    return result + printer.text(tree.root);
}

std::string printedFormula(const FormulaText& text) {
    return printed(parsedFormula(text));
}

}  // namespace voledit
