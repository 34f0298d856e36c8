#pragma once
// The camera as the slices see it: depth along the view axis, and rays of unit depth.

#include "core/scene/camera.h"

namespace voledit {

/// View space: x to the right, y up, both divided by the half picture's tangent so that x / depth is −1…1 across the
/// picture; z is the depth along the view axis, world units.
struct View {
    Vec3 eye;
    CameraBasis basis;
    Vec2 halfExtent;  // tangents of half the horizontal and vertical angle of view
    Index2 size;      // pixels

    Vec3 viewFromWorld(const Vec3& p) const;
    /// World direction of unit depth through window position (x, y), y up, is
    /// rayAtOrigin() + x · rayPerPixelX() + y · rayPerPixelY().
    Vec3 rayAtOrigin() const;
    Vec3 rayPerPixelX() const { return basis.right * (2 * halfExtent.x / size.x); }
    Vec3 rayPerPixelY() const { return basis.up * (2 * halfExtent.y / size.y); }
    /// Length of such a direction in the picture's corner, the longest.
    double longestRay() const;
};

View makeView(const Camera& camera, Index2 size);

}  // namespace voledit
