#pragma once
// The camera, and the light of a scene.

#include <optional>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

/// Perspective camera; world units, the vertical field of view in degrees.
struct Camera {
    Vec3 eye{0, -4, 0};
    Vec3 target{0};
    Vec3 up{0, 0, 1};
    double fovY = 30;

    bool operator==(const Camera&) const = default;
};

/// Camera axes: right, up, forward, orthonormal; forward points from eye to target. An `up` along the view is replaced
/// by another.
struct CameraBasis {
    Vec3 right, up, forward;
};
CameraBasis basisOf(const Camera& camera);

/// World direction (unit) through the centre of pixel (x, y), counted from the upper left, of a picture of `size`.
Vec3 rayThrough(const Camera& camera, Index2 size, double x, double y);

/// Pixel coordinates (upper left is 0,0; pixel centres at ½) and depth along the view axis of a world point; depth ≤ 0
/// is behind the eye.
Vec3 project(const Camera& camera, Index2 size, const Vec3& world);

/// The default camera: from the front (eye at −y, +z up), fovY 30, fitting the bounding sphere of `bounds` in a
/// picture of width/height `aspect` (scene-format.md §1).
Camera fittingCamera(const Box3& bounds, double aspect);
/// The same from another side: `front` points from what is seen towards the eye, `up` upwards, both unit and at right
/// angles.
Camera fittingCamera(const Box3& bounds, double aspect, const Vec3& front, const Vec3& up);

/// Lights that move with the camera: one from the eye; key, fill and rim lights in three moods.
enum class LightRig : std::uint8_t { Headlight, KeyFillRim, Soft, Dramatic };

/// What becomes of composited colours: kept, or a filmic curve on linear light.
enum class ToneMapping : std::uint8_t { None, Filmic };

struct RenderSettings {
    Vec3 background{0};
    double step = 0.5;  // units of the smallest spacing
    bool shading = true;
    double ambient = 0.3, diffuse = 0.7, specular = 0.2, shininess = 20;
    /// Direction from the surface towards the one light, world space; nullopt: `rig`.
    std::optional<Vec3> light;
    LightRig rig = LightRig::Headlight;
    double shadows = 0;            // how much of the first light its shadows take, 0 (none are computed) … 1
    double occlusion = 0;          // how much of the ambient light surroundings take, 0 (not computed) … 1
    double occlusionRadius = 0.1;  // how far surroundings count, of the diagonal of the root's box
    ToneMapping toneMapping = ToneMapping::None;
    double exposure = 0;       // stops: linear light times 2^exposure, before the tone mapping
    bool transparent = false;  // pictures keep their alpha; the background is left out

    bool operator==(const RenderSettings&) const = default;
};

/// C·(ambient + diffuse·|N·L|) + specular·(N·H)^shininess, white, two-sided; unlit where `gradient` is 0
/// (scene-format.md). `toEye` and `toLight` are unit vectors from the point.
Vec3 shade(const RenderSettings& settings, const Vec3& color, const Vec3& gradient, const Vec3& toEye,
           const Vec3& toLight);

}  // namespace voledit
