#pragma once
// Basis functions of lattices along one axis.

#include <vector>

#include "core/stf/lattice.h"

namespace voledit {

/// The basis functions that are not 0 at some parameter, and their derivatives: those of points first, first + 1, …
struct BasisValues {
    std::size_t first = 0;
    std::vector<double> value, derivative;
};

/// At u in [0, 1], for `points` control points: Bernstein polynomials of degree points − 1, or uniform cubic B-splines
/// with clamped knots (0 0 0 0 1 2 … scaled to [0, 1]; points ≥ 4) [de Boor]. Values sum to 1, derivatives to 0.
BasisValues basisValues(LatticeBasis basis, int points, double u);

/// Parameters of the control points at rest: regular (Bézier) or the Greville abscissae (B-spline), from 0 to 1. With
/// control points there the curve is u itself.
std::vector<double> restParameters(LatticeBasis basis, int points);

}  // namespace voledit
