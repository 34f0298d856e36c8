#include "app/editor/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voledit {

namespace {

/// Where the eye stands about its target, as a globe's longitude and latitude.
struct Turntable {
    double azimuth, elevation, distance;
};

Turntable turntableOf(const Camera& camera) {
    const Vec3 toEye = camera.eye - camera.target;
    const double distance = glm::length(toEye);
    const double level = std::hypot(toEye.x, toEye.y);
    const double elevation = std::atan2(toEye.z, level);
    // Over a pole the position tells no longitude; the picture's own right does.
    if (level > 1e-6 * distance) return {std::atan2(toEye.y, toEye.x), elevation, distance};
    const Vec3 right = basisOf(camera).right;
    return {std::atan2(-right.x, right.y), elevation, distance};
}

Camera placed(const Camera& camera, const Turntable& at) {
    const double c = std::cos(at.elevation), s = std::sin(at.elevation);
    const Vec3 heading{std::cos(at.azimuth), std::sin(at.azimuth), 0};
    Camera result = camera;
    result.eye = camera.target + at.distance * Vec3{c * heading.x, c * heading.y, s};
    // Near a pole z no longer tells what is up; the direction towards it does.
    const bool nearPole = c < 0.02;
    result.up = nearPole ? Vec3{-s * heading.x, -s * heading.y, c} : Vec3{0, 0, 1};
    return result;
}

/// World point at `depth` along the view under pixel position `at` (pixel centres at ½).
Vec3 pointUnder(const Camera& camera, Index2 size, const Vec2& at, double depth) {
    const Vec3 ray = rayThrough(camera, size, at.x - 0.5, at.y - 0.5);
    return camera.eye + ray * (depth / glm::dot(ray, basisOf(camera).forward));
}

}  // namespace

Camera orbited(const Camera& camera, double azimuth, double elevation) {
    Turntable at = turntableOf(camera);
    at.azimuth += azimuth;
    at.elevation = std::clamp(at.elevation + elevation, -kPi / 2, kPi / 2);
    return placed(camera, at);
}

Camera orbitedByDrag(const Camera& camera, Index2 size, const Vec2& pixels) {
    const double turn = kPi / std::max(1, size.y);
    return orbited(camera, -pixels.x * turn, pixels.y * turn);
}

Camera panned(const Camera& camera, Index2 size, const Vec2& from, const Vec2& to, const Vec3& anchor) {
    double depth = glm::dot(anchor - camera.eye, basisOf(camera).forward);
    if (!(depth > 0)) depth = glm::distance(camera.eye, camera.target);
    const Vec3 shift = pointUnder(camera, size, from, depth) - pointUnder(camera, size, to, depth);
    Camera result = camera;
    result.eye += shift;
    result.target += shift;
    return result;
}

Camera zoomed(const Camera& camera, Index2 size, const Vec2& at, double factor, double sceneSize) {
    const double distance = glm::distance(camera.eye, camera.target);
    const double allowed = std::clamp(distance * factor, 1e-4 * sceneSize, 1e4 * sceneSize);
    const double scale = allowed / distance;
    const Vec3 fixed = pointUnder(camera, size, at, distance);
    Camera result = camera;
    result.eye = fixed + (camera.eye - fixed) * scale;
    result.target = fixed + (camera.target - fixed) * scale;
    return result;
}

double zoomFactor(double notches) {
    return std::pow(0.87, notches);
}

Camera framed(const Camera& camera, Index2 size, const Box3& box) {
    if (box.empty()) return camera;
    const double radius = std::max(0.5 * glm::length(box.size()), 1e-9);
    const double halfHeight = glm::radians(camera.fovY) / 2;
    const double halfWidth = std::atan(std::tan(halfHeight) * size.x / std::max(1, size.y));
    Camera result = camera;
    result.target = box.center();
    result.eye = result.target - basisOf(camera).forward * (radius / std::sin(std::min(halfHeight, halfWidth)));
    return result;
}

Camera standardView(const Camera& camera, StandardView view) {
    static constexpr double quarter = kPi / 2;
    const double distance = glm::distance(camera.eye, camera.target);
    switch (view) {
        case StandardView::Front:
            return placed(camera, {-quarter, 0, distance});
        case StandardView::Back:
            return placed(camera, {quarter, 0, distance});
        case StandardView::Left:
            return placed(camera, {2 * quarter, 0, distance});
        case StandardView::Right:
            return placed(camera, {0, 0, distance});
        case StandardView::Top:
            return placed(camera, {-quarter, quarter, distance});
        case StandardView::Bottom:
            return placed(camera, {-quarter, -quarter, distance});
    }
    return camera;
}

}  // namespace voledit
