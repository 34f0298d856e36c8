#pragma once
// Which cells slices cut of a term: bricks in world space, or the cells of its outermost forward map.

#include <memory>

#include "core/objects/term.h"
#include "render/cell_mesh.h"

namespace voledit {

/// Bricks over the term's bounds and half a slab around them, without those in which nothing can be seen
/// (core/objects/empty_space.h).
/// @param slab  extent of a slab along a ray at most, world units
CellMesh termBricks(const Term& term, double slab, bool cull);

/// The cells of the term that slices drew last.
class TermCells {
public:
    void prepare(const TermPtr& root, double slab, bool cull);
    const CellMesh& mesh() const { return mesh_; }

private:
    std::weak_ptr<const Term> root_;
    double slab_ = 0;
    bool cull_ = true;
    CellMesh mesh_;
};

}  // namespace voledit
