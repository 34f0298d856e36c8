#pragma once
// Names of joints: text in UTF-8, each one once.

#include <map>
#include <string>
#include <string_view>

namespace voledit {

/// Gives out names, each once.
class UniqueNames {
public:
    /// `name` if nobody has it, else the first free of name_2, name_3 …; taken from then on.
    std::string unique(const std::string& name);

private:
    std::map<std::string, int> last_;  // by name taken: the last number that was tried behind it
};

/// True if `text` is well-formed UTF-8 (Unicode 15, table 3-7: no overlong forms, no surrogates).
bool isUtf8(std::string_view text);

/// Latin-1 text as UTF-8.
std::string utf8OfLatin1(std::string_view text);

}  // namespace voledit
