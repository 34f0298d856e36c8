#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/stf/affine.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

/// Radians between two rotations; exact for small angles.
double angleBetween(const Quat& a, const Quat& b) {
    const Quat c = glm::dot(a, b) < 0 ? -b : b;
    return 4 * std::asin(std::min(1.0, glm::length(a + -c) / 2));
}

TEST(Rotations, DegreesTurnAsPlacesDo) {
    Random random(1);
    for (int n = 0; n < 200; ++n) {
        const Vec3 degrees = randomVector(random, 400);
        const Mat3 expected(placementMatrix(Vec3(0), degrees * (kPi / 180), Vec3(1)));
        const Mat3 turned = glm::mat3_cast(quatOfDegrees(degrees));
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(turned[c] - expected[c]), 1e-14);
    }
}

TEST(Rotations, DegreesComeBack) {
    EXPECT_EQ(degreesOf(Quat(1, 0, 0, 0)), Vec3(0));
    Random random(2);
    for (int n = 0; n < 500; ++n) {
        const Vec3 degrees(randomNumber(random, -180, 180), randomNumber(random, -89, 89),
                           randomNumber(random, -180, 180));
        EXPECT_LT(glm::length(degreesOf(quatOfDegrees(degrees)) - degrees), 1e-11);
        EXPECT_LT(glm::length(degreesOf(-quatOfDegrees(degrees)) - degrees), 1e-11);
    }
    for (const double a : {-180.0, -90.0, -1e-9, 0.0, 1e-9, 30.0, 90.0, 179.999999})
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == 1 && std::abs(a) > 90) continue;
            Vec3 degrees(0);
            degrees[axis] = a;
            const Vec3 back = degreesOf(quatOfDegrees(degrees));
            for (int b = 0; b < 3; ++b) EXPECT_NEAR(std::remainder(back[b] - degrees[b], 360), 0, 1e-13);
        }
}

TEST(Rotations, DegreesNameEveryRotationAlsoInGimbalLock) {
    Random random(3);
    for (int n = 0; n < 2000; ++n) {
        Quat rotation = randomRotation(random);
        if (n % 2 == 0) {
            // About y by 90° or nearly so.
            const double near = n % 4 == 0 ? 0 : std::pow(10, randomNumber(random, -16, -1));
            rotation = quatOfDegrees(
                {randomNumber(random, -180, 180), n % 3 ? 90 - near : near - 90, randomNumber(random, -180, 180)});
        }
        const Vec3 degrees = degreesOf(rotation);
        for (const int axis : {0, 2}) EXPECT_LE(std::abs(degrees[axis]), 180);
        EXPECT_LE(std::abs(degrees.y), 90);
        EXPECT_LT(angleBetween(quatOfDegrees(degrees), rotation), 1e-11);
    }
}

TEST(Rotations, ShortestArcCarriesOneDirectionToTheOther) {
    Random random(4);
    for (int n = 0; n < 500; ++n) {
        const Vec3 a = randomVector(random, 3);
        // Also nearly alike and nearly opposite ones.
        const double apart = std::pow(10, randomNumber(random, -17, 1));
        const Vec3 b = (n % 2 ? 1.0 : -2.0) * a + apart * randomVector(random, 1);
        const Quat arc = shortestArc(a, b);
        EXPECT_NEAR(glm::length(arc), 1, 1e-15);
        EXPECT_LT(glm::length(arc * glm::normalize(a) - glm::normalize(b)), 1e-11) << n;
        // Its axis lies across both: no twist.
        EXPECT_LT(std::abs(glm::dot(Vec3(arc.x, arc.y, arc.z), glm::normalize(a))), 1e-14);
    }
    EXPECT_EQ(shortestArc({0, 0, 2}, {0, 0, 5}), Quat(1, 0, 0, 0));
    EXPECT_LT(glm::length(shortestArc({1, 2, 3}, {-1, -2, -3}) * Vec3(1, 2, 3) + Vec3(1, 2, 3)), 1e-14);
}

TEST(Rotations, SlerpTakesTheShorterWayAtConstantSpeed) {
    const Quat a = quatOfDegrees({0, 0, 10}), b = quatOfDegrees({0, 0, 70});
    for (const double s : {0.0, 0.25, 0.5, 1.0}) {
        EXPECT_LT(angleBetween(slerped(a, b, s), quatOfDegrees({0, 0, 10 + 60 * s})), 1e-15);
        EXPECT_LT(angleBetween(slerped(a, -b, s), quatOfDegrees({0, 0, 10 + 60 * s})), 1e-15);
    }
    const Quat close = quatOfDegrees({0, 0, 10 + 1e-10});
    EXPECT_LT(angleBetween(slerped(a, close, 0.5), quatOfDegrees({0, 0, 10 + 5e-11})), 1e-15);
    Random random(5);
    for (int n = 0; n < 100; ++n) {
        const Quat from = randomRotation(random), to = randomRotation(random);
        const double s = randomNumber(random, 0, 1);
        EXPECT_LT(angleBetween(slerped(from, to, s), glm::slerp(from, to, s)), 1e-13);
    }
}

}  // namespace
}  // namespace voledit
