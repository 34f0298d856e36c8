#pragma once
// Small PNG and TIFF files made for tests.

#include "tests/core/io/files.h"

namespace voledit::test {

/// A grey PNG of `width` columns; T is uint8 or uint16.
template <class T>
std::string pngBytes(int width, const std::vector<T>& values) {
    const auto big = [](std::uint32_t v) { return bytesOf(std::vector<std::uint32_t>{v}, true); };
    const auto chunk = [&](const std::string& type, const std::string& data) {
        const std::string body = type + data;
        const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
        return big(std::uint32_t(data.size())) + body + big(std::uint32_t(crc));
    };
    const std::size_t rowBytes = std::size_t(width) * sizeof(T);
    std::string rows;
    const std::string all = bytesOf(values, true);
    for (std::size_t at = 0; at < all.size(); at += rowBytes) rows += '\0' + all.substr(at, rowBytes);
    std::string packed(compressBound(rows.size()), '\0');
    uLongf length = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(rows.data()),
             rows.size());
    packed.resize(length);
    const std::uint32_t height = std::uint32_t(values.size() / std::size_t(width));
    const std::string header = big(std::uint32_t(width)) + big(height) + std::string{char(8 * sizeof(T)), 0, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed) + chunk("IEND", "");
}

/// An uncompressed grey TIFF of `pages`, each of `width` columns, in either byte order.
template <class T>
std::string tiffBytes(int width, const std::vector<std::vector<T>>& pages, bool big = false) {
    const auto two = [&](std::uint16_t v) { return bytesOf(std::vector<std::uint16_t>{v}, big); };
    const auto four = [&](std::uint32_t v) { return bytesOf(std::vector<std::uint32_t>{v}, big); };
    std::string file = (big ? "MM" : "II") + two(42) + four(8);
    for (std::size_t n = 0; n < pages.size(); ++n) {
        constexpr std::uint16_t entries = 9;
        const std::uint32_t height = std::uint32_t(pages[n].size() / std::size_t(width));
        const std::uint32_t data = std::uint32_t(file.size()) + 2 + 12 * entries + 4;
        const std::uint32_t bytes = std::uint32_t(pages[n].size() * sizeof(T));
        const auto entry = [&](std::uint16_t tag, std::uint32_t value) {
            const bool shortValue = tag != 273 && tag != 279;
            return two(tag) + two(shortValue ? 3 : 4) + four(1) +
                   (shortValue ? two(std::uint16_t(value)) + two(0) : four(value));
        };
        const std::uint32_t format = std::is_floating_point_v<T> ? 3 : std::is_signed_v<T> ? 2 : 1;
        file += two(entries) + entry(256, std::uint32_t(width)) + entry(257, height) + entry(258, 8 * sizeof(T)) +
                entry(259, 1) + entry(262, 1) + entry(273, data) + entry(277, 1) + entry(279, bytes) +
                entry(339, format);
        file += four(n + 1 < pages.size() ? data + bytes : 0) + bytesOf(pages[n], big);
    }
    return file;
}

}  // namespace voledit::test
