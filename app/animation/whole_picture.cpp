#include "app/animation/whole_picture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

namespace voledit {

namespace {

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// A little-endian number of T's size at `at`; nullopt beyond the end.
template <class T>
std::optional<T> littleEndian(const std::string& bytes, std::size_t at) {
    T value{};
    if (at > bytes.size() || bytes.size() - at < sizeof value) return std::nullopt;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

bool isWholePng(const std::string& bytes, Index2 size) {
    if (bytes.size() < 45 || bytes.compare(0, 8, "\x89PNG\r\n\x1a\n", 8) != 0) return false;
    if (bigEndian(bytes, 16) != std::uint32_t(size.x) || bigEndian(bytes, 20) != std::uint32_t(size.y)) return false;
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t next = at + 12 + bigEndian(bytes, at);
        if (next > bytes.size()) return false;
        if (bytes.compare(at + 4, 4, "IEND") == 0) return next == bytes.size();
        at = next;
    }
    return false;
}

struct ExrHeader {
    std::size_t end = 0;  // where the table of offsets starts
    Index2 size{0};
    int linesAChunk = 0;
};

/// OpenEXR file layout: attributes of name, type, length and value, up to an empty name.
std::optional<ExrHeader> exrHeader(const std::string& bytes) {
    ExrHeader header;
    std::size_t at = 8;
    while (at < bytes.size() && bytes[at] != '\0') {
        const std::string name(bytes.c_str() + at);
        const auto typeEnd = bytes.find('\0', at + name.size() + 1);
        const auto length = littleEndian<std::uint32_t>(bytes, typeEnd == std::string::npos ? typeEnd : typeEnd + 1);
        if (!length) return std::nullopt;
        at = typeEnd + 5;
        if (name == "dataWindow") {
            std::int64_t corner[4];
            for (std::size_t i = 0; i < 4; ++i) {
                const auto value = littleEndian<std::int32_t>(bytes, at + 4 * i);
                if (!value) return std::nullopt;
                corner[i] = *value;
            }
            header.size = {int(corner[2] - corner[0] + 1), int(corner[3] - corner[1] + 1)};
        } else if (name == "compression" && at < bytes.size()) {
            // none, RLE, ZIPS: a line each; ZIP 16; PIZ 32; PXR24 16; B44, B44A, DWAA 32; DWAB 256.
            constexpr int kLines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
            const auto method = static_cast<unsigned char>(bytes[at]);
            if (method < std::size(kLines)) header.linesAChunk = kLines[method];
        }
        at += *length;
    }
    header.end = at + 1;
    if (at >= bytes.size() || header.linesAChunk == 0) return std::nullopt;
    return header;
}

bool isWholeExr(const std::string& bytes, Index2 size) {
    if (bytes.size() < 16 || bytes.compare(0, 4, "\x76\x2f\x31\x01", 4) != 0) return false;
    const auto header = exrHeader(bytes);
    if (!header || header->size != size) return false;
    const int chunks = (size.y + header->linesAChunk - 1) / header->linesAChunk;
    // The table is zeroes until the file is closed; each chunk is its first line, its length and that many bytes.
    std::uint64_t farthest = 0;
    for (int i = 0; i < chunks; ++i) {
        const auto offset = littleEndian<std::uint64_t>(bytes, header->end + 8 * std::size_t(i));
        if (!offset || *offset == 0 || *offset > bytes.size()) return false;
        const auto length = littleEndian<std::uint32_t>(bytes, std::size_t(*offset) + 4);
        if (!length) return false;
        farthest = std::max(farthest, *offset + 8 + *length);
    }
    return farthest == bytes.size();
}

}  // namespace

bool isWholePicture(const std::filesystem::path& file, Index2 size) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    return isWholePng(bytes, size) || isWholeExr(bytes, size);
}

}  // namespace voledit
