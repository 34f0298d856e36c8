#include "core/rays/picture_rays.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace voledit {

PictureRays::PictureRays(const Camera& camera, Index2 size) : eye(camera.eye) {
    const CameraBasis basis = basisOf(camera);
    const double halfY = std::tan(glm::radians(camera.fovY) / 2), halfX = halfY * size.x / size.y;
    right = (2 * halfX / size.x) * basis.right;
    down = (-2 * halfY / size.y) * basis.up;
    origin = basis.forward + halfX * (1.0 / size.x - 1) * basis.right + halfY * (1 - 1.0 / size.y) * basis.up;
}

}  // namespace voledit
