#pragma once
// Arrays of mapped cells in the storage buffers that shaders/common/cell_search.glsl reads.

#include <array>

#include "render/cell_arrays.h"
#include "render/gl_objects.h"

namespace voledit {

/// Throws Error where the driver's blocks are too small.
std::array<Buffer, 5> cellBuffers(const CellArrays& arrays);
void bindCells(const std::array<Buffer, 5>& buffers);

}  // namespace voledit
