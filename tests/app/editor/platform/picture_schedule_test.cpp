#include "app/editor/platform/picture_schedule.h"

#include <gmock/gmock.h>

#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/platform/pretended_source.h"

namespace voledit {
namespace {

using test::Pretence;
using testing::HasSubstr;

// A viewport, two renderers that only let time pass, and a hand that turns the view.
struct PictureScheduleTest : testing::Test {
    double now = 0;
    Pretence slices, rays;
    CompiledScene scene;
    Index2 size{960, 720};
    RendererChoice choice = RendererChoice::Rays;
    PictureSchedule::Frame frame{.budgetMs = 30, .restMs = 5, .refines = true};
    PictureSchedule schedule = newSchedule();

    PictureSchedule newSchedule() {
        return {[this](bool r) { return std::make_unique<test::PretendedSource>(r ? rays : slices, now); },
                [this] { return now; }, true};
    }

    PictureScheduleTest() {
        Workspace workspace;
        test::openIn(workspace, test::smallScene(true));
        scene = workspace.compiled;
        scene.render.step = 0.5;
    }
    // Milliseconds of one update; `complete` where a picture came of it.
    double update(bool* complete = nullptr) {
        const double start = now;
        const bool done = schedule.update(scene, size, choice, frame);
        if (complete) *complete = done;
        return now - start;
    }
    double turn(bool* complete = nullptr) {
        scene.camera.eye.x += 1;
        return update(complete);
    }
    // Until it rests; the longest update.
    double rest() {
        double longest = 0;
        for (int n = 0; n < 10000 && schedule.busy(); ++n) longest = std::max(longest, update());
        EXPECT_FALSE(schedule.busy());
        return longest;
    }
};

TEST_F(PictureScheduleTest, MovingKeepsToTheBudgetFromTheFirstFrameOn) {
    for (const double rate : {1.0, 20.0, 200.0}) {
        rays.rate = rate;
        schedule = newSchedule();
        for (int n = 0; n < 10; ++n) {
            bool complete = false;
            EXPECT_LE(turn(&complete), 2 * 30) << rate;
            EXPECT_TRUE(complete);
            EXPECT_TRUE(schedule.changed());
            if (n > 2) {
                EXPECT_LE(turn(), 25) << rate;
            }
        }
    }
}

TEST_F(PictureScheduleTest, NoFrameTakesSecondsHoweverHeavyTheScene) {
    rays.rate = 50000;  // half a minute for the whole picture
    int pictures = 0;
    for (int n = 0; n < 120; ++n) {
        bool complete = false;
        EXPECT_LE(turn(&complete), 120);
        pictures += complete;
    }
    // Late, but seen.
    EXPECT_GE(pictures, 2);
}

TEST_F(PictureScheduleTest, RefinesInStepsWithinTheBudgetToFullQuality) {
    rays.rate = 500;
    for (int n = 0; n < 5; ++n) turn();
    EXPECT_FALSE(schedule.finished());
    EXPECT_LE(rest(), 30);
    EXPECT_TRUE(schedule.finished());
    EXPECT_EQ(schedule.pictureSize(), size);
    EXPECT_EQ(rays.effort.step, 1);
    EXPECT_EQ(schedule.progress(), 1);
}

TEST_F(PictureScheduleTest, ACoarsePictureGetsFinerBeforeItIsFull) {
    rays.rate = 500;
    for (int n = 0; n < 5; ++n) turn();
    std::vector<int> widths{schedule.pictureSize().x};
    while (schedule.busy()) {
        update();
        if (schedule.pictureSize().x != widths.back()) widths.push_back(schedule.pictureSize().x);
    }
    EXPECT_GE(widths.size(), 3u);
    EXPECT_TRUE(std::is_sorted(widths.begin(), widths.end()));
}

TEST_F(PictureScheduleTest, ProgressGrowsWhileRefining) {
    rays.rate = 500;
    turn();
    double last = 0;
    while (schedule.busy()) {
        update();
        EXPECT_GE(schedule.progress(), last);
        last = schedule.progress();
    }
    EXPECT_EQ(last, 1);
}

TEST_F(PictureScheduleTest, AChangeDropsTheRefinement) {
    rays.rate = 500;
    for (int n = 0; n < 5; ++n) turn();
    update();
    EXPECT_FALSE(rays.effort.moving);
    const int begun = rays.begun;
    turn();
    EXPECT_GT(rays.begun, begun);
    EXPECT_TRUE(rays.effort.moving);
    EXPECT_FALSE(schedule.finished());
}

TEST_F(PictureScheduleTest, NothingIsDrawnWithoutAChangeWhenAllIsFine) {
    turn();
    rest();
    const int begun = rays.begun;
    EXPECT_EQ(update(), 0);
    EXPECT_FALSE(schedule.changed());
    EXPECT_EQ(rays.begun, begun);
}

TEST_F(PictureScheduleTest, AMovingPictureOfFullSizeIsFinalOnlyWhereItIsTheSame) {
    rays.rate = 0.5;
    for (int n = 0; n < 4; ++n) turn();
    EXPECT_TRUE(schedule.finished());
    rays.movingDiffers = true;
    for (int n = 0; n < 4; ++n) turn();
    EXPECT_EQ(schedule.pictureSize(), size);
    EXPECT_FALSE(schedule.finished());
    rest();
    EXPECT_FALSE(rays.effort.moving);
}

TEST_F(PictureScheduleTest, WhatPlaysIsNotRefined) {
    rays.rate = 500;
    frame.refines = false;
    for (int n = 0; n < 5; ++n) turn();
    const int begun = rays.begun;
    for (int n = 0; n < 5; ++n) EXPECT_EQ(update(), 0);
    EXPECT_EQ(rays.begun, begun);
}

TEST_F(PictureScheduleTest, FinishDrawsTheFullPictureOnce) {
    EXPECT_TRUE(schedule.finish(scene, size, choice));
    EXPECT_EQ(rays.size, size);
    EXPECT_EQ(rays.effort.step, 1);
    EXPECT_FALSE(rays.effort.moving);
    EXPECT_TRUE(schedule.finished());
    EXPECT_FALSE(schedule.finish(scene, size, choice));
    turn();
    EXPECT_TRUE(schedule.finish(scene, size, choice));
    EXPECT_FALSE(schedule.busy());
}

TEST_F(PictureScheduleTest, AutoTakesTheFasterOnceItHasRested) {
    choice = RendererChoice::Auto;
    slices.rate = 2;
    turn();
    EXPECT_TRUE(schedule.rays());
    EXPECT_EQ(slices.begun, 0);
    rest();
    turn();
    EXPECT_FALSE(schedule.rays());
    EXPECT_THAT(schedule.reason(), HasSubstr("Slices are faster"));
    // Once for a structure and size, whatever is dragged.
    const int begun = rays.begun;
    for (int n = 0; n < 5; ++n) {
        turn();
        rest();
    }
    EXPECT_EQ(rays.begun, begun);
}

TEST_F(PictureScheduleTest, AutoKeepsRaysWhereTheyAreFaster) {
    choice = RendererChoice::Auto;
    slices.rate = 60;
    turn();
    rest();
    turn();
    EXPECT_TRUE(schedule.rays());
    EXPECT_THAT(schedule.reason(), HasSubstr("Rays are faster"));
}

TEST_F(PictureScheduleTest, TheTrialGivesUpOnSlowSlices) {
    choice = RendererChoice::Auto;
    slices.rate = 1e6;
    turn();
    EXPECT_LE(rest(), 500);
    turn();
    EXPECT_TRUE(schedule.rays());
}

TEST_F(PictureScheduleTest, RaysTakeOverWhereSlicesRefuse) {
    choice = RendererChoice::Slices;
    slices.refuses = true;
    bool complete = false;
    turn(&complete);
    EXPECT_TRUE(complete);
    EXPECT_TRUE(schedule.rays());
    EXPECT_THAT(schedule.slicesProblem(), HasSubstr("cannot draw this"));
    rest();
    EXPECT_TRUE(schedule.finished());
    // Where a screenshot comes first, too.
    scene.camera.eye.x += 1;
    EXPECT_TRUE(schedule.finish(scene, size, choice));
    EXPECT_THAT(schedule.slicesProblem(), HasSubstr("cannot draw this"));
}

TEST_F(PictureScheduleTest, AnotherStructureIsLearntAnew) {
    for (int n = 0; n < 5; ++n) turn();
    rays.rate = 2000;
    Workspace workspace;
    test::openIn(workspace, test::smallScene(false));
    const CompiledScene before = scene;
    scene = workspace.compiled;
    EXPECT_LE(update(), 2 * 30);
    // What was known of the first is still known.
    rays.rate = 20;
    scene = before;
    const int begun = rays.begun;
    turn();
    EXPECT_EQ(rays.begun, begun + 1);
}

}  // namespace
}  // namespace voledit
