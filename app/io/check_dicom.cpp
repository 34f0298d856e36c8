#include "app/io/check_dicom.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <optional>

#include "core/base/error.h"

namespace voledit {

namespace {

/// Where `wanted` begins, from `from` on.
std::optional<std::uint64_t> find(const InputFile& file, std::uint64_t from, const std::string& wanted) {
    std::string chunk((1 << 20) + wanted.size(), '\0');
    while (from < file.size()) {
        const std::size_t n = file.readAt(from, std::as_writable_bytes(std::span(chunk)));
        const auto end = chunk.begin() + std::ptrdiff_t(n);
        const auto hit = std::search(chunk.begin(), end, std::boyer_moore_searcher(wanted.begin(), wanted.end()));
        if (hit != end) return from + std::uint64_t(hit - chunk.begin());
        if (n < chunk.size()) break;
        from += n - wanted.size() + 1;
    }
    return std::nullopt;
}

std::string bytesOf(std::uint32_t value, bool big) {
    std::string bytes(4, '\0');
    for (std::size_t i = 0; i < 4; ++i) bytes[big ? 3 - i : i] = char(value >> (8 * i));
    return bytes;
}

/// Where the element's value begins: its tag, with or without a value representation, and its length are sought.
std::optional<std::uint64_t> valueStart(const InputFile& file, std::uint32_t length) {
    for (const bool big : {false, true}) {
        const std::string tag = big ? std::string("\x7f\xe0\x00\x10", 4) : std::string("\xe0\x7f\x10\x00", 4);
        for (const std::string& kind : {std::string("OW\0\0", 4), std::string("OB\0\0", 4), std::string()}) {
            const std::string element = tag + kind + bytesOf(length, big);
            if (const auto at = find(file, 128, element)) return *at + element.size();
        }
    }
    return std::nullopt;
}

}  // namespace

void checkPixelData(const Source& source, std::uint32_t length) {
    const InputFile file(source);
    const auto start = valueStart(file, length);
    if (!start) return;  // the whole data set is deflated: breaking off does not go unnoticed there
    const bool pieces = length == 0xffffffff;
    const bool whole = pieces ? find(file, *start, std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8)).has_value()
                              : length <= file.size() - *start;
    if (!whole) throw Error(source.name, "is cut off within its pixels", "copy or export the file anew");
}

}  // namespace voledit
