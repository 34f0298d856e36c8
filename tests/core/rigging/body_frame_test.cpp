#include "core/rigging/body_frame.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "tests/core/rigging/solids.h"

namespace voledit {
namespace {

/// All 24 ways to turn a body by right angles.
std::vector<Mat3> rightTurns() {
    std::vector<Mat3> turns;
    for (int x = 0; x < 6; ++x)
        for (int y = 0; y < 6; ++y) {
            if (x / 2 == y / 2) continue;
            Mat3 m(0.0);
            m[0][x / 2] = x % 2 ? -1 : 1;
            m[1][y / 2] = y % 2 ? -1 : 1;
            m[2] = glm::cross(m[0], m[1]);
            turns.push_back(m);
        }
    return turns;
}

std::vector<test::TaperedCapsule> turnedBy(const Mat3& turn, std::vector<test::TaperedCapsule> capsules) {
    for (auto& c : capsules) c.a = turn * c.a, c.b = turn * c.b;
    return capsules;
}

TEST(BodyFrame, FindsAPersonsLeftUpAndFrontHoweverItLies) {
    for (const double arms : {0.5, 0.75, 1.4})
        for (const Mat3& turn : rightTurns()) {
            const auto voxels = test::voxelsOf(turnedBy(turn, test::Person(arms).capsules), 0.25);
            EXPECT_EQ(bodyFrame(voxels, false).axes, turn) << arms;
        }
}

TEST(BodyFrame, TurningMakesItStand) {
    const auto upright = test::voxelsOf(test::Person().capsules, 0.25);
    for (const Mat3& turn : rightTurns()) {
        const auto voxels = test::voxelsOf(turnedBy(turn, test::Person().capsules), 0.25);
        const OpaqueVoxels body = turned(voxels, {turn});
        ASSERT_EQ(body.size, upright.size);
        EXPECT_LT(glm::length(body.origin - upright.origin), 1e-9);
        EXPECT_EQ(body.count(), voxels.count());
        // A cell stands where its turned centre does.
        for (Index3 c(1, 2, 3); c.x < body.size.x; c += Index3(5, 7, 3)) {
            if (c.y >= body.size.y || c.z >= body.size.z) break;
            const Vec3 p = turn * body.centre(c);
            const Index3 from = Index3(glm::round((p - voxels.origin) / voxels.spacing));
            EXPECT_EQ(body.opaque[body.indexOf(c)], voxels.opaque[voxels.indexOf(from)]);
        }
    }
}

TEST(BodyFrame, SymmetryIsWholeAcrossTheMiddleOnly) {
    const auto voxels = test::voxelsOf(test::Person().capsules, 0.2);
    EXPECT_GT(mirrorSymmetry(voxels, 0), 0.99);
    EXPECT_LT(mirrorSymmetry(voxels, 1), 0.6);
    EXPECT_LT(mirrorSymmetry(voxels, 2), 0.95);
}

TEST(BodyFrame, PartsAreCountedAcrossCorners) {
    OpaqueVoxels voxels{{4, 4, 1}, Vec3(0), Vec3(1), std::vector<std::uint8_t>(16, 0)};
    for (const Index3& c : {Index3(0, 0, 0), Index3(1, 1, 0), Index3(3, 0, 0), Index3(3, 3, 0)})
        voxels.opaque[voxels.indexOf(c)] = 1;
    const auto parts = partsOf(voxels, Index3(0), voxels.size - 1, 1);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].cells, 2u);
    EXPECT_EQ(parts[0].mean, Vec3(0.5, 0.5, 0));
    EXPECT_EQ(partsOf(voxels, Index3(0), voxels.size - 1, 2).size(), 1u);
    EXPECT_EQ(partsOf(voxels, Index3(3, 3, 0), Index3(3, 3, 0), 1).size(), 1u);
}

}  // namespace
}  // namespace voledit
