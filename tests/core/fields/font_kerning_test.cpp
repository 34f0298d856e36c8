#include "core/fields/font_kerning.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace voledit {
namespace {

/// Big-endian tables, written number by number.
struct Table {
    std::vector<std::uint8_t> bytes;
    Table& number(int v) {
        bytes.push_back(std::uint8_t(v >> 8));
        bytes.push_back(std::uint8_t(v));
        return *this;
    }
    Table& numbers(std::initializer_list<int> list) {
        for (const int v : list) number(v);
        return *this;
    }
    Table& tag(const std::string& name) {
        bytes.insert(bytes.end(), name.begin(), name.end());
        return *this;
    }
};

/// A GPOS table of one `kern` feature over lookups, each a type and one subtable.
std::vector<std::uint8_t> gposOf(const std::vector<std::pair<int, Table>>& lookups) {
    Table gpos;
    const int features = 10, feature = 8, count = int(lookups.size());
    const int list = features + feature + 4 + 2 * count;
    gpos.numbers({1, 0, 0, features, list});
    gpos.number(1).tag("kern").number(feature);
    gpos.numbers({0, count});
    for (int n = 0; n < count; ++n) gpos.number(n);
    gpos.number(count);
    int at = 2 + 2 * count;
    for (const auto& [type, table] : lookups) {
        gpos.number(at);
        at += 8 + int(table.bytes.size());
    }
    for (const auto& [type, table] : lookups) {
        gpos.numbers({type, 0, 1, 8});
        gpos.bytes.insert(gpos.bytes.end(), table.bytes.begin(), table.bytes.end());
    }
    return gpos.bytes;
}

/// Glyph 5 before 7: −30, before 8: +4 (format 1; placement bits in front of the advance).
Table pairs() {
    return Table{}.numbers({1, 12, 5, 0, 1, 18}).numbers({1, 1, 5}).numbers({2, 7, 99, -30, 8, 99, 4});
}

TEST(FontKerning, ReadsPairsOfGlyphs) {
    const FontKerning kerning(gposOf({{2, pairs()}}));
    EXPECT_EQ(kerning.between(5, 7), -30);
    EXPECT_EQ(kerning.between(5, 8), 4);
    EXPECT_EQ(kerning.between(5, 9), 0);
    EXPECT_EQ(kerning.between(6, 7), 0);
}

TEST(FontKerning, ReadsPairsOfClasses) {
    Table t;
    t.numbers({2, 24, 4, 0, 34, 44, 2, 2});
    t.numbers({0, 0, 0, -50});     // first class 0: 0, 0; first class 1: 0, −50
    t.numbers({2, 1, 10, 12, 0});  // coverage, by ranges
    t.numbers({1, 10, 2, 1, 0});   // the first's classes, glyph by glyph
    t.numbers({2, 1, 20, 20, 1});  // the second's, by ranges
    const FontKerning kerning(gposOf({{2, t}}));
    EXPECT_EQ(kerning.between(10, 20), -50);
    EXPECT_EQ(kerning.between(10, 21), 0);
    EXPECT_EQ(kerning.between(11, 20), 0) << "class 0";
    EXPECT_EQ(kerning.between(13, 20), 0) << "not covered";
}

TEST(FontKerning, FollowsExtensionsAndAddsLookups) {
    Table extension = Table{}.numbers({1, 2, 0, 8});
    const Table extended = pairs();
    extension.bytes.insert(extension.bytes.end(), extended.bytes.begin(), extended.bytes.end());
    const FontKerning kerning(gposOf({{9, extension}, {2, pairs()}}));
    EXPECT_EQ(kerning.between(5, 7), -60);
}

TEST(FontKerning, NoTableIsNoKerning) {
    EXPECT_EQ(FontKerning{}.between(1, 2), 0);
    EXPECT_EQ(FontKerning(std::vector<std::uint8_t>{}).between(1, 2), 0);
}

TEST(FontKerning, DamageReadsNothingBeyondTheTable) {
    const auto whole = gposOf({{2, pairs()}});
    std::mt19937 random(1);
    for (std::size_t length = 0; length < whole.size(); ++length)
        FontKerning(std::vector(whole.begin(), whole.begin() + std::ptrdiff_t(length))).between(5, 7);
    for (int n = 0; n < 3000; ++n) {
        auto damaged = whole;
        for (int m = 0; m < 3; ++m) damaged[random() % damaged.size()] = std::uint8_t(random());
        const int advance = FontKerning(damaged).between(5, 7);
        EXPECT_LE(std::abs(advance), 65536 * 8);
    }
}

}  // namespace
}  // namespace voledit
