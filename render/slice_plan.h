#pragma once
// What slices draw of a term: which cells are cut, and how index coordinates follow from them.

#include "core/objects/term.h"

namespace voledit {

/// A chain of transfers over one volume, seen by the slice renderer. The outermost forward map's cells are cut; affine
/// maps above it move the cells, affine maps below it are folded into `indexFromSource`.
struct SlicePlan {
    TermPtr root;  // keeps all below alive
    const VolumeTerm* volume = nullptr;
    const TransferTerm* forward = nullptr;  // the outermost forward map; null: the volume is moved affinely only
    Mat4 worldFromDeformed{1};              // from the cells' deformed positions to the world
    Mat4 indexFromSource{1};                // from the cells' source coordinates (the world, without cells) to indices
};

/// Throws Error for a term that slices cannot draw, which says to use rays.
SlicePlan planSlices(const TermPtr& root);

}  // namespace voledit
