#pragma once
// What slices draw of a term: which cells are cut, which maps fragments look up, how index coordinates follow from
// them.

#include <vector>

#include "core/objects/term.h"

namespace voledit {

/// A forward map below another one.
struct LocatedTransfer {
    const TransferTerm* transfer;
    Mat4 deformedFromSource{1};  // the affine maps between: from the source space of the forward map above it
};

/// A chain of transfers over one volume, seen by the slice renderer. The outermost forward map's cells are cut; affine
/// maps above it move the cells. In forward maps below it fragments locate their points; affine maps between are folded
/// into `deformedFromSource` and `indexFromSource`.
struct SlicePlan {
    /// As shaders/common/located.glsl has it.
    static constexpr std::size_t kMostLocated = 8;

    TermPtr root;  // keeps all below alive
    const VolumeTerm* volume = nullptr;
    const TransferTerm* forward = nullptr;  // the outermost forward map; null: the volume is moved affinely only
    Mat4 worldFromDeformed{1};              // from the cells' deformed positions to the world
    std::vector<LocatedTransfer> located;   // outermost first; empty where `forward` is null
    Mat4 indexFromSource{1};  // from the innermost forward map's source (the world, without one) to indices
};

/// Throws Error for a term that slices cannot draw, which says to use rays.
SlicePlan planSlices(const TermPtr& root);

}  // namespace voledit
