#include "app/editor/tools/point_move.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace voledit {
namespace {

const Index2 kSize{800, 600};
const Camera kCamera{{60, -400, 150}, {0, 0, 0}, {0, 0, 1}, 35};
const Vec3 kAnchor{20, -15, 30};

Vec2 pixelOf(const Vec3& p) {
    return Vec2(project(kCamera, kSize, p));
}

PointMove grabbedAtThePoint() {
    return PointMove(kAnchor, kCamera, kSize, pixelOf(kAnchor));
}

TEST(PointMove, ThePointStaysUnderThePointerInThePlaneOfTheView) {
    const Vec3 forward = basisOf(kCamera).forward;
    for (const Vec2& to : {Vec2(10, 20), Vec2(400, 300), Vec2(790, 590), Vec2(-50, 700)}) {
        PointMove move = grabbedAtThePoint();
        move.follow(to, false);
        const Vec2 pixel = pixelOf(kAnchor + move.offset());
        EXPECT_NEAR(pixel.x, to.x, 1e-6);
        EXPECT_NEAR(pixel.y, to.y, 1e-6);
        EXPECT_NEAR(glm::dot(move.offset(), forward), 0, 1e-9);
    }
}

TEST(PointMove, AGrabBesideThePointKeepsItsDistance) {
    const Vec2 beside = pixelOf(kAnchor) + Vec2(5, -3);
    PointMove move(kAnchor, kCamera, kSize, beside);
    EXPECT_NEAR(glm::length(move.offset()), 0, 1e-9);
    move.follow(beside + Vec2(100, 40), false);
    const Vec2 expected = pixelOf(kAnchor) + Vec2(100, 40);
    EXPECT_NEAR(glm::distance(pixelOf(kAnchor + move.offset()), expected), 0, 1e-6);
}

TEST(PointMove, LockedToAnAxisItMovesAlongItNearestToThePointer) {
    const char* names[] = {"X", "Y", "Z"};
    for (int a = 0; a < 3; ++a) {
        PointMove move = grabbedAtThePoint();
        ASSERT_TRUE(move.key(names[a]));
        EXPECT_EQ(move.axis(), a);
        Vec3 along(0);
        along[a] = 1;
        // A pointer beside the axis, off the point of distance 25: the foot of its perpendicular on screen counts.
        const Vec2 on = pixelOf(kAnchor + 25.0 * along);
        const Vec2 direction = glm::normalize(pixelOf(kAnchor + along) - pixelOf(kAnchor));
        move.follow(on + 30.0 * Vec2(-direction.y, direction.x), false);
        EXPECT_NEAR(glm::distance(move.offset(), 25.0 * along), 0, 1e-6) << names[a];
    }
}

TEST(PointMove, TheSameKeyFreesTheAxisAgain) {
    PointMove move = grabbedAtThePoint();
    move.key("X");
    move.key("Z");
    EXPECT_EQ(move.axis(), 2);
    move.key("Z");
    EXPECT_EQ(move.axis(), std::nullopt);
}

TEST(PointMove, BeyondAnAxisVanishingPointItDoesNotTurnBack) {
    PointMove move = grabbedAtThePoint();
    move.key("Y");
    const Vec2 direction = pixelOf(kAnchor + Vec3(0, 1, 0)) - pixelOf(kAnchor);
    double before = 0;
    for (double steps = 10; steps < 1e6; steps *= 3) {
        PointMove further = move;
        further.follow(pixelOf(kAnchor) + steps * direction, false);
        EXPECT_GE(further.offset().y, before);
        before = further.offset().y;
    }
    EXPECT_GT(before, 1000);
}

TEST(PointMove, AlongTheViewUpAndDownMoveFarAndNear) {
    const Camera front{{0, -100, 0}, {0, 0, 0}, {0, 0, 1}, 30};
    const Vec3 anchor{0, 5, 0};
    PointMove move(anchor, front, kSize, {400, 300});
    move.key("Y");
    move.follow({400, 260}, false);
    EXPECT_GT(move.offset().y, 1);
    move.follow({400, 340}, false);
    EXPECT_LT(move.offset().y, -1);
}

TEST(PointMove, SlowMovesATenthOfTheWay) {
    const Vec2 start = pixelOf(kAnchor);
    PointMove move = grabbedAtThePoint();
    move.follow(start + Vec2(100, 0), true);
    EXPECT_NEAR(glm::distance(pixelOf(kAnchor + move.offset()), start + Vec2(10, 0)), 0, 1e-6);
    move.follow(start + Vec2(150, 0), false);
    EXPECT_NEAR(glm::distance(pixelOf(kAnchor + move.offset()), start + Vec2(60, 0)), 0, 1e-6);
}

TEST(PointMove, TypedNumbersAreExactDistancesAlongTheAxis) {
    PointMove move = grabbedAtThePoint();
    move.follow({100, 100}, false);
    move.key("Z");
    for (const char* key : {"1", "2", ".", "5"}) ASSERT_TRUE(move.key(key));
    EXPECT_EQ(move.offset(), Vec3(0, 0, 12.5));
    move.key("-");
    EXPECT_EQ(move.offset(), Vec3(0, 0, -12.5));
    move.key("-");
    move.key("Backspace");
    EXPECT_EQ(move.offset(), Vec3(0, 0, 12));
    EXPECT_EQ(move.readout(), "Z 12._");
    for (int i = 0; i < 3; ++i) move.key("Backspace");
    EXPECT_NE(move.offset(), Vec3(0, 0, 12));  // the pointer leads again
}

TEST(PointMove, WithoutALockTypedNumbersGoAlongX) {
    PointMove move = grabbedAtThePoint();
    for (const char* key : {"-", "3"}) move.key(key);
    EXPECT_EQ(move.offset(), Vec3(-3, 0, 0));
}

TEST(PointMove, AnUnfinishedNumberIsNoDistance) {
    PointMove move = grabbedAtThePoint();
    move.key("-");
    EXPECT_EQ(move.offset(), Vec3(0));
    for (const char* key : {".", ".", "5"}) EXPECT_TRUE(move.key(key));
    EXPECT_EQ(move.offset(), Vec3(-0.5, 0, 0));
    EXPECT_FALSE(move.key("Q"));
    EXPECT_FALSE(move.key("Enter"));
}

}  // namespace
}  // namespace voledit
