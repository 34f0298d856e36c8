#pragma once
// The rays of a picture, set up once: directions by additions instead of a camera for each pixel.

#include "core/base/types.h"
#include "core/scene/camera.h"

namespace voledit {

/// Rays from `eye` along origin + x · right + y · down for the centre of pixel (x, y): world space, one unit along the
/// view axis long.
struct PictureRays {
    PictureRays(const Camera& camera, Index2 size);

    Vec3 eye;
    Vec3 origin, right, down;

    Vec3 direction(double x, double y) const { return origin + x * right + y * down; }
};

}  // namespace voledit
