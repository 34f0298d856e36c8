#pragma once
// Small pictures drawn large, on the CPU.

#include <cstdint>
#include <vector>

#include "core/base/picture.h"

namespace voledit {

/// `picture` over a view of `size` pixels, as bytes r, g, b, 255, the lowest row first (as OpenGL has it): Catmull and
/// Rom's spline between pixels, which passes through them; where sizes are equal the picture itself. Its height fills
/// the view's; of its width the middle is taken that has the view's proportions, so that things stand where they stand
/// in a full-size picture of the same camera. Colours are clamped to [0, 1]. In parallel.
void enlarge(const Picture& picture, Index2 size, std::vector<std::uint8_t>& bytes);

}  // namespace voledit
