#pragma once
// Which way a body stands: its left, up and front, found from the opaque voxels alone.

#include "core/rigging/opaque_voxels.h"

namespace voledit {

/// Columns are the body's left, up and front in the object's space: signed coordinate axes, left = up × front.
struct BodyFrame {
    Mat3 axes{1.0};
};

/// Left and right lie along the axis across which the body mirrors itself best; up is the one of the other two whose
/// ends show legs (parts that stand apart, mirrored or in two pairs) at the bottom; front is where the feet point to;
/// with `fourLegs`, where the highest part is, the head.
/// Where the shape does not tell: up is the longer axis (a biped's) or the shorter one (`fourLegs`), front is positive.
BodyFrame bodyFrame(const OpaqueVoxels& voxels, bool fourLegs);

/// The same voxels on a grid along the body's axes: x left, y up, z front. A point p of it is frame.axes · p in the
/// object's space.
OpaqueVoxels turned(const OpaqueVoxels& voxels, const BodyFrame& frame);

/// How well the voxels mirror themselves across the plane through their mean with normal `axis`: the share whose
/// mirrored cell is opaque, too, 0…1.
double mirrorSymmetry(const OpaqueVoxels& voxels, int axis);

/// The connected parts (26 neighbours) of the opaque voxels with cells from `low` to `high`, at least `least` cells
/// each: how many cells, and the mean of their centres. Largest first.
struct Part {
    std::size_t cells = 0;
    Vec3 mean{0};
};
std::vector<Part> partsOf(const OpaqueVoxels& voxels, const Index3& low, const Index3& high, std::size_t least);

}  // namespace voledit
