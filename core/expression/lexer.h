#pragma once
// Formulas as tokens. Internal to core/expression.

#include <optional>
#include <string_view>

#include "core/expression/syntax.h"

namespace voledit {

enum class TokenKind : std::uint8_t { Number, Name, Symbol, End };

struct Token {
    TokenKind kind = TokenKind::End;
    std::string_view text{};  // symbols: "+", "<=", … ("−" as "-"); empty at the end
    double number = 0;
    std::size_t offset = 0;  // bytes into the formula

    bool is(std::string_view symbol) const { return kind == TokenKind::Symbol && text == symbol; }
};

/// Reads tokens one after the other. Throws FormulaError at what is none.
class Lexer {
public:
    /// `formula` must outlive it.
    explicit Lexer(const FormulaText& formula) : formula_(formula) {}
    Token next();

private:
    Token number();
    std::size_t digits(std::size_t from) const;  // where the digits from there on end

    const FormulaText& formula_;
    std::size_t at_ = 0;
};

}  // namespace voledit
