#include "app/editor/platform/interaction_clock.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

TEST(InteractionClock, SaysNothingBeforeAPictureAnswered) {
    InteractionClock clock;
    EXPECT_FALSE(clock.times());
    clock.note({.start = 1, .shown = 1.02, .changed = true});
    EXPECT_FALSE(clock.times());
    clock.note({.start = 1.02, .shown = 1.05, .picture = true});
    ASSERT_TRUE(clock.times());
    EXPECT_NEAR(clock.times()->frameMs, 50, 1e-9);
}

TEST(InteractionClock, CountsFromPictureToPicture) {
    InteractionClock clock;
    for (int n = 0; n < 11; ++n)
        clock.note({.start = 1 + 0.04 * n + 0.002, .shown = 1.04 + 0.04 * n, .changed = true, .picture = true});
    EXPECT_NEAR(clock.times()->frameMs, 40, 1e-6);
    EXPECT_NEAR(clock.times()->picturesPerSecond, 25, 0.2);
}

TEST(InteractionClock, WaitingForTheHandDoesNotCount) {
    InteractionClock clock;
    for (int n = 0; n < 10; ++n)
        clock.note({.start = 1 + 0.2 * n, .shown = 1.03 + 0.2 * n, .changed = true, .picture = true});
    EXPECT_NEAR(clock.times()->frameMs, 30, 1e-6);
}

TEST(InteractionClock, RefinedIsFromTheLastChangeToFullQuality) {
    InteractionClock clock;
    clock.note({.start = 1, .shown = 1.03, .changed = true, .picture = true});
    clock.note({.start = 1.1, .shown = 1.13, .changed = true, .picture = true});
    clock.note({.start = 1.13, .shown = 1.4, .picture = true});
    EXPECT_EQ(clock.times()->refinedMs, 0);
    clock.note({.start = 1.4, .shown = 1.9, .picture = true, .final = true});
    EXPECT_NEAR(clock.times()->refinedMs, 800, 1e-6);
    clock.note({.start = 2.4, .shown = 2.5, .final = true});
    EXPECT_NEAR(clock.times()->refinedMs, 800, 1e-6);
}

TEST(InteractionClock, ARestBeginsANewInteraction) {
    InteractionClock clock;
    clock.note({.start = 1, .shown = 1.1, .changed = true, .picture = true});
    clock.note({.start = 2, .shown = 2.02, .changed = true, .picture = true});
    EXPECT_NEAR(clock.times()->frameMs, 20, 1e-6);
}

}  // namespace
}  // namespace voledit
