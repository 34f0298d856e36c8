#include "app/editor/tools/joint_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>

namespace voledit {
namespace {

// A joint's x to the right, y towards the eye, z up.
const Mat3 kFront(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0));

Vec2 around(double degrees) {
    return Vec2(400, 300) + 80.0 * Vec2(std::cos(degrees * kPi / 180), -std::sin(degrees * kPi / 180));
}

TEST(JointTurn, FollowsThePointerRoundThePivotPastAHalfTurn) {
    JointTurn turn({400, 300}, around(20), kFront, std::nullopt);
    for (int degrees = 30; degrees <= 560; degrees += 10) turn.follow(around(degrees), false, false);
    EXPECT_NEAR(turn.degrees(), 540, 1e-9);
    EXPECT_EQ(turn.readout(), "Rotate 540.0°");
}

TEST(JointTurn, AnAxisTowardsTheEyeTurnsAlikeOneAwayTheOtherWay) {
    JointTurn towards({400, 300}, around(0), kFront, 1);
    towards.follow(around(25), false, false);
    EXPECT_NEAR(towards.degrees(), 25, 1e-9);
    JointTurn away({400, 300}, around(0), Mat3(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0)), 1);
    away.follow(around(25), false, false);
    EXPECT_NEAR(away.degrees(), -25, 1e-9);
}

TEST(JointTurn, ARingSeenEdgeOnIsDraggedAlong) {
    // About x (to the right): the nearest point of the ring goes down where it turns positively.
    JointTurn turn({400, 300}, {400, 300}, kFront, 0);
    turn.follow({400, 300 + 10}, false, false);
    EXPECT_NEAR(turn.degrees(), 0.5 * 180 / kPi, 1e-9);  // 10 of 20 pixels
    EXPECT_EQ(turn.axis(), 0);
}

TEST(JointTurn, KeysLockAxesAndTypeDegrees) {
    JointTurn turn({400, 300}, around(0), kFront, std::nullopt);
    EXPECT_TRUE(turn.key("Y"));
    for (const char* key : {"4", "5", ".", "5", "-"}) EXPECT_TRUE(turn.key(key));
    EXPECT_EQ(turn.degrees(), -45.5);
    EXPECT_EQ(turn.readout(), "Rotate Y -45.5_°");
    EXPECT_TRUE(turn.key("Backspace"));
    EXPECT_EQ(turn.degrees(), -45);
    EXPECT_TRUE(turn.key("Y"));
    EXPECT_EQ(turn.axis(), std::nullopt);
    EXPECT_FALSE(turn.key("Left"));
    EXPECT_FALSE(turn.key("Q"));
}

TEST(JointTurn, ShiftSlowsDownAndCtrlTurnsBySteps) {
    JointTurn turn({400, 300}, around(0), kFront, std::nullopt);
    turn.follow(around(40), true, false);
    EXPECT_NEAR(turn.degrees(), 4, 1e-9);
    turn.follow(around(80), false, true);
    EXPECT_NEAR(turn.degrees(), 45, 1e-9);  // 44, by steps of 5
    turn.follow(around(84), true, true);
    EXPECT_NEAR(turn.degrees(), 44, 1e-9);  // 44.4, by steps of 1
}

}  // namespace
}  // namespace voledit
