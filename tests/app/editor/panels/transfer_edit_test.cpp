#include "app/editor/panels/transfer_edit.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

PiecewiseLinear ramp() {
    return {{{0, 0}, {10, 0.5}, {20, 1}}};
}
ColorTable colors() {
    return {{{0, Vec3(0)}, {10, Vec3(1, 0, 0)}, {20, Vec3(1)}}};
}

TEST(TransferEdit, InsertedPointsKeepTheOrder) {
    PiecewiseLinear table = ramp();
    EXPECT_EQ(insertPoint(table, {15, 0.2}), 2u);
    EXPECT_EQ(insertPoint(table, {-5, 2}), 0u);
    EXPECT_EQ(insertPoint(table, {99, -1}), 5u);
    EXPECT_EQ(table.points, (std::vector<Vec2>{{-5, 1}, {0, 0}, {10, 0.5}, {15, 0.2}, {20, 1}, {99, 0}}));
}

TEST(TransferEdit, AMovedPointStaysBetweenItsNeighboursAndWithinTheRange) {
    PiecewiseLinear table = ramp();
    movePoint(table, 1, {25, 1.5});
    EXPECT_EQ(table.points[1], Vec2(20, 1));
    movePoint(table, 1, {-3, -0.5});
    EXPECT_EQ(table.points[1], Vec2(0, 0));
    movePoint(table, 2, {500, 0.25});
    EXPECT_EQ(table.points[2], Vec2(500, 0.25));
    movePoint(table, 7, {1, 1});
    EXPECT_EQ(table.points.size(), 3u);
}

TEST(TransferEdit, TheLastPointStays) {
    PiecewiseLinear table = ramp();
    EXPECT_TRUE(removePoint(table, 1));
    EXPECT_TRUE(removePoint(table, 0));
    EXPECT_FALSE(removePoint(table, 0));
    EXPECT_EQ(table.points, (std::vector<Vec2>{{20, 1}}));
    ColorTable stops = colors();
    EXPECT_FALSE(removeStop(stops, 9));
    EXPECT_TRUE(removeStop(stops, 2));
    EXPECT_TRUE(removeStop(stops, 0));
    EXPECT_FALSE(removeStop(stops, 0));
}

TEST(TransferEdit, AnInsertedStopChangesNoColour) {
    const ColorTable before = colors();
    ColorTable after = before;
    EXPECT_EQ(insertStop(after, 4), 1u);
    for (double x = -5; x <= 25; x += 0.5)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(after(x)[c], before(x)[c], 1e-12);
    moveStop(after, 1, 30);
    EXPECT_EQ(after.points[1].value, 10);
}

TEST(TransferEdit, ShiftingMovesTheFunctionAlongTheValues) {
    const TransferFunction before{colors(), ramp(), {{{1, 0}, {2, 1}}}};
    const TransferFunction after = shifted(before, 7.5);
    for (double x = -5; x <= 25; x += 0.5) {
        EXPECT_DOUBLE_EQ(after.opacity(x + 7.5), before.opacity(x));
        EXPECT_DOUBLE_EQ(after.color(x + 7.5).x, before.color(x).x);
    }
    EXPECT_EQ(after.gradientOpacity, before.gradientOpacity);
    EXPECT_EQ(rangeOf(after), (ValueRange{7.5, 27.5}));
}

TEST(TransferEdit, ZoomKeepsTheFixedValueInPlace) {
    const ValueRange after = zoomed({0, 100}, 25, 0.5, 1, 1000);
    EXPECT_EQ(after, (ValueRange{12.5, 62.5}));
    EXPECT_DOUBLE_EQ(zoomed({0, 100}, 25, 1e-9, 1, 1000).size(), 1);
    EXPECT_DOUBLE_EQ(zoomed({0, 100}, 25, 1e9, 1, 1000).size(), 1000);
}

TEST(TransferEdit, NiceStepsAreOneTwoFive) {
    EXPECT_DOUBLE_EQ(niceStep(100, 4), 20);
    EXPECT_DOUBLE_EQ(niceStep(4096, 4), 1000);
    EXPECT_DOUBLE_EQ(niceStep(0.9, 4), 0.2);
    EXPECT_DOUBLE_EQ(niceStep(2.1, 4), 0.5);
}

}  // namespace
}  // namespace voledit
