#pragma once
// Terms that are one volume under affine maps and at most one map of cells: what can be voxelised tetrahedron by
// tetrahedron.

#include <optional>

#include "core/objects/term.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

/// The way from world space to a volume's samples: affine, cells where there are any, affine.
struct ScalarChain {
    Mat4 deformedFromWorld{1.0};         // to the cells' deformed space; without cells, to the volume's world space
    const MappedCells* cells = nullptr;  // may be null
    bool keepsOutside = false;           // outside of the cells points stay where they are
    Mat4 indexFromSource{1.0};           // from the cells' source space (without cells: that same space) to samples
    const Volume* volume = nullptr;      // its channel 0, interpolated linearly
};

/// nullopt for any other term. Recolouring, which changes no scalar, is passed over.
std::optional<ScalarChain> scalarChainOf(const Term& root);

}  // namespace voledit
