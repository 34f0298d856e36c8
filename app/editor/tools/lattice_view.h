#pragma once
// The scene's lattices as the viewport shows them: where their control points stand.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/compile.h"
#include "core/scene/scene.h"
#include "core/stf/lattice.h"

namespace voledit {

/// A lattice, and the affine maps outside it (places and affine transfers applied after it), through which its control
/// points are shown. Outer maps that are not affine are left out: the lattice then stands where it acts, not where its
/// object is shown.
struct LatticeView {
    std::string name;
    Lattice lattice;             // as edited, in the space it acts in
    Mat4 shownFromLattice{1.0};  // that space → world as shown
    bool exact = true;           // false: an outer map that is not affine was left out
    bool enabled = true;
    TransferPtr map;  // its compiled map where there is one; else null

    /// Control point `index` as shown, world units.
    Vec3 shown(std::size_t index) const { return transformPoint(shownFromLattice, lattice.control[index]); }
};

/// Every lattice that the scene's root passes through, the outermost first, as they are at the compiled time. Frames
/// left out come from `compiled` (the operand's box; may be null); a lattice whose frame cannot be known yet is left
/// out.
std::vector<LatticeView> latticeViews(const Scene& scene, const CompiledScene* compiled);

/// The one called `name`; with an empty name the outermost. nullopt where there is none.
std::optional<LatticeView> latticeView(const Scene& scene, const CompiledScene* compiled, const std::string& name);

/// (i, j, k) of control point `index`; the inverse of Lattice::indexOf.
Index3 gridIndexOf(const Lattice& lattice, std::size_t index);

}  // namespace voledit
