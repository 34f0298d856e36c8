#pragma once
// Headers that are lines of text.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/input_file.h"

namespace voledit {

/// A header's lines one by one, up to 1 MiB of them.
class HeaderLines {
public:
    /// Throws Error where the file cannot be read.
    explicit HeaderLines(const Source& source);

    /// The next line without its end (LF or CR LF); nullopt at the end of the file. Throws Error past the 1 MiB.
    std::optional<std::string> next();
    /// Number of the line that `next` gave last, from 1.
    int number() const { return number_; }
    /// Byte at which the next line, or the data behind the header, begins.
    std::uint64_t offset() const { return at_; }

private:
    std::string name_, text_;
    std::size_t at_ = 0;
    int number_ = 0;
};

std::string trimmed(std::string_view text);
std::string lowered(std::string_view text);
/// Words between white space.
std::vector<std::string> wordsOf(const std::string& text);

/// The whole of `word` as a number. Throws Error that names `where`.
double realOf(const std::string& word, const std::string& where);
std::uint64_t countOf(const std::string& word, const std::string& where);

/// As `realOf`, `countOf`, for every word of `text`.
std::vector<double> realsOf(const std::string& text, const std::string& where);
std::vector<std::uint64_t> countsOf(const std::string& text, const std::string& where);

/// The files that a header names as data: `rest` lists them ("LIST", names on the lines that follow), or is a pattern
/// with a first, last and step number ("slice%03d.raw 1 10 1"), or one name. Throws Error as dataFileOf does.
std::vector<Source> dataFilesOf(const Source& header, const std::string& rest, HeaderLines& lines);

}  // namespace voledit
