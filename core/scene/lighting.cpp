#include "core/scene/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voledit {

namespace {

/// A light of a rig: to the right, upwards, and towards the eye.
struct RigLight {
    Vec3 place;
    double intensity;
};

struct Rig {
    std::array<RigLight, Lights::kMost> lights;
    double ambient;
};

Rig rigOf(LightRig rig) {
    switch (rig) {
        case LightRig::KeyFillRim:  // key from the upper left, fill from the right, rim from behind above
            return {{{{{-0.6, 0.65, 0.75}, 1}, {{0.8, 0.1, 0.7}, 0.4}, {{0.35, 0.75, -0.75}, 0.5}}}, 0.9};
        case LightRig::Soft:  // three nearly alike, around the eye
            return {{{{{-0.45, 0.5, 0.9}, 0.5}, {{0.6, 0.2, 0.9}, 0.32}, {{0, -0.5, 0.9}, 0.18}}}, 1.25};
        case LightRig::Dramatic:  // nearly from the side, hardly any fill, a strong rim
            return {{{{{-0.85, 0.55, 0.3}, 1.15}, {{0.8, 0.25, -0.6}, 0.7}, {{0.6, -0.2, 0.8}, 0.06}}}, 0.45};
        case LightRig::Headlight:
            break;
    }
    return {{{{{0, 0, 1}, 1}, {{0, 0, 1}, 0}, {{0, 0, 1}, 0}}}, 1};
}

/// Unit; 0 where there is no finite direction. By the largest component first: squares of steep formulas' gradients
/// overflow.
Vec3 directionOf(const Vec3& v) {
    const Vec3 scaled = v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const double length = glm::length(scaled);
    return length > 0 ? scaled / length : Vec3(0);
}

}  // namespace

Lights lightsOf(const RenderSettings& settings, const Camera& camera) {
    const CameraBasis basis = basisOf(camera);
    Lights lights;
    lights.light[0] = {-basis.forward, 1};
    if (settings.light) {
        lights.kind = Lights::Kind::Fixed;
        lights.light[0].toward = glm::normalize(*settings.light);
    } else if (settings.rig != LightRig::Headlight) {
        const Rig rig = rigOf(settings.rig);
        lights.kind = Lights::Kind::Rig;
        lights.count = rig.lights.size();
        lights.ambient = rig.ambient;
        for (std::size_t l = 0; l < lights.count; ++l) {
            const Vec3 place = rig.lights[l].place;
            const Vec3 toward = place.x * basis.right + place.y * basis.up - place.z * basis.forward;
            lights.light[l] = {glm::normalize(toward), rig.lights[l].intensity};
        }
    }
    return lights;
}

Vec3 litColor(const RenderSettings& settings, const Lights& lights, const Vec3& color, const Vec3& gradient,
              const Vec3& toEye, const LightShare& share) {
    Vec3 normal = settings.shading ? directionOf(gradient) : Vec3(0);
    if (normal == Vec3(0)) return color;
    const bool twoSided = lights.kind != Lights::Kind::Rig;
    if (!twoSided && glm::dot(normal, toEye) < 0) normal = -normal;
    const auto facing = [&](const Vec3& direction) {
        const double cosine = glm::dot(normal, direction);
        return twoSided ? std::abs(cosine) : std::max(cosine, 0.0);
    };
    double diffuse = 0, highlight = 0;
    for (std::size_t l = 0; l < lights.count; ++l) {
        const Vec3 toward = l == 0 ? lights.towardFirst(toEye) : lights.light[l].toward;
        const double intensity = lights.light[l].intensity * (l == 0 ? share.first : 1);
        // Light straight from behind has no half vector, and no highlight; nor has a side that is turned away.
        const Vec3 half = directionOf(toward + toEye);
        const double lit = facing(toward);
        diffuse += intensity * lit;
        if (half != Vec3(0) && (twoSided || lit > 0))
            highlight += intensity * std::pow(facing(half), settings.shininess);
    }
    return color * (settings.ambient * lights.ambient * share.ambient + settings.diffuse * diffuse) +
           Vec3(settings.specular * highlight);
}

}  // namespace voledit
