#include "core/skeleton/best_rotation.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "random_skeletons.h"

namespace voledit {
namespace {

double angle(const Quat& a, const Quat& b) {
    return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

TEST(BestRotation, FindsASimilaritysRotation) {
    Random random(1);
    for (int n = 0; n < 200; ++n) {
        const Quat turn = randomRotation(random);
        std::vector<Vec3> from, to;
        for (int i = 0; i < 3 + n % 5; ++i) {
            from.push_back(randomVector(random, 2));
            to.push_back(3.0 * (turn * from.back()) + Vec3(5, 6, 7));
        }
        const BestRotation best = bestRotation(from, to);
        EXPECT_LT(angle(best.rotation, turn), 1e-6);
        EXPECT_NEAR(best.likeness, 1, 1e-12);
    }
}

TEST(BestRotation, NoOtherRotationIsBetter) {
    Random random(2);
    for (int n = 0; n < 50; ++n) {
        std::vector<Vec3> from, to;
        for (int i = 0; i < 6; ++i) from.push_back(randomVector(random, 1)), to.push_back(randomVector(random, 1));
        const BestRotation best = bestRotation(from, to);
        EXPECT_LE(best.likeness, 1.0);
        for (int k = 0; k < 20; ++k) {
            // Moving the points by a small turn first cannot help.
            const Quat small = glm::angleAxis(0.05, glm::normalize(randomVector(random, 1)));
            std::vector<Vec3> turned;
            double sum = 0, before = 0;
            Vec3 meanFrom(0), meanTo(0);
            for (int i = 0; i < 6; ++i) meanFrom += from[std::size_t(i)] / 6.0, meanTo += to[std::size_t(i)] / 6.0;
            for (std::size_t i = 0; i < 6; ++i) {
                const Vec3 a = from[i] - meanFrom, b = to[i] - meanTo;
                before += glm::dot(b, best.rotation * a);
                sum += glm::dot(b, small * (best.rotation * a));
            }
            EXPECT_GT(before, sum - 1e-8);
        }
    }
}

TEST(BestRotation, WhatThePointsLeaveOpenStaysAsItIs) {
    const std::vector<Vec3> line{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}};
    EXPECT_LT(angle(bestRotation(line, line).rotation, Quat(1, 0, 0, 0)), 1e-6);
    EXPECT_EQ(bestRotation({Vec3(1)}, {Vec3(2)}).rotation, Quat(1, 0, 0, 0));
    EXPECT_EQ(bestRotation({}, {}).likeness, 0.0);
    EXPECT_EQ(bestRotation({Vec3(1), Vec3(1)}, {Vec3(1), Vec3(2)}).likeness, 0.0);
}

}  // namespace
}  // namespace voledit
