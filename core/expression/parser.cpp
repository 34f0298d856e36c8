#include <algorithm>
#include <optional>
#include <utility>

#include "core/expression/lexer.h"

namespace voledit {

bool SyntaxNode::operator==(const SyntaxNode& o) const {
    return kind == o.kind && number == o.number && name == o.name && component == o.component && operands == o.operands;
}

namespace {

struct BinaryOperator {
    std::string_view symbol;
    Syntax kind;
    int precedence;
};
constexpr int kComparison = 3, kHighest = 5;
constexpr std::array<BinaryOperator, 12> kBinary{{{"||", Syntax::Or, 1},
                                                  {"&&", Syntax::And, 2},
                                                  {"<", Syntax::Less, 3},
                                                  {"<=", Syntax::LessEqual, 3},
                                                  {">", Syntax::Greater, 3},
                                                  {">=", Syntax::GreaterEqual, 3},
                                                  {"==", Syntax::Equal, 3},
                                                  {"!=", Syntax::NotEqual, 3},
                                                  {"+", Syntax::Add, 4},
                                                  {"-", Syntax::Subtract, 4},
                                                  {"*", Syntax::Multiply, 5},
                                                  {"/", Syntax::Divide, 5}}};

/// By recursive descent; every way that recurses goes through `Deeper`, which bounds it.
class Parser {
public:
    explicit Parser(const FormulaText& text) : text_(text), lexer_(text) { advance(); }

    SyntaxTree run() {
        if (token_.kind == TokenKind::End) fail(0, "the formula is empty");
        while (token_.kind == TokenKind::Name && token_.text == "let") let();
        tree_.root = expression();
        if (token_.kind != TokenKind::End) failAfterExpression();
        return std::move(tree_);
    }

private:
    /// One level of nesting while it lives.
    class Deeper {
    public:
        explicit Deeper(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > kDeepestFormula + 1)  // the formula itself is no nesting
                parser_.fail(parser_.token_.offset, "nested more than " + std::to_string(kDeepestFormula) +
                                                        " levels deep; name parts of it with let");
        }
        ~Deeper() { --parser_.depth_; }
        Deeper(const Deeper&) = delete;
        Deeper& operator=(const Deeper&) = delete;

    private:
        Parser& parser_;
    };

    [[noreturn]] void fail(std::size_t offset, const std::string& cause) const {
        throw formulaError(text_, offset, cause);
    }

    static std::string shown(const Token& token) {
        constexpr std::size_t kLongest = 40;
        if (token.kind == TokenKind::End) return "the end";
        return "'" + std::string(token.text.substr(0, kLongest)) + (token.text.size() > kLongest ? "…'" : "'");
    }

    [[noreturn]] void failAfterExpression() const {
        const std::string found = shown(token_);
        if (token_.is(")")) fail(token_.offset, "')' without a '(' before it");
        if (token_.is("]")) fail(token_.offset, "']' without a '[' before it");
        if (token_.is("=")) fail(token_.offset, "'=' cannot stand here; 'is equal' is ==");
        if (token_.is("(") || token_.is("[") || token_.kind == TokenKind::Name || token_.kind == TokenKind::Number)
            fail(token_.offset, "an operator is missing before " + found + "; a product is a * b");
        fail(token_.offset, "expected an operator or the end, found " + found);
    }

    void advance() { token_ = lexer_.next(); }

    void expect(std::string_view symbol, const Token& opening) {
        if (token_.is(symbol)) return advance();
        if (token_.kind != TokenKind::End && !token_.is(",") && !token_.is(")") && !token_.is("]") && !token_.is(";"))
            failAfterExpression();
        fail(token_.offset, "expected '" + std::string(symbol) + "' for the '" + std::string(opening.text) +
                                "' at column " + std::to_string(formulaError(text_, opening.offset, "").column()) +
                                ", found " + shown(token_));
    }

    int add(SyntaxNode node) {
        tree_.nodes.push_back(std::move(node));
        return static_cast<int>(tree_.nodes.size()) - 1;
    }

    void let() {
        advance();
        SyntaxLet let{.offset = token_.offset};
        if (token_.kind != TokenKind::Name) fail(token_.offset, "expected a name after 'let', found " + shown(token_));
        let.name = token_.text;
        advance();
        if (!token_.is("=")) fail(token_.offset, "expected '=' after 'let " + let.name + "', found " + shown(token_));
        advance();
        let.node = expression();
        if (token_.kind == TokenKind::End)
            fail(token_.offset, "expected ';' and a formula after 'let " + let.name + " = …'");
        if (!token_.is(";")) failAfterExpression();
        advance();
        tree_.lets.push_back(std::move(let));
    }

