#include "app/io/header_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "app/io/checks.h"
#include "core/base/error.h"

namespace voledit {

namespace {
constexpr std::size_t kLongestHeader = 1 << 20;
constexpr std::size_t kMostFiles = 65536;
}  // namespace

HeaderLines::HeaderLines(const Source& source) : name_(source.name), text_(InputFile(source).start(kLongestHeader)) {}

std::optional<std::string> HeaderLines::next() {
    if (at_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (end == kLongestHeader) throw Error(name_, "has no end of its header within 1 MiB", "give a whole header");
    std::string line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = std::min(end + 1, text_.size());
    ++number_;
    return line;
}

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::vector<std::string> wordsOf(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

namespace {
template <class T>
T numberOf(const std::string& word, const std::string& where, const char* kind) {
    T value{};
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* end = word.data() + word.size();
    const auto [stop, failed] = std::from_chars(begin, end, value);
    if (failed != std::errc() || stop != end)
        throw Error(where, inQuotes(word) + " is no " + kind, "correct the header");
    return value;
}
}  // namespace

double realOf(const std::string& word, const std::string& where) {
    return numberOf<double>(word, where, "number that fits");
}

std::uint64_t countOf(const std::string& word, const std::string& where) {
    return numberOf<std::uint64_t>(word, where, "whole number that fits");
}

std::vector<double> realsOf(const std::string& text, const std::string& where) {
    std::vector<double> values;
    for (const auto& word : wordsOf(text)) values.push_back(realOf(word, where));
    return values;
}

std::vector<std::uint64_t> countsOf(const std::string& text, const std::string& where) {
    std::vector<std::uint64_t> values;
    for (const auto& word : wordsOf(text)) values.push_back(countOf(word, where));
    return values;
}

namespace {

/// The text of `pattern` with its one %d, %03d … replaced; nullopt where it has none, or more than that.
std::optional<std::string> numbered(const std::string& pattern, std::int64_t number) {
    const auto start = pattern.find('%');
    if (start == std::string::npos || pattern.find('%', start + 1) != std::string::npos) return std::nullopt;
    const auto end = pattern.find_first_not_of("0123456789", start + 1);
    if (end == std::string::npos || (pattern[end] != 'd' && pattern[end] != 'i') || end - start > 4)
        return std::nullopt;
    std::size_t width = 0;
    std::from_chars(pattern.data() + start + 1, pattern.data() + end, width);
    std::string digits = std::to_string(number);
    const char fill = pattern[start + 1] == '0' ? '0' : ' ';
    if (digits.size() < width) digits.insert(0, width - digits.size(), fill);
    return pattern.substr(0, start) + digits + pattern.substr(end + 1);
}

std::vector<Source> patternFiles(const Source& header, const std::vector<std::string>& words, int line) {
    const std::string place = placeOf(header, line);
    const std::int64_t first = numberOf<std::int64_t>(words[1], place, "whole number");
    const std::int64_t last = numberOf<std::int64_t>(words[2], place, "whole number");
    const std::int64_t step = words.size() > 3 ? numberOf<std::int64_t>(words[3], place, "whole number") : 1;
    const bool reached = step > 0 ? first <= last : step < 0 && first >= last;
    if (!reached || std::max(std::abs(double(first)), std::abs(double(last))) > 1e9 ||
        std::abs(double(last) - double(first)) / std::abs(double(step)) >= double(kMostFiles))
        throw Error(place, "its data file pattern counts no sensible number of files",
                    "give first, last and step numbers of at most 65536 files");
    std::vector<Source> files;
    for (std::int64_t n = first; step > 0 ? n <= last : n >= last; n += step)
        files.push_back(dataFileOf(header, numbered(words[0], n).value(), line));
    return files;
}

}  // namespace

std::vector<Source> dataFilesOf(const Source& header, const std::string& rest, HeaderLines& lines) {
    const auto words = wordsOf(rest);
    const int line = lines.number();
    if (!words.empty() && words[0] == "LIST") {
        std::vector<Source> files;
        while (const auto name = lines.next()) {
            if (trimmed(*name).empty()) continue;
            if (files.size() == kMostFiles)
                throw Error(placeOf(header, lines.number()), "lists more than 65536 data files", "correct the header");
            files.push_back(dataFileOf(header, trimmed(*name), lines.number()));
        }
        if (files.empty()) throw Error(placeOf(header, line), "lists no data files", "name them on the lines below");
        return files;
    }
    if (words.size() >= 3 && numbered(words[0], 0)) return patternFiles(header, words, line);
    return {dataFileOf(header, rest, line)};
}

}  // namespace voledit
