#pragma once
// The lights of a scene as a picture sees them, and what a surface makes of them.

#include <array>

#include "core/scene/camera.h"

namespace voledit {

/// A light from far away.
struct FarLight {
    Vec3 toward{0};  // from the surface, world space, unit
    double intensity = 1;
};

/// Lights of one picture. Those of a rig move with the camera.
struct Lights {
    enum class Kind : std::uint8_t {
        Head,   // one, from the eye: `toward` is each ray's own, `first` stands for it in the picture's middle
        Fixed,  // one that stays, two-sided (scene-format.md)
        Rig     // several, on the side of the surface that the eye sees
    };
    static constexpr std::size_t kMost = 3;

    Kind kind = Kind::Head;
    std::array<FarLight, kMost> light;  // the first is the one that casts shadows
    std::size_t count = 1;
    double ambient = 1;  // times the settings' own

    /// Direction towards the first light from a point seen along −`toEye`.
    Vec3 towardFirst(const Vec3& toEye) const { return kind == Kind::Head ? toEye : light[0].toward; }
};
Lights lightsOf(const RenderSettings& settings, const Camera& camera);

/// What what stands around a point leaves of its light, 0 … 1 each.
struct LightShare {
    double first = 1;    // of the first light
    double ambient = 1;  // of the light from everywhere
};

/// C·(ambient + diffuse·Σ Iₗ·|N·Lₗ|) + specular·Σ Iₗ·(N·Hₗ)^shininess, white, by `share`; of a rig max(N·L, 0) with N
/// towards the eye. Unlit where `gradient` is 0 or none. `toEye` is a unit vector.
Vec3 litColor(const RenderSettings& settings, const Lights& lights, const Vec3& color, const Vec3& gradient,
              const Vec3& toEye, const LightShare& share = {});

}  // namespace voledit
