#include "app/editor/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace voledit {
namespace {

TEST(Background, WhatItGivesBackIsDoneByPollInThisThread) {
    Background background;
    EXPECT_EQ(background.poll(), Background::Ended::No);
    int result = 0;
    background.start("Adding", [&](Progress& progress) -> Background::Finish {
        progress.set(0.5);
        return [&result] { result = 42; };
    });
    EXPECT_TRUE(background.running());
    EXPECT_EQ(background.title(), "Adding");
    background.wait();
    EXPECT_EQ(result, 0);
    EXPECT_EQ(background.fraction(), 0.5);
    EXPECT_EQ(background.poll(), Background::Ended::Done);
    EXPECT_EQ(result, 42);
    EXPECT_FALSE(background.running());
}

TEST(Background, CancelledWorkHasNoResult) {
    Background background;
    bool finished = false;
    background.start("Waiting", [&](Progress& progress) -> Background::Finish {
        while (!progress.cancelled()) {
        }
        return [&finished] { finished = true; };
    });
    background.cancel();
    background.wait();
    EXPECT_EQ(background.poll(), Background::Ended::Cancelled);
    EXPECT_FALSE(finished);
}

TEST(Background, WhatFailsIsThrownByPollOnce) {
    Background background;
    background.start("Failing", [](Progress&) -> Background::Finish { throw std::runtime_error("no"); });
    background.wait();
    EXPECT_THROW(background.poll(), std::runtime_error);
    EXPECT_EQ(background.poll(), Background::Ended::No);
}

TEST(Background, StartingAnewForgetsWhatWentOn) {
    Background background;
    std::atomic<int> done{0};
    background.start("First", [](Progress& progress) -> Background::Finish {
        while (!progress.cancelled()) {
        }
        return {};
    });
    background.start("Second", [&](Progress&) -> Background::Finish { return [&done] { ++done; }; });
    background.wait();
    EXPECT_EQ(background.poll(), Background::Ended::Done);
    EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace voledit
