#pragma once
// Any chain of maps as cells within which it is affine, or nearly.

#include "core/rays/cell_look.h"

namespace voledit {

/// Tetrahedra over the space of the deformed object, in boxes of 1/16 to 1/64 of its extent: as large as lets the maps
/// be interpolated between their corners with an error below a tenth of a voxel, wherever there is something to see.
/// Boxes where that cannot be had (cuts, gaps, borders, strong bends) come last, from firstRagged on. A rough wish
/// takes half a voxel and boxes of 1/32. In parallel.
PacketCells chainCells(const CellWay& way, const VolumeLook& look, CellWish wish);

}  // namespace voledit
