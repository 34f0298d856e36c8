#pragma once
// Lines and words of a formula file, with places for errors. Internal to core/stf.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/expression/formula.h"

namespace voledit {

/// A formula file's text without its comments, cut into statements: a line and the indented lines below it.
class FormulaFileText {
public:
    /// `name` stands in errors.
    FormulaFileText(const std::string& text, std::string name);

    struct Statement {
        std::size_t begin, end;  // offsets in text()
    };
    const std::vector<Statement>& statements() const { return statements_; }
    const std::string& name() const { return name_; }
    /// As given, comments replaced by as many spaces.
    const std::string& text() const { return text_; }

    /// Throws FormulaError with the place's line, column and a caret below it.
    [[noreturn]] void fail(std::size_t offset, const std::string& what) const;
    /// Lines and columns (in characters) are counted from 1.
    int lineOf(std::size_t offset) const;
    int columnOf(std::size_t offset) const;

private:
    std::string original_, text_, name_;
    std::vector<Statement> statements_;
};

/// Reads a statement word by word. Every function throws FormulaError for what it does not find.
class FormulaFileCursor {
public:
    FormulaFileCursor(const FormulaFileText& text, FormulaFileText::Statement statement)
        : text_(text), at_(statement.begin), end_(statement.end) {}

    /// True at the statement's end, white space skipped.
    bool atEnd();
    /// Offset of what comes next.
    std::size_t offset();
    /// The next character, 0 at the end.
    char peek();
    /// The next word (letters, digits, _) without taking it; empty where there is none.
    std::string peekWord();
    std::string word(const std::string& expected);
    /// Takes `c` if it is next.
    bool take(char c);
    void require(char c, const std::string& context);
    /// A number, also `inf` and `-inf`.
    double number(const std::string& expected);
    /// Text between double quotes, white space runs made one space.
    std::string quoted(const std::string& expected);
    /// All that is left, white space runs made one space.
    std::string line(const std::string& expected);
    /// All that is left, as a formula that knows its place.
    FormulaText formula(const std::string& expected);
    /// All that is left, cut at commas outside brackets.
    std::vector<FormulaText> formulas(const std::string& expected);
    /// Throws unless at the end.
    void finish();
    [[noreturn]] void fail(const std::string& what);

private:
    void skipSpace();
    FormulaText formulaBetween(std::size_t begin, std::size_t end) const;

    const FormulaFileText& text_;
    std::size_t at_, end_;
};

}  // namespace voledit
