#include "app/editor/request_words.h"

#include <cstdlib>
#include <regex>

#include "core/base/error.h"

namespace voledit {

std::string takeLastWord(std::string& text, const char* pattern) {
    const std::regex last(std::string("^(.*\\S)\\s+(") + pattern + ")$");
    std::smatch found;
    if (!std::regex_match(text, found, last)) return {};
    const std::string word = found[2];
    text = std::string(found[1]);
    return word;
}

Index2 takeLastSize(std::string& text, Index2 otherwise, const std::string& action) {
    const std::string word = takeLastWord(text, "[0-9]{1,5}x[0-9]{1,5}");
    if (word.empty()) return otherwise;
    const Index2 size(std::atoi(word.c_str()), std::atoi(word.c_str() + word.find('x') + 1));
    if (size.x < 1 || size.y < 1 || size.x > 16384 || size.y > 16384)
        throw Error(action + ": a size has two numbers from 1 to 16384 joined by x");
    return size;
}

}  // namespace voledit
