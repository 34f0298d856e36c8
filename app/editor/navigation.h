#pragma once
// Moving the camera: pure functions from a camera to another. Sizes and positions are viewport pixels from the upper
// left.

#include "core/base/box3.h"
#include "core/scene/camera.h"

namespace voledit {

enum class StandardView : std::uint8_t { Front, Back, Left, Right, Top, Bottom };

/// Turntable about the vertical axis through the target: the eye turns by `azimuth` about +z and rises by `elevation`
/// (radians), the distance stays. +z stays upwards on screen, also at the poles, where the view stops.
Camera orbited(const Camera& camera, double azimuth, double elevation);

/// The turntable turn of dragging the pointer by `pixels`: half a turn over the viewport's height.
Camera orbitedByDrag(const Camera& camera, Index2 size, const Vec2& pixels);

/// Moves eye and target in the plane of the view so that the world point which was under pixel `from`, at the
/// distance of `anchor` along the view, lies under pixel `to`.
Camera panned(const Camera& camera, Index2 size, const Vec2& from, const Vec2& to, const Vec3& anchor);

/// Moves the eye nearer to (factor < 1) or further from the target, and both so that the point of the target's plane
/// under pixel `at` stays under it. The distance stays within [1e-4, 1e4] × `sceneSize`.
Camera zoomed(const Camera& camera, Index2 size, const Vec2& at, double factor, double sceneSize);

/// The distance factor of turning a mouse wheel by `notches` (positive is nearer).
double zoomFactor(double notches);

/// Keeps direction and field of view; the target is the middle of `box` and its bounding sphere fits in the picture.
/// The camera itself for an empty box.
Camera framed(const Camera& camera, Index2 size, const Box3& box);

/// Looks along an axis at the same target from the same distance: Front has the eye at −y, Right at +x, Top at +z
/// with +y up on screen.
Camera standardView(const Camera& camera, StandardView view);

}  // namespace voledit
