#pragma once
// Which cells slices cut of a term: bricks in world space, or the cells of its outermost forward map.

#include <memory>

#include "core/objects/term.h"
#include "render/cell_mesh.h"
#include "render/slice_plan.h"

namespace voledit {

/// Bricks over the term's bounds and half a slab around them, without those in which nothing can be seen
/// (core/objects/empty_space.h).
/// @param slab  extent of a slab along a ray at most, world units
CellMesh termBricks(const Term& term, double slab, bool cull);

/// The cells of the outermost forward map, without those in whose source nothing can be seen; they carry places: source
/// points less `origin`.
CellMesh termCells(const TermPlan& plan, const Vec3& origin, double slab, bool cull);

/// The cells of the term that slices drew last.
class TermMesh {
public:
    void prepare(const TermPlan& plan, const Vec3& origin, double slab, bool cull);
    const CellMesh& mesh() const { return mesh_; }

private:
    std::weak_ptr<const Term> root_;
    Vec3 origin_{0};
    double slab_ = 0;
    bool cull_ = true;
    CellMesh mesh_;
};

}  // namespace voledit
