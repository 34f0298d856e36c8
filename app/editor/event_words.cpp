#include "app/editor/event_words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/base/error.h"

namespace voledit {

namespace {

// Walks over `text` and says of each character whether it stands within quotes.
template <class Visit>
void eachCharacter(const std::string& text, Visit visit) {
    bool quoted = false, escaped = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool mark = text[i] == '"' && !escaped;
        const bool opens =
            mark && !quoted && (i == 0 || std::string_view(" \t(,").find(text[i - 1]) != std::string_view::npos);
        if (!visit(i, quoted || opens)) return;
        escaped = quoted && text[i] == '\\' && !escaped;
        if (mark) quoted = opens;
    }
}

}  // namespace

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string withoutComment(const std::string& line) {
    std::size_t end = line.size();
    eachCharacter(line, [&](std::size_t i, bool quoted) {
        if (quoted || line[i] != '#' || (i > 0 && line[i - 1] != ' ' && line[i - 1] != '\t')) return true;
        end = i;
        return false;
    });
    return trimmed(line.substr(0, end));
}

// Words apart; blanks within quotes or brackets stay.
std::vector<std::string> wordsOf(const std::string& text) {
    std::vector<std::string> words;
    int depth = 0;
    bool within = false;
    eachCharacter(text, [&](std::size_t i, bool quoted) {
        if (!quoted && text[i] == '(') ++depth;
        if (!quoted && text[i] == ')') --depth;
        const bool blank = !quoted && depth <= 0 && (text[i] == ' ' || text[i] == '\t');
        if (!blank && !within) words.emplace_back();
        if (!blank) words.back() += text[i];
        within = !blank;
        return true;
    });
    return words;
}

std::size_t findUnquoted(const std::string& text, char sign) {
    std::size_t found = text.npos;
    eachCharacter(text, [&](std::size_t i, bool quoted) {
        if (quoted || text[i] != sign) return true;
        found = i;
        return false;
    });
    return found;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n')
            result += "\\n";
        else if (c == '\t')
            result += "\\t";
        else
            result += c;
    }
    return result + "\"";
}

// A text in quotes as its characters; any other as it is.
std::string unquoted(const std::string& text) {
    if (text.size() < 2 || text.front() != '"' || text.back() != '"') return text;
    std::string result;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i] != '\\' || i + 2 >= text.size()) {
            result += text[i];
            continue;
        }
        const char next = text[++i];
        result += next == 'n' ? '\n' : next == 't' ? '\t' : next;
    }
    return result;
}

double numberOf(const std::string& text, const std::string& what) {
    const std::string word = trimmed(text);
    const char* const end = word.data() + word.size();
    double value = 0;
    const auto [at, code] = std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, value);
    if (word.empty() || code != std::errc() || at != end || !std::isfinite(value))
        throw Error(what + ": \"" + word + "\" is no number");
    return value;
}

int wholeNumberOf(const std::string& text, const std::string& what, int least) {
    const double value = numberOf(text, what);
    if (value != std::floor(value) || value < least || value > 1e6)
        throw Error(what + ": \"" + trimmed(text) + "\" is no whole number of " + std::to_string(least) + " or more");
    return int(value);
}

// "3,-4" as two numbers.
Vec2 pairOf(const std::string& text, const std::string& what) {
    const auto comma = text.find(',');
    if (comma == text.npos) throw Error(what + ": expected two numbers X,Y, not \"" + text + "\"");
    return {numberOf(text.substr(0, comma), what), numberOf(text.substr(comma + 1), what)};
}

// The parts of "(a,b,c)" between the commas, quotes taken off.
std::vector<std::string> partsOf(const std::string& inner) {
    std::vector<std::string> parts(1);
    eachCharacter(inner, [&](std::size_t i, bool quoted) {
        if (inner[i] == ',' && !quoted)
            parts.emplace_back();
        else
            parts.back() += inner[i];
        return true;
    });
    for (std::string& part : parts) part = unquoted(trimmed(part));
    return parts;
}

std::string numberText(double value) {
    std::array<char, 32> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

std::string pairText(const Vec2& pair) {
    return numberText(pair.x) + "," + numberText(pair.y);
}

// In quotes where blanks, quotes or a comment's mark would be read otherwise.
std::string argumentText(const std::string& text) {
    return text.find_first_of(" \t\n\"#\\") == text.npos ? text : quoted(text);
}

}  // namespace voledit
