#include "render/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voledit {

View makeView(const Camera& camera, Index2 size) {
    const double vertical = std::tan(glm::radians(camera.fovY) / 2);
    return {camera.eye, basisOf(camera), {vertical * size.x / size.y, vertical}, size};
}

Vec3 View::viewFromWorld(const Vec3& p) const {
    const Vec3 d = p - eye;
    return {glm::dot(d, basis.right) / halfExtent.x, glm::dot(d, basis.up) / halfExtent.y, glm::dot(d, basis.forward)};
}

Vec3 View::rayAtOrigin() const {
    return basis.forward - halfExtent.x * basis.right - halfExtent.y * basis.up;
}

double View::longestRay() const {
    return std::sqrt(1 + glm::dot(halfExtent, halfExtent));
}

}  // namespace voledit
