#include "core/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voledit {
namespace {

const Camera kCamera{Vec3(10, -40, 25), Vec3(1, 2, 3), Vec3(0.1, 0.2, 1), 35};

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Camera, BasisIsOrthonormalAndRightHanded) {
    const CameraBasis b = basisOf(kCamera);
    expectNear(b.forward, glm::normalize(kCamera.target - kCamera.eye));
    expectNear(glm::cross(b.right, b.up), -b.forward);
    EXPECT_NEAR(glm::dot(b.right, kCamera.up), 0, 1e-12);
    EXPECT_GT(glm::dot(b.up, kCamera.up), 0);
    const CameraBasis front = basisOf({Vec3(0, -4, 0), Vec3(0), Vec3(0, 0, 1), 30});
    expectNear(front.right, {1, 0, 0});
    expectNear(front.up, {0, 0, 1});
}

TEST(Camera, AnUpAlongTheViewIsReplaced) {
    for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 0, -2), Vec3(0)}) {
        const CameraBasis b = basisOf({Vec3(0, 0, 10), Vec3(0), up, 30});
        EXPECT_NEAR(glm::length(b.up), 1, 1e-12);
        EXPECT_NEAR(glm::dot(b.up, b.forward), 0, 1e-12);
    }
    EXPECT_NEAR(glm::length(basisOf({Vec3(1), Vec3(1), Vec3(0, 1, 0), 30}).up), 1, 1e-12) << "eye on the target";
}

TEST(Camera, ProjectionUndoesRays) {
    const Index2 size(640, 480);
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {319.5, 239.5}, {639.0, 2.0}, {17.25, 400.5}}) {
        const Vec3 direction = rayThrough(kCamera, size, x, y);
        EXPECT_NEAR(glm::length(direction), 1, 1e-15);
        const Vec3 pixel = project(kCamera, size, kCamera.eye + 37.0 * direction);
        EXPECT_NEAR(pixel.x, x + 0.5, 1e-9);
        EXPECT_NEAR(pixel.y, y + 0.5, 1e-9);
        EXPECT_NEAR(pixel.z, 37 * glm::dot(direction, basisOf(kCamera).forward), 1e-9);
    }
    EXPECT_LT(project(kCamera, size, kCamera.eye - basisOf(kCamera).forward).z, 0);
}

TEST(Camera, TheFieldOfViewIsVerticalAndRowsRunDown) {
    const Camera camera{Vec3(0, -10, 0), Vec3(0), Vec3(0, 0, 1), 90};
    // 45° up is the upper edge of the picture, which is y = 0.
    EXPECT_NEAR(project(camera, {300, 200}, {0, 0, 10}).y, 0, 1e-9);
    EXPECT_NEAR(project(camera, {300, 200}, {15, 0, 0}).x, 300, 1e-9);
}

TEST(Camera, FitsTheBoundingSphereFromTheFront) {
    const Box3 bounds{Vec3(1, 2, 3), Vec3(5, 10, 4)};
    const double radius = glm::length(Vec3(4, 8, 1)) / 2;
    for (const double aspect : {1.5, 1.0, 0.6}) {
        const Camera camera = fittingCamera(bounds, aspect);
        EXPECT_EQ(camera.target, bounds.center());
        EXPECT_EQ(camera.fovY, 30);
        EXPECT_EQ(camera.up, Vec3(0, 0, 1));
        EXPECT_LT(camera.eye.y, bounds.min.y);
        EXPECT_EQ(camera.eye.x, camera.target.x);
        EXPECT_EQ(camera.eye.z, camera.target.z);
        // The ray at the middle of the nearest side just touches the sphere.
        const double half = std::min(glm::radians(15.0), std::atan(std::tan(glm::radians(15.0)) * aspect));
        EXPECT_NEAR(glm::length(camera.eye - camera.target) * std::sin(half), radius, 1e-12);
    }
    EXPECT_TRUE(std::isfinite(fittingCamera({}, 1).eye.y));
    EXPECT_NE(fittingCamera({Vec3(1), Vec3(1)}, 1).eye, Vec3(1));
}

}  // namespace
}  // namespace voledit
