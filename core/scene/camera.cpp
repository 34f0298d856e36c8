#include "core/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voledit {

namespace {

/// Half the picture's extent at unit depth: tangents of the half angles.
Vec2 halfExtent(const Camera& camera, double aspect) {
    const double vertical = std::tan(glm::radians(camera.fovY) / 2);
    return {vertical * aspect, vertical};
}

double aspectOf(Index2 size) {
    return double(size.x) / double(size.y);
}

}  // namespace

CameraBasis basisOf(const Camera& camera) {
    const Vec3 view = camera.target - camera.eye;
    const double distance = glm::length(view);
    const Vec3 forward = distance > 0 ? view / distance : Vec3(0, 1, 0);
    for (const Vec3& up : {camera.up, Vec3(0, 0, 1), Vec3(0, 1, 0)}) {
        const Vec3 right = glm::cross(forward, up);
        const double length = glm::length(right);
        // Nearly along the view, the picture's rotation would be decided by rounding.
        if (length > 1e-9 * glm::length(up)) return {right / length, glm::cross(right / length, forward), forward};
    }
    return {Vec3(1, 0, 0), glm::cross(Vec3(1, 0, 0), forward), forward};
}

Vec3 rayThrough(const Camera& camera, Index2 size, double x, double y) {
    const CameraBasis basis = basisOf(camera);
    const Vec2 half = halfExtent(camera, aspectOf(size));
    const double right = (2 * (x + 0.5) / size.x - 1) * half.x;
    const double up = (1 - 2 * (y + 0.5) / size.y) * half.y;
    return glm::normalize(basis.forward + right * basis.right + up * basis.up);
}

Vec3 project(const Camera& camera, Index2 size, const Vec3& world) {
    const CameraBasis basis = basisOf(camera);
    const Vec2 half = halfExtent(camera, aspectOf(size));
    const Vec3 view = world - camera.eye;
    const double depth = glm::dot(view, basis.forward);
    const double right = glm::dot(view, basis.right) / (depth * half.x);
    const double up = glm::dot(view, basis.up) / (depth * half.y);
    return {(right + 1) / 2 * size.x, (1 - up) / 2 * size.y, depth};
}

Camera fittingCamera(const Box3& bounds, double aspect) {
    Camera camera;
    const double radius = bounds.empty() ? 1 : std::max(glm::length(bounds.size()) / 2, 1e-12);
    const Vec2 half = halfExtent(camera, aspect);
    camera.target = bounds.empty() ? Vec3(0) : bounds.center();
    // The sphere touches the nearer pair of the view's four sides.
    camera.eye = camera.target - Vec3(0, radius / std::sin(std::atan(std::min(half.x, half.y))), 0);
    return camera;
}

Camera fittingCamera(const Box3& bounds, double aspect, const Vec3& front, const Vec3& up) {
    Camera camera = fittingCamera(bounds, aspect);
    camera.eye = camera.target + glm::length(camera.eye - camera.target) * front;
    camera.up = up;
    return camera;
}

}  // namespace voledit
