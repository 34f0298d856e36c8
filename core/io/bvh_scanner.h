#pragma once
// Words and numbers of a BVH file, with the line they stand on.

#include <string>
#include <string_view>

namespace voledit {

/// Goes through a text word by word. Braces are words of their own, also where they touch others.
class BvhScanner {
public:
    /// `text` must outlive it; `file` is for messages.
    BvhScanner(std::string_view text, std::string file);

    /// The next word; empty at the end of the text.
    std::string_view word();
    /// What `word` would give.
    std::string_view peek();
    /// Takes the next word if it is `expected`, in any case of letters.
    bool take(std::string_view expected);
    /// What is left of the line, up to a brace, without blanks around it.
    std::string_view restOfLine();
    /// The next word as a number. Throws Error where it is none, not finite or out of range; `what` says whose it is.
    double number(std::string_view what);

    /// True if only blanks are left.
    bool atEnd();
    /// True if only blanks are left of this line.
    bool atLineEnd();
    /// Of the next character, from 1.
    int line() const { return line_; }
    /// Bytes left.
    std::size_t left() const { return text_.size() - at_; }
    const std::string& file() const { return file_; }

    /// Throws Error for the line that the last word stands on.
    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

private:
    void skipBlanks();
    void step();

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    int line_ = 1, wordLine_ = 1;
};

/// A stranger's text for messages: in quotation marks, at most 40 characters, all but plain ASCII replaced.
std::string quotedText(std::string_view text);

/// True if both are equal but for the case of ASCII letters.
bool equalInAnyCase(std::string_view a, std::string_view b);

}  // namespace voledit
