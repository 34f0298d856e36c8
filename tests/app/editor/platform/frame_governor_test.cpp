#include "app/editor/platform/frame_governor.h"

#include <gtest/gtest.h>

#include <random>

namespace voledit {
namespace {

constexpr double kFullWork = 1.4;  // millions of pixels × steps

// A machine on which a frame costs `rest + setup + rate · work`, and sometimes more.
struct Machine {
    double rate = 30, setup = 2, rest = 6;
    double tremble = 0;  // ± this part
    std::mt19937 random{7};

    double trembled(double ms) { return ms * (1 + tremble * std::uniform_real_distribution<double>(-1, 1)(random)); }
    // Draws one frame; its milliseconds.
    double frame(FrameGovernor& governor, double budget, PictureQuality* chosen = nullptr) {
        const PictureQuality quality = governor.choose(budget, kFullWork);
        if (chosen) *chosen = quality;
        const double work = kFullWork * shareOfWork(quality);
        const FrameGovernor::Cost cost{setup, trembled(rate * work), rest};
        governor.note(work, cost);
        return cost.setup + cost.drawing + cost.rest;
    }
    void learn(FrameGovernor& governor) {
        for (int n = 0; n < 5; ++n) frame(governor, 30);
    }
};

TEST(FrameGovernor, ShareOfWorkAndQualityAreInverse) {
    for (double divisor = 1; divisor <= FrameGovernor::kCoarsestDivisor; divisor += 0.1) {
        const PictureQuality quality{divisor, 1 + (divisor - 1) / 3};
        EXPECT_NEAR(qualityOfShare(shareOfWork(quality)).divisor, quality.divisor, 1e-9);
        EXPECT_NEAR(qualityOfShare(shareOfWork(quality)).step, quality.step, 1e-9);
    }
    EXPECT_EQ(qualityOfShare(1), PictureQuality{});
    EXPECT_EQ(qualityOfShare(5), PictureQuality{});
    EXPECT_DOUBLE_EQ(qualityOfShare(0).divisor, FrameGovernor::kCoarsestDivisor);
}

TEST(FrameGovernor, QualityIsContinuous) {
    double last = qualityOfShare(1).divisor;
    for (double share = 1; share > shareOfWork(qualityOfShare(0)); share *= 0.99) {
        const double divisor = qualityOfShare(share).divisor;
        EXPECT_GE(divisor, last - 1e-12);
        EXPECT_LT(divisor - last, 0.03);
        last = divisor;
    }
}

TEST(FrameGovernor, StartsCoarse) {
    FrameGovernor governor;
    EXPECT_FALSE(governor.known());
    EXPECT_EQ(governor.choose(30, kFullWork), qualityOfShare(0));
}

// Whatever the machine: from the third frame on the budget holds where the coarsest picture keeps to it, and it is made
// use of where the finest does not.
TEST(FrameGovernor, ConvergesWithinThreeFrames) {
    for (const double rate : {0.1, 1.0, 5.0, 20.0, 60.0, 150.0, 400.0, 3000.0})
        for (const double budget : {16.0, 30.0, 60.0}) {
            FrameGovernor governor;
            Machine machine{.rate = rate, .setup = 1, .rest = 4};
            PictureQuality quality;
            double ms = 0;
            for (int n = 0; n < 3; ++n) ms = machine.frame(governor, budget, &quality);
            for (int n = 0; n < 20; ++n) {
                ms = machine.frame(governor, budget, &quality);
                if (quality != qualityOfShare(0)) {
                    EXPECT_LE(ms, budget) << rate << " " << budget;
                }
                if (quality != PictureQuality{}) {
                    EXPECT_GE(ms, 0.5 * budget) << rate << " " << budget;
                }
            }
        }
}

// A part of the picture's cost does not fall with its size: the governor must not run to the coarsest for it.
TEST(FrameGovernor, ConvergesWhereDrawingHasACostOfItsOwn) {
    FrameGovernor governor;
    const auto frame = [&](PictureQuality* chosen) {
        *chosen = governor.choose(30, kFullWork);
        const double work = kFullWork * shareOfWork(*chosen), drawing = 8 + 30 * work;
        governor.note(work, {1, drawing, 5});
        return 6 + drawing;
    };
    PictureQuality quality;
    double ms = 0;
    for (int n = 0; n < 12; ++n) ms = frame(&quality);
    EXPECT_LE(ms, 30);
    EXPECT_GE(ms, 18);
    EXPECT_LT(quality.divisor, 2.5);
}

TEST(FrameGovernor, DoesNotChaseItself) {
    FrameGovernor governor;
    Machine machine{.rate = 40, .tremble = 0.12};
    machine.learn(governor);
    int changes = 0, tooSlow = 0;
    PictureQuality last = governor.choose(30, kFullWork), now;
    for (int n = 0; n < 300; ++n) {
        tooSlow += machine.frame(governor, 30, &now) > 30;
        changes += now != last;
        last = now;
    }
    EXPECT_LE(changes, 6);
    EXPECT_LE(tooSlow, 30);
}

TEST(FrameGovernor, OneSlowFrameChangesNothing) {
    FrameGovernor governor;
    Machine machine;
    machine.learn(governor);
    PictureQuality before, after;
    machine.frame(governor, 30, &before);
    machine.rate *= 1.7;
    machine.frame(governor, 30);
    machine.rate /= 1.7;
    for (int n = 0; n < 5; ++n) {
        machine.frame(governor, 30, &after);
        EXPECT_EQ(after, before);
    }
}

TEST(FrameGovernor, ReactsWithinThreeFramesToAHeavierScene) {
    for (const double heavier : {1.6, 3.0, 10.0}) {
        FrameGovernor governor;
        Machine machine{.rate = 10};
        machine.learn(governor);
        machine.rate *= heavier;
        for (int n = 0; n < 3; ++n) machine.frame(governor, 30);
        EXPECT_LE(machine.frame(governor, 30), 30) << heavier;
    }
}

TEST(FrameGovernor, RecoversWhenTheSceneIsLightAgain) {
    FrameGovernor governor;
    Machine machine{.rate = 200};
    machine.learn(governor);
    machine.rate = 10;
    PictureQuality quality;
    for (int n = 0; n < 5; ++n) machine.frame(governor, 30, &quality);
    EXPECT_EQ(quality, PictureQuality{});
}

TEST(FrameGovernor, FollowsTheBudgetAndTheRestOfTheFrame) {
    const auto settled = [](double budget, double rest) {
        FrameGovernor governor;
        Machine machine{.rate = 60, .rest = rest};
        PictureQuality quality;
        for (int n = 0; n < 10; ++n) machine.frame(governor, budget, &quality);
        return quality.divisor;
    };
    EXPECT_GT(settled(20, 6), settled(30, 6));
    EXPECT_GT(settled(30, 6), settled(60, 6));
    EXPECT_GT(settled(30, 12), settled(30, 3));
    // An interface that is too slow by itself still leaves the picture a part.
    EXPECT_LT(settled(30, 200), FrameGovernor::kCoarsestDivisor);
}

TEST(FrameGovernor, ATriedPictureTellsTheFirstQuality) {
    FrameGovernor governor;
    governor.note(0.002, {1, 0.002 * 20, 5});
    const PictureQuality quality = governor.choose(30, kFullWork);
    EXPECT_LE(6 + 20 * kFullWork * shareOfWork(quality), 30);
    EXPECT_LT(quality.divisor, 1.6);
}

}  // namespace
}  // namespace voledit
