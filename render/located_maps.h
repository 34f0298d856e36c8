#pragma once
// Forward maps below the one whose cells are cut: what a fragment needs to find its points in them.

#include <vector>

#include "render/cell_arrays.h"
#include "render/slice_plan.h"
#include "render/visibility.h"

namespace voledit {

/// All located maps of a plan: what each gives are the next map's grid coordinates, or the volume's indices after the
/// last.
struct LocatedMaps : CellArrays {
    /// From the source space of the forward map above all of them to the first one's grid coordinates.
    Mat4 entryFromSource{1};
    /// From each located map's source space to where its results are looked up: the next one's grid coordinates, or the
    /// volume's indices.
    std::vector<Mat4> nextFromSource = {};
};

/// Needs at least one located map. Throws Error where the cells are too many for 32 bits.
LocatedMaps makeLocatedMaps(const SlicePlan& plan);

/// For each cell of the outermost forward map 1 unless nothing can be seen in it.
/// @param slab  extent of a slab along a ray at most, world units; what is seen there counts too
std::vector<char> cellsSeen(const SlicePlan& plan, const Visibility& visibility, double slab);

}  // namespace voledit
