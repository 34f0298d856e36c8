#include "app/animation/frame_range.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace voledit {
namespace {

TEST(FrameRange, ReadsBothEndsIncludedAndNegativeNumbers) {
    EXPECT_EQ(parseFrameRange("0-47"), (FrameRange{0, 47}));
    EXPECT_EQ(parseFrameRange("0-47").count(), 48);
    EXPECT_EQ(parseFrameRange("7"), (FrameRange{7, 7}));
    EXPECT_EQ(parseFrameRange("-5--1"), (FrameRange{-5, -1}));
    EXPECT_EQ(parseFrameRange("-5-2"), (FrameRange{-5, 2}));
    EXPECT_EQ(parseFrameRange("-3"), (FrameRange{-3, -3}));
}

TEST(FrameRange, RefusesWhatIsNoRange) {
    for (const char* text : {"", "-", "a", "1-", "1-b", "5-4", "1..4", "0-1-2", " 1-2", "1-2 ", "0x1-3", "1.5-2",
                             "99999999999", "0-1000000", "-1000000000-1000000000"})
        EXPECT_THROW(parseFrameRange(text), Error) << text;
    EXPECT_EQ(parseFrameRange("0-999999").count(), kMostFrames);
}

TEST(FrameRange, TimelinesEndIsExclusive) {
    EXPECT_EQ(framesOf({.fps = 24, .start = 0, .end = 48}, 24), (FrameRange{0, 47}));
    EXPECT_EQ(framesOf({.fps = 24, .start = -12, .end = 12}, 24), (FrameRange{-12, 11}));
}

TEST(FrameRange, AnotherRateCoversTheSameTime) {
    const Timeline timeline{.fps = 24, .start = 24, .end = 72};
    EXPECT_EQ(framesOf(timeline, 12), (FrameRange{12, 35}));
    EXPECT_EQ(framesOf(timeline, 30), (FrameRange{30, 89}));
    // 1 s … 3 s at 10.5 a second: the frames 11 (1.048 s) … 31 (2.952 s).
    EXPECT_EQ(framesOf(timeline, 10.5), (FrameRange{11, 31}));
    // Rates that binary numbers do not hold exactly.
    EXPECT_EQ(framesOf({.fps = 29.97, .start = 0, .end = 2997}, 29.97), (FrameRange{0, 2996}));
}

TEST(FrameRange, RefusesTimelinesWithoutFrames) {
    EXPECT_THROW(framesOf({.fps = 24, .start = 10, .end = 10}, 24), Error);
    EXPECT_THROW(framesOf({.fps = 1000, .start = 1, .end = 2}, 1), Error);
    EXPECT_THROW(framesOf({.fps = 1e-9, .start = 0, .end = 48}, 24), Error);
}

}  // namespace
}  // namespace voledit
