#pragma once
// What slices draw of a term: a chain of forward and affine maps over one volume, which has its own programs, or any
// other term by a generated one.

#include <memory>
#include <optional>
#include <vector>

#include "render/term_program.h"

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

/// Nullopt for a term that is no such chain, and for chains with folded maps below another one.
std::optional<SlicePlan> planChain(const TermPtr& root);

/// Any term: a generated program draws `drawn`, in bricks of the world; or `forward`, a map with cells (with affine
/// maps above it), is outermost, and its cells are cut, whose polygons carry the source coordinates. Not where there
/// are solids: rays that pass less than a slab of the cells may miss every slice, and solids often touch their box.
struct TermPlan {
    TermPtr root;   // keeps all below alive
    TermPtr drawn;  // the root, or the operand of `forward`
    const TransferTerm* forward = nullptr;
    Mat4 worldFromDeformed{1};
    Box3 bounds;          // of what is drawn, and of the cells' source
    bool solids = false;  // there are some in it: edges are hard
};
TermPlan planTerm(const TermPtr& root);
/// Whether cells' polygons may carry the map: each point has one pre-image at most, and the cells' source fills a box,
/// so that renderers know where it ends.
bool canBeCut(const SpatialTransferFunction& map);

/// Throws Error for a term that slices cannot draw, which says to use rays.
void checkSlices(const TermPtr& root);

}  // namespace voledit
