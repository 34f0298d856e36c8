#include <algorithm>

#include "core/expression/syntax.h"

namespace voledit {

namespace {

bool startsCharacter(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

int characters(std::string_view text) {
    return static_cast<int>(std::count_if(text.begin(), text.end(), startsCharacter));
}

/// `text` with control characters as spaces and bytes that are no UTF-8 as question marks, a column each.
std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char first = static_cast<unsigned char>(text[i]);
        const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
        std::size_t end = i + 1;
        while (end < text.size() && end < i + length && !startsCharacter(text[end])) ++end;
        if (first < 0x20 || first == 0x7f)
            result += ' ';
        else if (end - i != length || (first >= 0x80 && first < 0xc0) || first >= 0xf8)
            result += startsCharacter(text[i]) ? "?" : "";
        else
            result += text.substr(i, length);
        i = end;
    }
    return result;
}

/// At most `most` characters from the front (or the back) of `text`, with … for what is left out.
std::string abridged(std::string_view text, int most, bool front) {
    if (characters(text) <= most) return printable(text);
    std::size_t cut = front ? 0 : text.size();
    for (int left = most; left > 0;) {
        if (!front) --cut;
        if (startsCharacter(text[cut])) --left;
        if (front) ++cut;
    }
    while (front && cut < text.size() && !startsCharacter(text[cut])) ++cut;
    return front ? printable(text.substr(0, cut)) + "…" : "…" + printable(text.substr(cut));
}

}  // namespace

FormulaError formulaError(const FormulaText& formula, std::size_t offset, const std::string& cause) {
    const std::string_view text = formula.text;
    offset = std::min(offset, text.size());
    const std::size_t newline = offset > 0 ? text.rfind('\n', offset - 1) : std::string_view::npos;
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const std::size_t end = std::min(text.find('\n', offset), text.size());
    const int line =
        formula.line + static_cast<int>(std::count(text.begin(), text.begin() + std::ptrdiff_t(begin), '\n'));
    const std::string_view before = text.substr(begin, offset - begin);
    const int column = characters(before) + (begin == 0 ? formula.column : 1);

    constexpr int kBefore = 50, kAfter = 40;
    const std::string shownBefore = abridged(before, kBefore, false);
    std::string message = formula.where.empty() ? "formula" : formula.where;
    message += ", line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + cause;
    message += "\n    " + shownBefore + abridged(text.substr(offset, end - offset), kAfter, true);
    message += "\n    " + std::string(static_cast<std::size_t>(characters(shownBefore)), ' ') + "^";
    return FormulaError(message, line, column);
}

}  // namespace voledit
