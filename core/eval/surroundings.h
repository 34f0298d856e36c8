#pragma once
// What stands around a point takes of its light: shadows of the first light, and occlusion of the light from
// everywhere; by what light finds in the opacity of the whole deformed scene (core/objects/opacity_grid).

#include <memory>

#include "core/objects/opacity_grid.h"
#include "core/objects/openness.h"
#include "core/objects/shadow_volume.h"
#include "core/scene/compile.h"
#include "core/scene/lighting.h"

namespace voledit {

/// How light is looked for in an OpacityGrid; lengths in spacings of it. shaders/common/surroundings.glsl is its twin.
namespace light_march {

/// A surface must not shade itself: light is looked for from so far outside of it.
inline constexpr float kLift = 1.5F;
/// Rays towards a light begin so far on.
inline constexpr float kStart = 1;
/// Light below this share is none.
inline constexpr float kDark = 1 / 256.0F;

}  // namespace light_march

/// The surroundings of one scene's points. Immutable, safe from many threads.
class Surroundings {
public:
    /// Prepares what `scene.render` asks for; nothing where it asks for neither shadows nor occlusion.
    explicit Surroundings(const CompiledScene& scene);

    /// True where nothing takes any light.
    bool none() const { return !grid_; }
    /// What is left at world point p, seen along −toEye (unit), of the first light and of that from everywhere.
    LightShare at(const Vec3& p, const Vec3& toEye) const;

    const std::shared_ptr<const OpacityGrid>& grid() const { return grid_; }
    /// Null where there is no occlusion.
    const std::shared_ptr<const Openness>& openness() const { return openness_; }
    /// Null where there are no shadows, or where the light comes from the eye.
    const std::shared_ptr<const ShadowVolume>& shadows() const { return shadowVolume_; }

    /// Where the light comes from that shadows() are of (unit, world space).
    const Vec3f& towardFirst() const { return towardFirst_; }

    /// What comes through of light from direction `toward` (unit) at a grid point, by marching.
    static float through(const OpacityGrid& grid, const Vec3f& at, const Vec3f& toward);

private:
    std::shared_ptr<const OpacityGrid> grid_;
    std::shared_ptr<const Openness> openness_;
    std::shared_ptr<const ShadowVolume> shadowVolume_;
    Vec3f towardFirst_{0};
    float shadows_ = 0, occlusion_ = 0;
};

/// The spacing at which a scene's surroundings are known, world units: the source's, coarser where steps are.
double surroundingsSpacing(const CompiledScene& scene);

}  // namespace voledit
