#include "core/fields/font_kerning.h"

#include <bit>
#include <set>
#include <string_view>

namespace voledit {

namespace {

constexpr int kPairs = 2, kExtension = 9;  // lookup types
constexpr int kXAdvance = 4;               // value format bit
constexpr std::string_view kFeature = "kern";

/// Bytes of a value record.
std::size_t sizeOf(int format) {
    return 2 * std::size_t(std::popcount(unsigned(format)));
}

}  // namespace

int FontKerning::number(std::size_t at) const {
    return at + 2 <= bytes_.size() ? bytes_[at] << 8 | bytes_[at + 1] : 0;
}

std::size_t FontKerning::longNumber(std::size_t at) const {
    return std::size_t(number(at)) << 16 | std::size_t(number(at + 2));
}

FontKerning::FontKerning(std::vector<std::uint8_t> gpos) : bytes_(std::move(gpos)) {
    const auto at = [&](std::size_t place) { return std::size_t(number(place)); };
    const std::size_t features = at(6), lookups = at(8);
    std::set<std::size_t> wanted;
    for (std::size_t f = 0; f < at(features); ++f) {
        const std::size_t record = features + 2 + 6 * f;
        if (record + 6 > bytes_.size()) return;
        if (std::string_view(reinterpret_cast<const char*>(&bytes_[record]), 4) != kFeature) continue;
        const std::size_t feature = features + at(record + 4);
        for (std::size_t n = 0; n < at(feature + 2); ++n) wanted.insert(at(feature + 4 + 2 * n));
    }
    for (const std::size_t index : wanted) {
        if (index >= at(lookups)) continue;
        const std::size_t lookup = lookups + at(lookups + 2 + 2 * index);
        std::vector<std::size_t> subtables;
        for (std::size_t n = 0; n < at(lookup + 4); ++n) {
            std::size_t table = lookup + at(lookup + 6 + 2 * n);
            int type = number(lookup);
            if (type == kExtension) {
                type = number(table + 2);
                table += longNumber(table + 4);
            }
            if (type == kPairs) subtables.push_back(table);
        }
        lookups_.push_back(std::move(subtables));
    }
}

int FontKerning::coverage(std::size_t table, std::uint32_t glyph) const {
    const int format = number(table), count = number(table + 2);
    for (int n = 0; n < count; ++n) {
        if (format == 1) {
            if (std::uint32_t(number(table + 4 + 2 * std::size_t(n))) == glyph) return n;
        } else if (format == 2) {
            const std::size_t range = table + 4 + 6 * std::size_t(n);
            const auto first = std::uint32_t(number(range)), last = std::uint32_t(number(range + 2));
            if (first <= glyph && glyph <= last) return number(range + 4) + int(glyph - first);
        }
    }
    return -1;
}

int FontKerning::classOf(std::size_t table, std::uint32_t glyph) const {
    if (number(table) == 1) {
        const auto first = std::uint32_t(number(table + 2)), count = std::uint32_t(number(table + 4));
        return glyph >= first && glyph - first < count ? number(table + 6 + 2 * std::size_t(glyph - first)) : 0;
    }
    for (int n = 0; n < number(table + 2); ++n) {
        const std::size_t range = table + 4 + 6 * std::size_t(n);
        if (std::uint32_t(number(range)) <= glyph && glyph <= std::uint32_t(number(range + 2)))
            return number(range + 4);
    }
    return 0;
}

bool FontKerning::pairAdvance(std::size_t table, std::uint32_t left, std::uint32_t right, int& advance) const {
    const int covered = coverage(table + std::size_t(number(table + 2)), left);
    if (covered < 0) return false;
    const int firstFormat = number(table + 4), secondFormat = number(table + 6);
    const std::size_t record = sizeOf(firstFormat) + sizeOf(secondFormat);
    std::size_t value = 0;
    if (number(table) == 1) {
        const std::size_t set = table + std::size_t(number(table + 10 + 2 * std::size_t(covered)));
        for (int n = 0; n < number(set) && value == 0; ++n) {
            const std::size_t pair = set + 2 + (2 + record) * std::size_t(n);
            if (std::uint32_t(number(pair)) == right) value = pair + 2;
        }
        if (value == 0) return false;
    } else {
        const int first = classOf(table + std::size_t(number(table + 8)), left);
        const int second = classOf(table + std::size_t(number(table + 10)), right);
        const int classes = number(table + 14);
        if (first >= number(table + 12) || second >= classes) return false;
        value = table + 16 + record * (std::size_t(first) * std::size_t(classes) + std::size_t(second));
    }
    // Placements come before the advance.
    advance = firstFormat & kXAdvance ? std::int16_t(number(value + sizeOf(firstFormat & (kXAdvance - 1)))) : 0;
    return true;
}

int FontKerning::between(std::uint32_t left, std::uint32_t right) const {
    int sum = 0;
    for (const auto& subtables : lookups_)
        for (const std::size_t table : subtables) {
            int advance = 0;
            if (!pairAdvance(table, left, right, advance)) continue;
            sum += advance;
            break;  // the first subtable that knows the pair decides
        }
    return sum;
}

}  // namespace voledit
