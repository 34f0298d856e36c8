#pragma once
// Signed distances from outlines in a plane, on a grid.

#include <memory>

#include "core/fields/glyph_outlines.h"
#include "core/fields/volume.h"

namespace voledit {

/// The pieces that bound the union of all letters: outlines cut where they cross, those within others left out.
std::vector<OutlineSegment> boundaryOf(const std::vector<GlyphOutline>& letters);

/// Signed distance from the boundary of the letters' union, negative inside, exact at the samples: float, one sample
/// along y, the outlines' x and y along the world's x and z, `spacing` apart, `margin` about the letters' box.
std::shared_ptr<const Volume> tabulatedDistance(const std::vector<GlyphOutline>& letters, double spacing,
                                                double margin);

}  // namespace voledit
