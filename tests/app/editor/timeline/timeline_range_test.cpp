#include "app/editor/timeline/timeline_range.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

TimelineRange hundred() {
    return {.first = 0, .last = 100, .left = 50, .width = 500};
}

TEST(TimelineRange, PixelsAndFramesAreInverse) {
    const TimelineRange range = hundred();
    EXPECT_DOUBLE_EQ(range.pixelOf(0), 50);
    EXPECT_DOUBLE_EQ(range.pixelOf(100), 550);
    for (const double frame : {-10.0, 0.5, 33.3}) EXPECT_NEAR(range.frameAt(range.pixelOf(frame)), frame, 1e-12);
}

TEST(TimelineRange, ZoomKeepsWhatIsUnderThePointer) {
    TimelineRange range = hundred();
    for (const double factor : {1.2, 0.5, 3.0}) {
        const double frame = range.frameAt(180);
        range = zoomedRange(range, 180, factor);
        EXPECT_NEAR(range.frameAt(180), frame, 1e-9);
    }
    EXPECT_NEAR(range.last - range.first, 180, 1e-9);
    // It ends somewhere.
    for (int n = 0; n < 200; ++n) range = zoomedRange(range, 180, 0.5);
    EXPECT_GE(range.last - range.first, 2);
    for (int n = 0; n < 400; ++n) range = zoomedRange(range, 180, 2);
    EXPECT_LE(range.last - range.first, 1e7);
    EXPECT_TRUE(std::isfinite(range.first) && range.first < range.last);
}

TEST(TimelineRange, PanMovesAllByTheSame) {
    const TimelineRange moved = pannedRange(hundred(), 100, 150);
    EXPECT_NEAR(moved.pixelOf(20), hundred().pixelOf(20) + 50, 1e-9);
    EXPECT_NEAR(moved.pixelsPerFrame(), hundred().pixelsPerFrame(), 1e-12);
}

TEST(TimelineRange, FramingAndRevealing) {
    const TimelineRange framed = framedRange(hundred(), 200, 300);
    EXPECT_LT(framed.first, 200);
    EXPECT_GT(framed.last, 300);
    EXPECT_LT(framed.last - framed.first, 120);
    EXPECT_EQ(revealedRange(hundred(), 50), hundred());
    const TimelineRange right = revealedRange(hundred(), 250);
    EXPECT_GT(right.last, 250);
    EXPECT_NEAR(right.last - right.first, 100, 1e-9);
    EXPECT_LT(revealedRange(hundred(), -30).first, -30);
}

TEST(TimelineRange, MarksAreRoundNumbersFarEnoughApart) {
    for (const double length : {2.0, 7.0, 30.0, 48.0, 1000.0, 123456.0}) {
        TimelineRange range = hundred();
        range.last = length;
        const RulerMarks marks = rulerMarks(range, 50);
        EXPECT_GE(marks.step * range.pixelsPerFrame(), 50 - 1e-9);
        // No finer step would do.
        if (marks.step > 1) {
            EXPECT_LT(0.5 * marks.step * range.pixelsPerFrame(), 50 * 1.3);
        }
        int leading = marks.step;
        while (leading % 10 == 0) leading /= 10;
        EXPECT_TRUE(leading == 1 || leading == 2 || leading == 5) << marks.step;
        EXPECT_EQ(marks.step % marks.parts, 0);
        ASSERT_FALSE(marks.frames.empty());
        EXPECT_EQ(marks.frames.front(), 0);
        for (std::size_t n = 1; n < marks.frames.size(); ++n)
            EXPECT_EQ(marks.frames[n] - marks.frames[n - 1], marks.step);
    }
}

}  // namespace
}  // namespace voledit
