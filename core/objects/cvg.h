#pragma once
// The operators of constructive volume geometry, on samples (definitions.md §4). shaders/term/cvg.glsl is their twin.

#include "core/objects/term.h"

namespace voledit {

/// `a` and `b` combined by the table of definitions.md §4; `weight` is blend's. An undefined weight gives an empty
/// sample. Colour stays as the formulas give it, also where opacity comes to 0. Besides:
/// - `value`, of union, intersection, merge and blend, is that of the larger opacity (blend: weighted opacity), the
///   first's on a tie, one that has a value before one that has none; of the others, the first's.
/// - `normalGradient` is that of the operand whose surface is seen: union, merge, blend: the larger (weighted) opacity;
///   intersection: the smaller; the first on ties; cap, trim: the first; difference: the first, but where the second
///   takes something off, −∇ of the second (if it is not 0), since there its surface is laid bare. Between two samples
///   with depths, intersection, cap and difference take the surface that is nearer.
/// - `depth` is that of the shape which the operator makes of the two: the larger (union), the smaller (intersection,
///   cap), the smaller of the first and minus the second (difference), the first's (trim); NaN where one has none.
ObjectSample cvg(CvgOperator by, const ObjectSample& a, const ObjectSample& b, double weight = 0);

/// `x` clamped to [0, 1]; 0 where it is undefined or infinite: a division by zero shows nothing.
inline double clampedOpacity(double x) {
    return x > 0 && x < kInfinity ? (x < 1 ? x : 1) : 0;
}

}  // namespace voledit
