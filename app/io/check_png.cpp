#include "app/io/check_png.h"

#include <array>
#include <cstring>

#include "app/io/checks.h"
#include "core/base/error.h"

namespace voledit {

namespace {

std::uint32_t bigEndian32(const std::byte* bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

/// Bytes that the pixels take, from the IHDR chunk's data (PNG specification, 11.2.2).
std::uint64_t pixelBytes(const std::string& name, std::span<const std::byte> header) {
    const std::uint64_t width = bigEndian32(header.data()), height = bigEndian32(header.data() + 4);
    const unsigned depth = std::to_integer<unsigned>(header[8]), colour = std::to_integer<unsigned>(header[9]);
    constexpr std::array<unsigned, 7> samples{1, 0, 3, 1, 2, 0, 4};
    if (colour >= samples.size() || samples[colour] == 0 || depth > 16)
        throw Error(name, "has an impossible colour type", "the file is damaged: save it anew");
    checkSizes(name, {width, height, 1}, samples[colour]);
    return (width * samples[colour] * depth + 7) / 8 * height;
}

}  // namespace

void checkPng(const Source& source) {
    const InputFile file(source);
    const auto damaged = [&](const char* what) {
        throw Error(source.name, what, "the file is damaged or cut off: save or copy it anew");
    };
    if (file.start(8) != "\x89PNG\r\n\x1a\n") throw Error(source.name, "is no PNG file", "take it out of the stack");
    std::uint64_t at = 8, needed = 0, compressed = 0;
    for (bool first = true;; first = false) {
        std::array<std::byte, 8 + 13> chunk{};
        const std::size_t n = file.readAt(at, chunk);
        if (n < 8) damaged("ends before its end mark");
        const std::uint64_t length = bigEndian32(chunk.data());
        const auto is = [&](const char* type) { return std::memcmp(chunk.data() + 4, type, 4) == 0; };
        if (at + 12 + length > file.size()) damaged("ends within a chunk");
        if (first && (!is("IHDR") || length != 13)) damaged("does not begin with its header");
        if (first) needed = pixelBytes(source.name, std::span(chunk).subspan(8));
        if (is("IDAT")) compressed += length;
        at += 12 + length;
        if (is("IEND")) break;
    }
    if (needed / kDeflateRatio > compressed) damaged("claims more pixels than its data can hold");
}

}  // namespace voledit
