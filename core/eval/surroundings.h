#pragma once
// What stands around a point takes of its light: shadows of the first light, and occlusion of the light from
// everywhere; by marching through the opacity of the whole deformed scene (core/objects/opacity_grid).

#include <array>
#include <memory>
#include <optional>

#include "core/objects/opacity_grid.h"
#include "core/scene/compile.h"
#include "core/scene/lighting.h"

namespace voledit {

/// How light is followed through an OpacityGrid; lengths in spacings of it. shaders/common/surroundings.glsl is its
/// twin.
namespace light_march {

/// A surface must not shade itself: light is looked for from so far outside of it.
inline constexpr float kLift = 1.5F;
/// Rays towards a light begin so far on.
inline constexpr float kStart = 1;
/// Light below this share is none.
inline constexpr float kDark = 1 / 256.0F;

/// Directions from a point, each with its opposite: the corners of an icosahedron and of a dodecahedron.
inline constexpr int kDirections = 32;
const std::array<Vec3f, kDirections>& directions();
/// Directions flatter over a surface than this cosine do not count: what is wide would meet the surface itself.
inline constexpr float kFlattest = 0.3F;

/// A stretch of the way in one direction.
struct Stretch {
    float middle, length;
    int level;     // of the grid's means
    float counts;  // what stands here, less with distance
};
inline constexpr int kStretches = 5;
/// Stretches up to `radius`.
std::array<Stretch, kStretches> stretchesTo(float radius);

}  // namespace light_march

/// The surroundings of one scene's points. Immutable, safe from many threads.
class Surroundings {
public:
    /// Prepares what `scene.render` asks for; nothing where it asks for neither shadows nor occlusion.
    explicit Surroundings(const CompiledScene& scene);

    /// True where nothing takes any light.
    bool none() const { return !grid_; }
    /// What is left at world point p of light from `towardFirst` (unit) and from everywhere.
    LightShare at(const Vec3& p, const Vec3& towardFirst) const;

    const std::shared_ptr<const OpacityGrid>& grid() const { return grid_; }
    /// How far surroundings occlude, in spacings of the grid.
    float radius() const { return radius_; }

    /// Outwards from what is opaque around a grid point: longer, up to 1, the clearer there is a side.
    static Vec3f outward(const OpacityGrid& grid, const Vec3f& at);
    /// What comes through of light from direction `toward` (unit) at a grid point.
    static float through(const OpacityGrid& grid, const Vec3f& at, const Vec3f& toward);
    /// How open surroundings up to `radius` are, for a surface that faces `outward`.
    static float openness(const OpacityGrid& grid, const Vec3f& at, const Vec3f& outward, float radius);

private:
    std::shared_ptr<const OpacityGrid> grid_;
    float shadows_ = 0, occlusion_ = 0, radius_ = 0;
};

/// The spacing at which a scene's surroundings are known, world units: the source's, coarser where steps are.
double surroundingsSpacing(const CompiledScene& scene);

}  // namespace voledit
