#include "core/expression/lowering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>

namespace voledit {

namespace {

/// How many letters must be added, removed, changed or swapped with their neighbour to make b of a; capped at 3.
std::size_t editDistance(std::string_view a, std::string_view b) {
    constexpr std::size_t kFar = 3, kLongest = 64;
    if (a.size() > kLongest || b.size() > kLongest ||
        std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= kFar)
        return kFar;
    std::vector<std::array<std::size_t, 3>> row(b.size() + 1);  // this line, the one before, the one before that
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = {j, 0, 0};
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (auto& cell : row) cell = {0, cell[0], cell[1]};
        row[0][0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t best = std::min({row[j][1] + 1, row[j - 1][0] + 1, row[j - 1][1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                best = std::min(best, row[j - 2][2] + 1);
            row[j][0] = best;
        }
    }
    return std::min(row[b.size()][0], kFar);
}

Op operation(Syntax kind) {
    switch (kind) {
        case Syntax::Or:
            return Op::Or;
        case Syntax::And:
            return Op::And;
        case Syntax::Less:
        case Syntax::Greater:
            return Op::Less;
        case Syntax::LessEqual:
        case Syntax::GreaterEqual:
            return Op::LessEqual;
        case Syntax::Equal:
            return Op::Equal;
        case Syntax::NotEqual:
            return Op::NotEqual;
        case Syntax::Add:
            return Op::Add;
        case Syntax::Subtract:
            return Op::Subtract;
        case Syntax::Multiply:
            return Op::Multiply;
        case Syntax::Divide:
            return Op::Divide;
        default:
            return Op::Power;
    }
}

std::string_view symbol(Syntax kind) {
    constexpr std::array<std::string_view, 8> kSymbols{"||", "&&", "<", "<=", ">", ">=", "==", "!="};
    const int n = static_cast<int>(kind) - static_cast<int>(Syntax::Or);
    return kSymbols[static_cast<std::size_t>(n)];
}

std::string count(int n, const std::string& what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

/// Lowers the tree of one text.
class Lowering::OneFormula {
public:
    OneFormula(Lowering& all, const FormulaText& text)
        : all_(all), graph_(all.graph_), text_(text), tree_(parsedFormula(text)), values_(tree_.nodes.size()) {
        std::size_t next = 0;
        for (const SyntaxLet& let : tree_.lets) {
            lowerUpTo(next, let.node);
            if (known(let.name)) fail(let.offset, "'" + let.name + "' already has a meaning; choose another name");
            local_.emplace(let.name, value(let.node));
        }
        lowerUpTo(next, tree_.root);
    }

    FormulaValue result() const { return value(tree_.root); }
    [[noreturn]] void fail(std::size_t offset, const std::string& cause) const {
        throw formulaError(text_, offset, cause);
    }
    [[noreturn]] void failAtStart(const std::string& cause) const {
        fail(tree_.nodes[static_cast<std::size_t>(tree_.root)].offset, cause);
    }

private:
    const FormulaValue& value(int node) const { return values_[static_cast<std::size_t>(node)]; }
    const SyntaxNode& syntax(int node) const { return tree_.nodes[static_cast<std::size_t>(node)]; }

    void lowerUpTo(std::size_t& next, int last) {
        for (; next <= static_cast<std::size_t>(last); ++next) {
            values_[next] = lower(tree_.nodes[next]);
            if (graph_.nodes().size() > kMostFormulaNodes)
                fail(tree_.nodes[next].offset, "the formulas come to more than " + std::to_string(kMostFormulaNodes) +
                                                   " operations here; make them smaller");
        }
    }

    bool known(const std::string& name) const { return local_.contains(name) || all_.names_.contains(name); }

    FormulaValue lower(const SyntaxNode& node) {
        switch (node.kind) {
            case Syntax::Number:
                return number(graph_.constant(node.number));
            case Syntax::Name:
                return named(node);
            case Syntax::Minus:
                return negated(value(node.operands[0]));
            case Syntax::Not:
                needNumber(node.operands[0], "'!' needs a condition or a number");
                return number(graph_.make(Op::Not, graph_.truth(value(node.operands[0]).node[0])));
            case Syntax::Member:
                return member(node);
            case Syntax::Index:
                needVector(node.operands[0], "[…] takes a component of a vector");
                return number(value(node.operands[0]).component(index(node.operands[1])));
            case Syntax::Call:
                return call(node);
            case Syntax::Vector:
                return vector(node);
            default:
                return binary(node);
        }
    }

    static FormulaValue number(int node) { return {1, {node, -1, -1}}; }

    FormulaValue negated(const FormulaValue& a) {
        FormulaValue result{.width = a.width};
        for (std::size_t c = 0; c < static_cast<std::size_t>(a.width); ++c)
            result.node[c] = graph_.make(Op::Negate, a.node[c]);
        return result;
    }

    FormulaValue named(const SyntaxNode& node) {
        if (const auto found = local_.find(node.name); found != local_.end()) return found->second;
        if (const auto found = all_.names_.find(node.name); found != all_.names_.end()) return found->second;
        if (const FormulaFunction* function = formulaFunction(node.name))
            fail(node.offset, "'" + node.name + "' is a function; write " + std::string(function->form));
        fail(node.offset, "'" + node.name.substr(0, 40) + "' has no meaning here; " + remedy(node.name, false));
    }

    /// "did you mean …", or the names there are.
    std::string remedy(const std::string& name, bool call) const {
        std::vector<std::string> names;
        if (call) {
            for (const FormulaFunction& f : formulaFunctions()) names.emplace_back(f.name);
        } else {
            for (const auto& [known, value] : local_) names.push_back(known);
            for (const auto& [known, value] : all_.names_) names.push_back(known);
        }
        std::sort(names.begin(), names.end());
        std::string all;
        std::tuple<std::size_t, std::size_t, std::string> nearest{3, 0, ""};  // distance, length, name
        for (const std::string& known : names) {
            all += (all.empty() ? "" : ", ") + known;
            const std::size_t distance = editDistance(name, known);
            if (distance < std::max<std::size_t>(known.size(), 2))
                nearest = std::min(nearest, {distance, known.size(), known});
        }
        if (std::get<0>(nearest) < 3) return "did you mean '" + std::get<2>(nearest) + "'?";
        constexpr std::size_t kLongest = 400;
        if (all.size() > kLongest) all = all.substr(0, all.rfind(',', kLongest)) + ", …";
        return (call ? "there are " : "the names here are ") + all;
    }

    void needNumber(int node, const std::string& what) const {
        if (value(node).width != 1)
            fail(syntax(node).offset, what + ", this is a vector; take a component: .x, .y, .z");
    }
    void needVector(int node, const std::string& what) const {
        if (value(node).width != 3) fail(syntax(node).offset, what + ", this is a number; a vector is [a, b, c]");
    }

    FormulaValue member(const SyntaxNode& node) {
        const int vector = node.operands[0];
        if (value(vector).width != 3)
            fail(node.offset,
                 std::string(".") + char('x' + node.component) + " takes a component of a vector, this is a number");
        return number(value(vector).component(node.component));
    }

    /// The constant 0, 1 or 2 that `node` must be.
    int index(int node) const {
        const FormulaValue& k = value(node);
        const bool constant = k.width == 1 && graph_.isConstant(k.node[0]);
        const double n = constant ? graph_.node(k.node[0]).value() : kNaN;
        if (!(n == 0 || n == 1 || n == 2))
            fail(syntax(node).offset, "the number of a component must be a constant: 0, 1 or 2");
        return static_cast<int>(n);
    }

    FormulaValue vector(const SyntaxNode& node) {
        FormulaValue result{.width = 3};
        for (std::size_t c = 0; c < 3; ++c) {
            needNumber(node.operands[c], "a vector's component must be a number");
            result.node[c] = value(node.operands[c]).node[0];
        }
        return result;
    }

    FormulaValue binary(const SyntaxNode& node) {
        const FormulaValue &a = value(node.operands[0]), &b = value(node.operands[1]);
        if (node.kind > Syntax::NotEqual) return componentwise(graph_, operation(node.kind), a, b);
        for (const int operand : node.operands)
            needNumber(operand, "'" + std::string(symbol(node.kind)) + "' needs numbers on both sides");
        int left = a.node[0], right = b.node[0];
        if (node.kind == Syntax::Greater || node.kind == Syntax::GreaterEqual) std::swap(left, right);
        if (node.kind == Syntax::Or || node.kind == Syntax::And) left = graph_.truth(left), right = graph_.truth(right);
        return number(graph_.make(operation(node.kind), left, right));
    }

    FormulaValue call(const SyntaxNode& node) {
        const FormulaFunction* function = formulaFunction(node.name);
        if (!function) {
            if (known(node.name)) fail(node.offset, "'" + node.name + "' is no function; a product is a * b");
            fail(node.offset, "there is no function '" + node.name.substr(0, 40) + "'; " + remedy(node.name, true));
        }
        const int given = static_cast<int>(node.operands.size());
        if (given < function->fewest || given > function->most) {
            std::string wanted = std::to_string(function->fewest);
            if (function->most > function->fewest) wanted += " to " + std::to_string(function->most);
            fail(node.offset,
                 node.name + " takes " +
                     (function->most > function->fewest ? wanted + " arguments" : count(function->fewest, "argument")) +
                     ", here are " + std::to_string(given) + "; write " + std::string(function->form));
        }
        checkTypes(node, *function);
        if (!function->make) return replaced(node);
        std::vector<FormulaValue> arguments;
        for (const int operand : node.operands) arguments.push_back(value(operand));
        return function->make(graph_, arguments);
    }

    void checkTypes(const SyntaxNode& node, const FormulaFunction& function) const {
        const std::string_view types = function.types;
        for (std::size_t i = 0; i < node.operands.size(); ++i) {
            // length and noise: one vector, or numbers.
            const char type =
                types.empty() ? (node.operands.size() == 1 ? 'v' : 'n') : types[std::min(i, types.size() - 1)];
            const std::string what =
                "argument " + std::to_string(i + 1) + " of " + std::string(function.form) + " must be a ";
            if (type == 'n') needNumber(node.operands[i], what + "number");
            if (type == 'v') needVector(node.operands[i], what + "vector");
        }
        if (function.name == "noise" && node.operands.size() == 2)
            fail(node.offset, "noise takes one vector or three numbers; write " + std::string(function.form));
    }

    FormulaValue replaced(const SyntaxNode& node) {
        FormulaValue result = value(node.operands[0]);
        result.node[static_cast<std::size_t>(index(node.operands[1]))] = value(node.operands[2]).node[0];
        return result;
    }

    Lowering& all_;
    GraphBuilder& graph_;
    const FormulaText& text_;
    SyntaxTree tree_;
    std::vector<FormulaValue> values_;
    std::map<std::string, FormulaValue, std::less<>> local_;
};

Lowering::Lowering(const FormulaSymbols& symbols) {
    for (const FormulaSymbol& symbol : symbols.variables) define(symbol, variables_, false);
    for (const FormulaSymbol& symbol : symbols.parameters) define(symbol, parameters_, true);
    for (const auto& [name, numbers] : symbols.constants) {
        assert(numbers.size() == 1 || numbers.size() == 3);
        FormulaValue value{.width = static_cast<int>(numbers.size())};
        for (std::size_t c = 0; c < numbers.size(); ++c) value.node[c] = graph_.constant(numbers[c]);
        names_.emplace(name, value);
    }
    // Symbols of the same name go before these.
    names_.emplace("pi", FormulaValue{1, {graph_.constant(kPi), -1, -1}});
    names_.emplace("e", FormulaValue{1, {graph_.constant(std::numbers::e), -1, -1}});
}

void Lowering::define(const FormulaSymbol& symbol, int& slots, bool parameter) {
    assert(symbol.width == 1 || symbol.width == 3);
    FormulaValue value{.width = symbol.width};
    for (std::size_t c = 0; c < static_cast<std::size_t>(symbol.width); ++c, ++slots)
        value.node[c] = parameter ? graph_.parameter(slots) : graph_.variable(slots);
    const bool isNew = names_.emplace(symbol.name, value).second;
    assert(isNew);
    static_cast<void>(isNew);
}

void Lowering::let(const FormulaLet& let) {
    const OneFormula formula(*this, let.formula);
    if (names_.contains(let.name)) formula.failAtStart("'" + let.name + "' already has a meaning; choose another name");
    names_.emplace(let.name, formula.result());
}

std::vector<int> Lowering::output(const FormulaOutput& output) {
    const OneFormula formula(*this, output.formula);
    const FormulaValue value = formula.result();
    if (output.type == FormulaType::Vector) {
        if (value.width != 3) formula.failAtStart("a vector is wanted, this is a number; a vector is [a, b, c]");
        return {value.node.begin(), value.node.end()};
    }
    if (value.width != 1) {
        const std::string wanted = output.type == FormulaType::Number ? "number" : "condition";
        formula.failAtStart("a " + wanted + " is wanted, this is a vector; take a component: .x, .y, .z");
    }
    return {output.type == FormulaType::Condition ? graph_.truth(value.node[0]) : value.node[0]};
}

}  // namespace voledit
