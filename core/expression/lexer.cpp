#include "core/expression/lexer.h"

#include <array>
#include <charconv>

namespace voledit {

namespace {

// The C library's tests depend on the locale.
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

constexpr std::array<std::string_view, 6> kTwoCharacters{"<=", ">=", "==", "!=", "&&", "||"};
constexpr std::string_view kOneCharacter = "+-*/^<>!()[],.;=";
constexpr std::string_view kMinusSign = "\xe2\x88\x92";  // U+2212

/// The character at `offset` as a message shows it.
std::string shown(const std::string& text, std::size_t offset) {
    const unsigned char first = static_cast<unsigned char>(text[offset]);
    if (first < 0x20 || first == 0x7f) return "a control character";
    std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
    length = std::min(length, text.size() - offset);
    for (std::size_t i = 1; i < length; ++i)
        if ((static_cast<unsigned char>(text[offset + i]) & 0xc0) != 0x80) return "a byte that is no UTF-8";
    if (length == 1 && first >= 0x80) return "a byte that is no UTF-8";
    return "'" + text.substr(offset, length) + "'";
}

std::string strayCharacter(const std::string& text, std::size_t offset) {
    if (text[offset] == '&') return "'&' alone means nothing; 'and' is &&";
    if (text[offset] == '|') return "'|' alone means nothing; 'or' is ||, the absolute value abs(…)";
    if (text[offset] == '%') return "'%' means nothing; the remainder is mod(a, b)";
    return shown(text, offset) + " cannot stand in a formula";
}

}  // namespace

std::size_t Lexer::digits(std::size_t from) const {
    while (from < formula_.text.size() && isDigit(formula_.text[from])) ++from;
    return from;
}

Token Lexer::number() {
    const std::string& text = formula_.text;
    const std::size_t begin = at_;
    std::size_t end = digits(begin);
    if (end < text.size() && text[end] == '.') end = digits(end + 1);
    if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
        const bool hasSign = end + 1 < text.size() && (text[end + 1] == '+' || text[end + 1] == '-');
        const std::size_t exponent = end + (hasSign ? 2 : 1);
        // "2e" and "2exp(x)" are a number followed by a name.
        if (digits(exponent) > exponent) end = digits(exponent);
    }
    Token token{.kind = TokenKind::Number, .text = std::string_view(text).substr(begin, end - begin), .offset = begin};
    const auto result = std::from_chars(text.data() + begin, text.data() + end, token.number);
    if (result.ec == std::errc::result_out_of_range) {
        // Too large, or so small that it is 0: a mantissa of digits tells which only together with its exponent.
        long double wide = 0;
        const auto again = std::from_chars(text.data() + begin, text.data() + end, wide);
        const bool tiny = again.ec == std::errc() ? wide < 1 : token.text.find('-') != std::string_view::npos;
        if (!tiny) throw formulaError(formula_, begin, "the number is too large; the largest is about 1.8e308");
        token.number = 0;
    }
    at_ = end;
    return token;
}

Token Lexer::next() {
    const std::string& text = formula_.text;
    while (at_ < text.size() && (text[at_] == ' ' || text[at_] == '\t' || text[at_] == '\n' || text[at_] == '\r'))
        ++at_;
    if (at_ >= text.size()) return {.kind = TokenKind::End, .offset = text.size()};
    const std::string_view rest = std::string_view(text).substr(at_);
    if (isDigit(rest[0]) || (rest[0] == '.' && rest.size() > 1 && isDigit(rest[1]))) return number();
    Token token{.kind = TokenKind::Symbol, .offset = at_};
    if (isLetter(rest[0])) {
        std::size_t length = 1;
        while (length < rest.size() && (isLetter(rest[length]) || isDigit(rest[length]))) ++length;
        token.kind = TokenKind::Name;
        token.text = rest.substr(0, length);
        at_ += length;
        return token;
    }
    if (rest.starts_with(kMinusSign)) {
        token.text = "-";
        at_ += kMinusSign.size();
        return token;
    }
    for (const std::string_view symbol : kTwoCharacters)
        if (rest.starts_with(symbol)) token.text = symbol;
    if (token.text.empty() && kOneCharacter.find(rest[0]) != std::string_view::npos) token.text = rest.substr(0, 1);
    if (token.text.empty()) throw formulaError(formula_, at_, strayCharacter(text, at_));
    at_ += token.text.size();
    return token;
}

}  // namespace voledit
