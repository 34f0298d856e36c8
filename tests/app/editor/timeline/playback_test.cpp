#include "app/editor/timeline/playback.h"

#include <gtest/gtest.h>

#include <vector>

namespace voledit {
namespace {

const Timeline kTen{.fps = 10, .start = 0, .end = 20};  // frames 0 … 19, two seconds

TEST(Frames, LieWhereTheirTimesAre) {
    EXPECT_EQ(frameCount(kTen), 20);
    EXPECT_EQ(frameCount({.fps = 10, .start = 5, .end = 5}), 1);
    EXPECT_EQ(timeOfFrame(5, kTen), 0.5);
    EXPECT_EQ(nearestFrame(0.349, kTen), 3);
    EXPECT_EQ(nearestFrame(0.351, kTen), 4);
    EXPECT_EQ(frameAt(0.399, kTen), 3);
    EXPECT_EQ(frameAt(-0.01, kTen), -1);
    // Whatever the sums of binary fractions are: each frame's time is that frame.
    for (const double fps : {23.976, 24.0, 29.97, 30.0, 60.0, 7.0})
        for (int frame = -1000; frame < 1000; ++frame) {
            const Timeline timeline{.fps = fps, .start = 0, .end = 10};
            ASSERT_EQ(frameAt(timeOfFrame(frame, timeline), timeline), frame) << fps;
            ASSERT_EQ(nearestFrame(timeOfFrame(frame, timeline), timeline), frame) << fps;
        }
}

TEST(Frames, StepsGoToTheNextOneThatWay) {
    EXPECT_DOUBLE_EQ(steppedTime(0.3, 1, kTen), 0.4);
    EXPECT_DOUBLE_EQ(steppedTime(0.3, -1, kTen), 0.2);
    EXPECT_DOUBLE_EQ(steppedTime(0.35, 1, kTen), 0.4);
    EXPECT_DOUBLE_EQ(steppedTime(0.35, -1, kTen), 0.3);
    EXPECT_DOUBLE_EQ(steppedTime(0.35, -3, kTen), 0.1);
    EXPECT_DOUBLE_EQ(steppedTime(0.35, 0, kTen), 0.35);
    double t = 0;
    for (int n = 0; n < 1000; ++n) t = steppedTime(t, 1, {.fps = 29.97, .start = 0, .end = 10});
    EXPECT_NEAR(t, 1000 / 29.97, 1e-9);
}

TEST(Playback, ShowsWholeFramesByTheClock) {
    Playback playback;
    playback.start(0, kTen);
    std::vector<int> frames;
    for (int n = 0; n < 30; ++n) frames.push_back(nearestFrame(playback.advance(1.0 / 60, kTen), kTen));
    // Six pictures of 1/60 s a frame.
    for (int n = 0; n < 30; ++n) EXPECT_EQ(frames[std::size_t(n)], (n + 1) / 6) << n;
    EXPECT_EQ(playback.dropped(), 0);
}

TEST(Playback, LeavesOutFramesThatComeTooLateAndKeepsTime) {
    Playback playback;
    playback.start(0, kTen);
    double clock = 0;
    for (const double seconds : {0.25, 0.1, 0.43, 0.02, 0.3}) {
        clock += seconds;
        EXPECT_EQ(nearestFrame(playback.advance(seconds, kTen), kTen), int(clock * 10 + 1e-6)) << clock;
    }
    // Frames 2, 3, 7, 8 (0.80), 11 were shown: 11 steps, of which 1, 4, 5, 6, 9, 10 are missing; 0.80 is frame 8.
    EXPECT_EQ(playback.dropped(), 11 - 5);
}

TEST(Playback, LoopsWithoutLosingTime) {
    Playback playback;
    playback.start(1.5, kTen);
    double shown = 0;
    for (int n = 0; n < 7; ++n) shown = playback.advance(0.1, kTen);
    EXPECT_NEAR(shown, 0.2, 1e-9);  // 1.5 + 0.7 − 2
    EXPECT_EQ(playback.dropped(), 0);
    shown = playback.advance(2 * 100 + 0.5, kTen);  // a hundred rounds and five frames
    EXPECT_NEAR(shown, 0.7, 1e-6);
    EXPECT_EQ(playback.dropped(), 2005 - 1);
    EXPECT_TRUE(playback.playing());
}

TEST(Playback, LoopsBetweenTheRangesEnds) {
    const Timeline part{.fps = 10, .start = 5, .end = 8};
    Playback playback;
    playback.start(0, part);  // before the range: from its first frame
    std::vector<int> frames;
    for (int n = 0; n < 7; ++n) frames.push_back(nearestFrame(playback.advance(0.1, part), part));
    EXPECT_EQ(frames, (std::vector<int>{6, 7, 5, 6, 7, 5, 6}));
}

TEST(Playback, StopsAtTheLastFrameWithoutLoop) {
    Playback playback;
    playback.loop = false;
    playback.start(1.7, kTen);
    EXPECT_NEAR(playback.advance(0.1, kTen), 1.8, 1e-9);
    EXPECT_NEAR(playback.advance(5, kTen), 1.9, 1e-9);
    EXPECT_FALSE(playback.playing());
    playback.start(1.9, kTen);  // from the end it begins anew
    EXPECT_NEAR(playback.advance(0.1, kTen), 0.1, 1e-9);
}

TEST(Playback, GoesOnFromWhereItWasScrubbedTo) {
    Playback playback;
    playback.start(0, kTen);
    playback.advance(0.3, kTen);
    playback.jump(1.2);
    EXPECT_NEAR(playback.advance(0.1, kTen), 1.3, 1e-9);
}

TEST(Playback, CountsTheRateThatIsShown) {
    Playback playback;
    playback.start(0, kTen);
    for (int n = 0; n < 59; ++n) playback.advance(1.0 / 60, kTen);
    EXPECT_FALSE(playback.shownRate());
    for (int n = 0; n < 2; ++n) playback.advance(1.0 / 60, kTen);
    ASSERT_TRUE(playback.shownRate());
    EXPECT_NEAR(*playback.shownRate(), 10, 0.2);
    playback.start(0, kTen);
    EXPECT_FALSE(playback.shownRate());
    for (int n = 0; n < 4; ++n) playback.advance(0.25, kTen);  // four pictures a second
    EXPECT_EQ(playback.shownRate(), 4);
}

TEST(Playback, SaysWhenTheNextFrameIsDue) {
    Playback playback;
    playback.start(0.2, kTen);
    EXPECT_NEAR(playback.untilNext(kTen), 0.1, 1e-9);
    playback.advance(0.03, kTen);
    EXPECT_NEAR(playback.untilNext(kTen), 0.07, 1e-9);
}

}  // namespace
}  // namespace voledit
