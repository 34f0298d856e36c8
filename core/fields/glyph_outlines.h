#pragma once
// Outlines of letters, from a font of the system.

#include <string>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// A piece of an outline, straight.
struct OutlineSegment {
    Vec2 from, to;
};

/// One letter where it stands in its line: closed contours, laid end to end; inside is where they wind about a point
/// (nonzero rule). Never empty.
struct GlyphOutline {
    std::vector<OutlineSegment> segments;
    Vec2 min{kInfinity}, max{-kInfinity};  // box of the segments
};

/// Letters of `text` (UTF-8, one line) in the bold cut of Inter, kerned, capitals from y = 0 to `height`, the first
/// letter's place beginning at x = 0. Curves are flattened to within 10⁻⁴ of `height`. Spaces have no outline. Throws
/// Error where no font is found, a character is missing or none of them shows, or the text is empty, not UTF-8 or
/// longer than 200 characters.
std::vector<GlyphOutline> outlinesOf(const std::string& text, double height);

}  // namespace voledit
