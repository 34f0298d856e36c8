#pragma once
// Distances between pairs of letters, from a font's own table.

#include <cstdint>
#include <vector>

namespace voledit {

/// Pair kerning of an OpenType font: the `kern` feature of its GPOS table (OpenType 1.9, "GPOS", lookup types 2 and 9),
/// which FreeType itself does not read. A damaged table gives no kerning; nothing is read beyond its end.
class FontKerning {
public:
    /// No kerning.
    FontKerning() = default;
    /// The bytes of the table GPOS.
    explicit FontKerning(std::vector<std::uint8_t> gpos);

    /// What to add to the advance between glyphs `left` and `right`, font units.
    int between(std::uint32_t left, std::uint32_t right) const;

private:
    int number(std::size_t at) const;              // 16 bits, unsigned; 0 beyond the end
    std::size_t longNumber(std::size_t at) const;  // 32 bits
    /// Index of a glyph in a coverage table; −1 where it is not covered.
    int coverage(std::size_t table, std::uint32_t glyph) const;
    int classOf(std::size_t table, std::uint32_t glyph) const;
    /// True if this subtable decides; then `advance` is its answer.
    bool pairAdvance(std::size_t table, std::uint32_t left, std::uint32_t right, int& advance) const;

    std::vector<std::uint8_t> bytes_;
    std::vector<std::vector<std::size_t>> lookups_;  // of the feature: places of the pair subtables, in order
};

}  // namespace voledit
