#include "app/editor/navigation.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

namespace voledit {
namespace {

const Index2 kSize{800, 600};

/// Cameras all about a target, poles left out.
std::vector<Camera> cameras() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    std::vector<Camera> all;
    while (all.size() < 40) {
        const Vec3 away{u(random), u(random), u(random)};
        if (glm::length(away) < 0.1 || std::hypot(away.x, away.y) < 0.1) continue;
        Camera camera;
        camera.target = {3 * u(random), 3 * u(random), 3 * u(random)};
        camera.eye = camera.target + 25.0 * away;
        camera.fovY = 20 + 30 * std::abs(u(random));
        all.push_back(camera);
    }
    return all;
}

double distanceOf(const Camera& camera) {
    return glm::distance(camera.eye, camera.target);
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance) {
    EXPECT_LE(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Navigation, OrbitKeepsTargetAndDistance) {
    for (const Camera& camera : cameras())
        for (const double turn : {-2.0, 0.3, 1.1}) {
            const Camera after = orbited(camera, turn, 0.4 * turn);
            EXPECT_EQ(after.target, camera.target);
            EXPECT_NEAR(distanceOf(after), distanceOf(camera), 1e-9 * distanceOf(camera));
        }
}

TEST(Navigation, OrbitByNothingKeepsThePicture) {
    for (const Camera& camera : cameras()) {
        const Camera after = orbited(camera, 0, 0);
        expectNear(after.eye, camera.eye, 1e-9);
        expectNear(basisOf(after).up, basisOf(camera).up, 1e-9);
    }
}

TEST(Navigation, OrbitStopsAtThePolesAndComesBack) {
    for (const Camera& camera : cameras()) {
        const Camera top = orbited(camera, 0, 10);
        expectNear(basisOf(top).forward, {0, 0, -1}, 1e-9);
        // The picture does not turn over the pole: what is right stays right.
        expectNear(basisOf(top).right, basisOf(camera).right, 1e-6);
        const Camera back = orbited(top, 0, -0.5);
        expectNear(basisOf(back).right, basisOf(camera).right, 1e-6);
        EXPECT_GT(basisOf(back).up.z, 0);
    }
}

TEST(Navigation, TurningAtThePoleTurnsThePicture) {
    const Camera top = standardView(Camera{}, StandardView::Top);
    const Camera turned = orbited(top, 0.5, 0);
    EXPECT_NEAR(glm::dot(basisOf(top).right, basisOf(turned).right), std::cos(0.5), 1e-6);
}

TEST(Navigation, DraggingRightBringsTheLeftSideIntoView) {
    const Camera front;  // eye at −y
    EXPECT_LT(orbitedByDrag(front, kSize, {50, 0}).eye.x, -0.1);
    EXPECT_GT(orbitedByDrag(front, kSize, {0, 50}).eye.z, 0.1);
}

TEST(Navigation, PanKeepsThePointUnderThePointer) {
    for (const Camera& camera : cameras()) {
        const Vec3 anchor = camera.target + 0.2 * distanceOf(camera) * basisOf(camera).right;
        const Vec2 from = Vec2(project(camera, kSize, anchor)), to = from + Vec2(-130, 77);
        const Camera after = panned(camera, kSize, from, to, anchor);
        const Vec3 pixel = project(after, kSize, anchor);
        EXPECT_NEAR(pixel.x, to.x, 1e-6);
        EXPECT_NEAR(pixel.y, to.y, 1e-6);
        expectNear(basisOf(after).forward, basisOf(camera).forward, 1e-12);
    }
}

TEST(Navigation, ZoomKeepsThePointUnderThePointerAndScalesTheDistance) {
    for (const Camera& camera : cameras()) {
        const CameraBasis basis = basisOf(camera);
        const Vec3 point = camera.target + 0.15 * distanceOf(camera) * (basis.right - 0.5 * basis.up);
        const Vec3 before = project(camera, kSize, point);
        const Camera after = zoomed(camera, kSize, Vec2(before), 0.5, distanceOf(camera));
        const Vec3 pixel = project(after, kSize, point);
        EXPECT_NEAR(pixel.x, before.x, 1e-6);
        EXPECT_NEAR(pixel.y, before.y, 1e-6);
        EXPECT_NEAR(distanceOf(after), 0.5 * distanceOf(camera), 1e-9 * distanceOf(camera));
    }
}

TEST(Navigation, ZoomStopsShortOfTheTargetAndOfTheHorizon) {
    Camera camera;
    for (int i = 0; i < 500; ++i) camera = zoomed(camera, kSize, {400, 300}, zoomFactor(1), 10);
    EXPECT_NEAR(distanceOf(camera), 1e-3, 1e-9);
    for (int i = 0; i < 500; ++i) camera = zoomed(camera, kSize, {400, 300}, zoomFactor(-1), 10);
    EXPECT_NEAR(distanceOf(camera), 1e5, 1e-3);
}

TEST(Navigation, FrameFitsTheBoundingSphereInBothShapesOfPictures) {
    const Box3 box{{-3, 1, 2}, {9, 4, 5}};
    for (const Index2 size : {Index2(800, 600), Index2(300, 900)})
        for (const Camera& camera : cameras()) {
            const Camera after = framed(camera, size, box);
            expectNear(basisOf(after).forward, basisOf(camera).forward, 1e-9);
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 pixel = project(after, size, box.corner(corner));
                EXPECT_GT(pixel.z, 0);
                EXPECT_GE(std::min({pixel.x, pixel.y, size.x - pixel.x, size.y - pixel.y}), 0);
            }
            // The bounding sphere touches the nearer pair of the picture's sides.
            const double up = std::tan(after.fovY * kPi / 360), half = std::atan(std::min(up, up * size.x / size.y));
            EXPECT_NEAR(distanceOf(after) * std::sin(half), glm::length(box.size()) / 2, 1e-9);
        }
}

TEST(Navigation, FrameOfAnEmptyBoxIsTheCameraItself) {
    EXPECT_EQ(framed(Camera{}, kSize, Box3{}), Camera{});
}

TEST(Navigation, StandardViewsLookAlongTheAxes) {
    const Camera camera = cameras().front();
    const auto basis = [&](StandardView view) { return basisOf(standardView(camera, view)); };
    expectNear(basis(StandardView::Front).forward, {0, 1, 0}, 1e-9);
    expectNear(basis(StandardView::Front).right, {1, 0, 0}, 1e-9);
    expectNear(basis(StandardView::Back).forward, {0, -1, 0}, 1e-9);
    expectNear(basis(StandardView::Right).forward, {-1, 0, 0}, 1e-9);
    expectNear(basis(StandardView::Left).forward, {1, 0, 0}, 1e-9);
    expectNear(basis(StandardView::Top).forward, {0, 0, -1}, 1e-9);
    expectNear(basis(StandardView::Top).up, {0, 1, 0}, 1e-9);
    expectNear(basis(StandardView::Bottom).forward, {0, 0, 1}, 1e-9);
    expectNear(basis(StandardView::Bottom).right, {1, 0, 0}, 1e-9);
    EXPECT_NEAR(distanceOf(standardView(camera, StandardView::Top)), distanceOf(camera), 1e-9);
}

}  // namespace
}  // namespace voledit
