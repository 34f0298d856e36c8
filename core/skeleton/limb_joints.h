#pragma once
// Where limbs meet: which continues which, and the faces they end in. Of use to limb_regions.cpp and its parts only.

#include <vector>

#include "core/skeleton/limb_frames.h"

namespace voledit {

/// Which limbs continue which; -1 for none. A limb is continued by one at most and continues one at most: where several
/// end at a joint, the straightest pair is joined.
struct LimbLinks {
    std::vector<int> next, previous;
    std::vector<int> order;  // limbs, each chain from its first on; those of a circle are left out
};
LimbLinks linkedLimbs(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                      const std::vector<bool>& disjoint);

/// The faces in which two connected limbs end.
struct JointFaces {
    Quad end{}, start{};  // of the first limb and of the second: one quadrilateral where there is no wedge
    Vec3 joint{0};
    Vec3 normal{0};         // of the plane of `end`, unit, along the first limb
    Vec3 axis{0};           // of the bend, unit; only with a wedge
    double wedge = 0;       // radians by which `start` is `end` turned about the axis, ≥ 0; > 0 past the miter limit
    Quat turn{1, 0, 0, 0};  // that

    /// Whether a point of `end` lies where the wedge opens, off the axis by more than rounding.
    bool outside(const Vec3& point) const;
};

/// Mid-plane geometry for the first limb's end and the second's start. Past the miter limit the second limb is taken as
/// bent by the limit only, which gives `end`; `start` is that face turned by the rest of the bend. So faces follow the
/// bend continuously, and the wedge between them is one of rotation. `miterLimit` ≥ 1.
JointFaces jointFaces(const PlacedLimb& first, const PlacedLimb& second, double miterLimit);

/// Quarter turns that the second limb's section needs so that its corners lie nearest to the first's in their plane
/// (least sum of squared distances; the fewest turns of equals).
int matchingTurns(const PlacedLimb& first, const PlacedLimb& second, double miterLimit);

/// The largest angle between two bones that is still mitred, radians: 2·arccos(1 / miterLimit).
double largestMitre(double miterLimit);

}  // namespace voledit
