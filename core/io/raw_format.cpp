#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/io/io_client.h"

namespace voledit {

namespace {

const char* const kExpected = "expected SIZE,TYPE[,SPACING][,big|little], for example 256x256x128,uint8,1x1x1.5,big";

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

template <class T>
T number(const std::string& text, const std::string& whole) {
    T value{};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size() || text.empty())
        throw Error("raw format \"" + whole + "\"", "\"" + text + "\" is not a number that fits", kExpected);
    return value;
}

Vec3 spacingOf(const std::string& text, const std::string& whole) {
    const auto parts = split(text, 'x');
    Vec3 spacing(number<double>(parts[0], whole));
    if (parts.size() == 3)
        for (int a = 1; a < 3; ++a) spacing[a] = number<double>(parts[std::size_t(a)], whole);
    const bool good = std::isfinite(spacing.x + spacing.y + spacing.z) && (parts.size() == 1 || parts.size() == 3) &&
                      spacing.x > 0 && spacing.y > 0 && spacing.z > 0;
    if (!good) throw Error("raw format \"" + whole + "\"", "a spacing is one or three positive numbers", kExpected);
    return spacing;
}

}  // namespace

RawFormat parseRawFormat(const std::string& text) {
    const auto parts = split(text, ',');
    if (parts.size() < 2 || parts.size() > 4)
        throw Error("raw format \"" + text + "\"", "has " + std::to_string(parts.size()) + " parts", kExpected);
    RawFormat format;
    const auto size = split(parts[0], 'x');
    if (size.size() != 3) throw Error("raw format \"" + text + "\"", "a size is three whole numbers", kExpected);
    for (int a = 0; a < 3; ++a) {
        format.size[a] = number<int>(size[std::size_t(a)], text);
        if (format.size[a] < 1) throw Error("raw format \"" + text + "\"", "a size must be 1 or more", kExpected);
    }
    const auto type = voxelTypeOf(parts[1]);
    if (!type)
        throw Error("raw format \"" + text + "\"", "\"" + parts[1] + "\" is no type",
                    "types are int8, uint8, int16, uint16, int32, uint32, float, double");
    format.type = *type;
    for (std::size_t i = 2; i < parts.size(); ++i) {
        if (parts[i] == "big" || parts[i] == "little")
            format.bigEndian = parts[i] == "big";
        else
            format.spacing = spacingOf(parts[i], text);
    }
    return format;
}

}  // namespace voledit
