#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/scene/camera.h"

namespace voledit {

Vec3 shade(const RenderSettings& settings, const Vec3& color, const Vec3& gradient, const Vec3& toEye,
           const Vec3& toLight) {
    // By the largest component first: squares of steep formulas' gradients overflow.
    const Vec3 scaled = gradient / std::max({std::abs(gradient.x), std::abs(gradient.y), std::abs(gradient.z)});
    const double steepness = glm::length(scaled);
    if (!settings.shading || !(steepness > 0)) return color;
    const Vec3 normal = scaled / steepness;
    const Vec3 between = toLight + toEye;
    const double width = glm::length(between);
    const double facing = std::abs(glm::dot(normal, toLight));
    // Light straight from behind has no half vector, and no highlight.
    const double highlight = width > 0 ? std::abs(glm::dot(normal, between / width)) : 0;
    return color * (settings.ambient + settings.diffuse * facing) +
           Vec3(settings.specular * std::pow(highlight, settings.shininess));
}

}  // namespace voledit
