#pragma once
// Volumes in mapped cells: one piece of a ray in each cell that it passes.

#include "core/rays/cell_look.h"
#include "core/rays/tile_caster.h"

namespace voledit {

/// Draws `look` for `scene`'s camera, light and steps.
std::unique_ptr<const TileCaster> makeCellTiles(const CompiledScene& scene, Index2 size,
                                                std::shared_ptr<const CellLook> look);

}  // namespace voledit