    int expression() {
        const Deeper deeper(*this);
        return binary(1);
    }

    std::optional<BinaryOperator> operatorHere() const {
        const auto found =
            std::find_if(kBinary.begin(), kBinary.end(), [&](const auto& o) { return token_.is(o.symbol); });
        return found == kBinary.end() ? std::nullopt : std::optional(*found);
    }

    int binary(int precedence) {
        if (precedence > kHighest) return unary();
        int left = binary(precedence + 1);
        bool compared = false;
        for (auto op = operatorHere(); op && op->precedence == precedence; op = operatorHere()) {
            const std::size_t offset = token_.offset;
            if (precedence == kComparison && std::exchange(compared, true))
                fail(offset, "comparisons do not chain; write a < b && b < c");
            advance();
            const int right = binary(precedence + 1);
            left = add({.kind = op->kind, .operands = {left, right}, .offset = offset});
        }
        return left;
    }

    int unary() {
        const std::size_t offset = token_.offset;
        for (const auto& [symbol, kind] : {std::pair{"-", Syntax::Minus}, std::pair{"!", Syntax::Not}}) {
            if (!token_.is(symbol)) continue;
            const Deeper deeper(*this);
            advance();
            const int operand = unary();
            return add({.kind = kind, .operands = {operand}, .offset = offset});
        }
        if (token_.is("+")) {
            const Deeper deeper(*this);
            advance();
            return unary();
        }
        return power();
    }

    int power() {
        const int base = postfix();
        if (!token_.is("^")) return base;
        const Deeper deeper(*this);
        const std::size_t offset = token_.offset;
        advance();
        const int exponent = unary();
        return add({.kind = Syntax::Power, .operands = {base, exponent}, .offset = offset});
    }

    int postfix() {
        int value = primary();
        for (;;) {
            const Token opening = token_;
            if (token_.is(".")) {
                advance();
                const bool known =
                    token_.kind == TokenKind::Name && (token_.text == "x" || token_.text == "y" || token_.text == "z");
                if (!known) fail(token_.offset, "expected x, y or z after '.', found " + shown(token_));
                value = add({.kind = Syntax::Member,
                             .component = token_.text[0] - 'x',
                             .operands = {value},
                             .offset = opening.offset});
                advance();
            } else if (token_.is("[")) {
                advance();
                const int index = expression();
                expect("]", opening);
                value = add({.kind = Syntax::Index, .operands = {value, index}, .offset = opening.offset});
            } else {
                return value;
            }
        }
    }

    int primary() {
        const Token token = token_;
        if (token.kind == TokenKind::Number) {
            advance();
            return add({.kind = Syntax::Number, .number = token.number, .offset = token.offset});
        }
        if (token.kind == TokenKind::Name) return name();
        if (token.is("(")) {
            advance();
            const int inner = expression();
            expect(")", token);
            return inner;
        }
        if (token.is("[")) {
            advance();
            auto operands = list("]", token);
            if (operands.size() != 3) fail(token.offset, "a vector has three components, [a, b, c]");
            return add({.kind = Syntax::Vector, .operands = std::move(operands), .offset = token.offset});
        }
        fail(token.offset, "expected a number, a name or '(', found " + shown(token));
    }

    int name() {
        const Token token = token_;
        if (token.text == "let") fail(token.offset, "'let' stands at a formula's start: let r = …; formula");
        advance();
        if (!token_.is("("))
            return add({.kind = Syntax::Name, .name = std::string(token.text), .offset = token.offset});
        const Token opening = token_;
        advance();
        auto operands = list(")", opening);
        return add({.kind = Syntax::Call,
                    .name = std::string(token.text),
                    .operands = std::move(operands),
                    .offset = token.offset});
    }

    std::vector<int> list(std::string_view closing, const Token& opening) {
        std::vector<int> operands;
        if (!token_.is(closing)) {
            operands.push_back(expression());
            while (token_.is(",")) {
                advance();
                operands.push_back(expression());
            }
        }
        expect(closing, opening);
        return operands;
    }

    const FormulaText& text_;
    Lexer lexer_;
    Token token_;
    SyntaxTree tree_;
    std::size_t depth_ = 0;
};

}  // namespace

SyntaxTree parsedFormula(const FormulaText& text) {
    if (text.text.size() > kLongestFormula)
        throw formulaError(text, 0,
                           "the formula is " + std::to_string(text.text.size()) + " characters long, more than " +
                               std::to_string(kLongestFormula) + "; name parts of it with let");
    return Parser(text).run();
}

}  // namespace voledit
