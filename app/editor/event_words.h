#pragma once
// The words of an event file's lines: quotes, brackets, numbers (scene-format.md §4).

#include <string>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// Without blanks at both ends.
std::string trimmed(const std::string& text);
/// Without what follows a `#` that stands at the start or after a blank, outside quotes; trimmed.
std::string withoutComment(const std::string& line);
/// Words apart; blanks within quotes or brackets stay.
std::vector<std::string> wordsOf(const std::string& text);
/// The parts of "a,b,c" between the commas outside quotes, trimmed, their quotes taken off.
std::vector<std::string> partsOf(const std::string& inner);
/// Position of the first `sign` outside quotes; npos where there is none.
std::size_t findUnquoted(const std::string& text, char sign);

/// In quotes; a quote, a backslash, a line break and a tab behind a backslash.
std::string quoted(const std::string& text);
/// A text in quotes as its characters; any other as it is.
std::string unquoted(const std::string& text);
/// In quotes only where blanks, quotes or a comment's mark would be read otherwise.
std::string argumentText(const std::string& text);

/// A finite number. Throws Error "what: …".
double numberOf(const std::string& text, const std::string& what);
/// A whole number from `least` to a million. Throws Error.
int wholeNumberOf(const std::string& text, const std::string& what, int least);
/// "3,-4" as two numbers. Throws Error.
Vec2 pairOf(const std::string& text, const std::string& what);

/// The shortest text that reads back as `value`.
std::string numberText(double value);
/// "3,-4".
std::string pairText(const Vec2& pair);

}  // namespace voledit
