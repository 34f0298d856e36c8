#include "core/stf/formula_file_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace voledit {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool isWordCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// `text` with comments (from # outside quotes to the line's end) made spaces; as long as before.
std::string withoutComments(std::string text) {
    bool quoted = false, comment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char& c = text[i];
        if (c == '\n') {
            comment = false;
            quoted = quoted && i + 1 < text.size() && isSpace(text[i + 1]);  // a new statement ends what was left open
        } else if (comment || (c == '#' && !quoted))
            comment = true;
        else if (c == '"')
            quoted = !quoted;
        if (comment || c == '\r') c = ' ';
    }
    return text;
}

std::string withSingleSpaces(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (!isSpace(c))
            result += c;
        else if (!result.empty() && result.back() != ' ')
            result += ' ';
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

std::size_t characters(std::string_view utf8) {
    return std::size_t(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

FormulaFileText::FormulaFileText(const std::string& text, std::string name)
    : original_(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text),
      text_(withoutComments(original_)),
      name_(std::move(name)) {
    std::size_t begin = 0;
    while (begin < text_.size()) {
        const std::size_t end = std::min(text_.find('\n', begin), text_.size());
        const std::string_view line(text_.data() + begin, end - begin);
        const bool blank = std::all_of(line.begin(), line.end(), isSpace);
        if (!blank && isSpace(line[0]) && statements_.empty())
            fail(begin + line.find_first_not_of(" \t"), "an indented line continues the one above; there is none");
        if (!blank && isSpace(line[0]))
            statements_.back().end = end;
        else if (!blank)
            statements_.push_back({begin, end});
        begin = end + 1;
    }
}

int FormulaFileText::lineOf(std::size_t offset) const {
    return 1 + int(std::count(original_.begin(), original_.begin() + std::ptrdiff_t(offset), '\n'));
}

int FormulaFileText::columnOf(std::size_t offset) const {
    const std::size_t newline = offset == 0 ? std::string::npos : original_.rfind('\n', offset - 1);
    const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
    return 1 + int(characters(std::string_view(original_).substr(begin, offset - begin)));
}

void FormulaFileText::fail(std::size_t offset, const std::string& what) const {
    const int line = lineOf(offset), column = columnOf(offset);
    const std::size_t newline = offset == 0 ? std::string::npos : original_.rfind('\n', offset - 1);
    const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
    std::string shown = original_.substr(begin, std::min(original_.find('\n', begin), original_.size()) - begin);
    // A line that nobody can read is cut about the place.
    std::size_t before = offset - begin;
    if (constexpr std::size_t kShown = 60; before > kShown) {
        std::size_t cut = before - kShown;
        while (cut < before && (shown[cut] & 0xC0) == 0x80) ++cut;
        shown.erase(0, cut);
        before -= cut;
    }
    if (shown.size() > 120) shown.resize(120);
    for (char& c : shown)
        if (c == '\t' || c == '\r') c = ' ';
    throw FormulaError(name_ + ", line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what +
                           "\n  " + shown + "\n  " +
                           std::string(characters(std::string_view(shown).substr(0, before)), ' ') + "^",
                       line, column);
}

void FormulaFileCursor::skipSpace() {
    while (at_ < end_ && isSpace(text_.text()[at_])) ++at_;
}

bool FormulaFileCursor::atEnd() {
    skipSpace();
    return at_ == end_;
}

std::size_t FormulaFileCursor::offset() {
    skipSpace();
    return at_;
}

char FormulaFileCursor::peek() {
    return atEnd() ? '\0' : text_.text()[at_];
}

std::string FormulaFileCursor::peekWord() {
    skipSpace();
    std::size_t to = at_;
    while (to < end_ && isWordCharacter(text_.text()[to])) ++to;
    return text_.text().substr(at_, to - at_);
}

std::string FormulaFileCursor::word(const std::string& expected) {
    const std::string found = peekWord();
    if (found.empty()) fail("expected " + expected);
    at_ += found.size();
    return found;
}

bool FormulaFileCursor::take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
}

void FormulaFileCursor::require(char c, const std::string& context) {
    if (!take(c)) fail(std::string("expected \"") + c + "\" " + context);
}

double FormulaFileCursor::number(const std::string& expected) {
    skipSpace();
    const char* const begin = text_.text().data() + at_;
    const char* const end = text_.text().data() + end_;
    double value = 0;
    const auto [stop, problem] = std::from_chars(begin + (begin < end && *begin == '+'), end, value);
    if (problem != std::errc() || std::isnan(value)) fail("expected " + expected);
    at_ += std::size_t(stop - begin);
    return value;
}

std::string FormulaFileCursor::quoted(const std::string& expected) {
    if (peek() != '"') fail("expected " + expected + " between double quotes");
    const std::size_t close = text_.text().find('"', at_ + 1);
    if (close == std::string::npos || close >= end_) fail("this quote does not end");
    const std::string result = withSingleSpaces(std::string_view(text_.text()).substr(at_ + 1, close - at_ - 1));
    at_ = close + 1;
    return result;
}

std::string FormulaFileCursor::line(const std::string& expected) {
    if (atEnd()) fail("expected " + expected);
    const std::string result = withSingleSpaces(std::string_view(text_.text()).substr(at_, end_ - at_));
    at_ = end_;
    return result;
}

FormulaText FormulaFileCursor::formulaBetween(std::size_t begin, std::size_t end) const {
    const std::string& text = text_.text();
    while (begin < end && isSpace(text[begin])) ++begin;
    while (end > begin && isSpace(text[end - 1])) --end;
    return {text.substr(begin, end - begin), text_.name(), text_.lineOf(begin), text_.columnOf(begin)};
}

FormulaText FormulaFileCursor::formula(const std::string& expected) {
    if (atEnd()) fail("expected " + expected);
    const FormulaText result = formulaBetween(at_, end_);
    at_ = end_;
    return result;
}

std::vector<FormulaText> FormulaFileCursor::formulas(const std::string& expected) {
    std::vector<FormulaText> result;
    do {
        if (atEnd()) fail("expected " + expected);
        const std::size_t begin = at_;
        for (int depth = 0; at_ < end_ && (depth > 0 || text_.text()[at_] != ','); ++at_) {
            const char c = text_.text()[at_];
            depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
        }
        result.push_back(formulaBetween(begin, at_));
        if (result.back().text.empty()) fail("expected " + expected);
    } while (take(','));
    return result;
}

void FormulaFileCursor::finish() {
    if (!atEnd()) fail("the line should have ended here");
}

void FormulaFileCursor::fail(const std::string& what) {
    text_.fail(offset(), what);
}

}  // namespace voledit
