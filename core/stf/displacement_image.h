#pragma once
// Where the images of displacements lie: maps that are known as p + Δ(p) alone (definitions.md §3.2, "Displace").

#include "core/base/interval.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// `rest` grown on all sides by the largest |Δ| of the points that `map` carries into it. Those are sought near
/// `likely` (world units; for combinations, where each operand alone would take `rest`) and, as the box grows, within
/// it. |Δ| is sampled (README.md): exact for translations; features of Δ narrower than an eighth of the box may be
/// missed.
Box3 imageByDisplacement(const SpatialTransferFunction& map, const Box3& rest, const Box3& likely);

/// `box` grown by `distance` (≥ 0) on all sides; an empty box stays as it is.
Box3 grown(const Box3& box, double distance);

/// Box of all of `map.anySourceBox(box)`; empty where the map is undefined in all of it.
Box3 sourceHull(const SpatialTransferFunction& map, const Box3& box);

/// Box of a·u + b·v for all u, v in two boxes. Infinite sides count as nothing where their factor is 0.
Box3 combination(double a, const Box3& u, double b, const Box3& v);

/// Box of (1−w)·u + w·v for all u, v in two boxes and w in `weight`: everything where `weight` is infinite.
Box3 blended(const Interval& weight, const Box3& u, const Box3& v);

}  // namespace voledit
