#pragma once
// Limbs' boxes placed about their bones, at rest or posed. Of use to limb_regions.cpp and its parts only.

#include <array>

#include "core/skeleton/limb_regions.h"

namespace voledit {

/// Corners of a quadrilateral across a bone in cyclic order: (u, v) = (0,0), (1,0), (1,1), (0,1) of the limb's grid.
using Quad = std::array<Vec3, 4>;

/// The bilinear point at (u, v), exact at the corners, and its derivatives.
inline Vec3 pointOf(const Quad& q, double u, double v) {
    return (1 - v) * ((1 - u) * q[0] + u * q[1]) + v * ((1 - u) * q[3] + u * q[2]);
}
inline Vec3 alongU(const Quad& q, double v) {
    return (1 - v) * (q[1] - q[0]) + v * (q[2] - q[3]);
}
inline Vec3 alongV(const Quad& q, double u) {
    return (1 - u) * (q[3] - q[0]) + u * (q[2] - q[1]);
}

/// A limb's box about its bone, before its ends are cut.
struct PlacedLimb {
    Vec3 start{0}, end{0};    // the bone's joints
    Vec3 direction{0};        // unit, start to end
    Vec3 along{0};            // what a unit vector along the rest bone has become: pads are laid along it
    Quad section{};           // its corners' offsets from the bone
    double bone[2] = {0, 0};  // (u, v) of the bone in the section
};

/// The box between two posed joints, its section carried by `from`'s linear part and then by the shortest arc to the
/// bone's direction (no turn where the bone is as long and as directed as `from` carries it). `turns`: quarter turns of
/// the grid against the bone frame `restFrame`; corner m of the grid is corner m + turns of the frame.
/// `from` and `to` must lie apart.
PlacedLimb placedLimb(const Limb& limb, const Mat3& restFrame, int turns, const PosedJoint& from, const PosedJoint& to);

/// The quadrilateral turned by quarter turns: corner m is corner m + turns of `quad`.
Quad turned(const Quad& quad, int turns);

}  // namespace voledit
