#include "core/scene/tracked.h"

#include <gmock/gmock.h>

#include <random>

namespace voledit {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using Interpolation = Track::Interpolation;

Track trackOf(std::vector<std::pair<double, double>> keys, Interpolation interpolation) {
    Track track;
    for (const auto& [time, value] : keys) track.keys.push_back({time, {value}});
    track.interpolation = interpolation;
    return track;
}

double at(const Track& track, double t) {
    return track.at(t).at(0);
}

TEST(Track, HoldsBeyondItsEndsAndMeetsItsKeys) {
    for (const auto how : {Interpolation::Step, Interpolation::Linear, Interpolation::Smooth}) {
        const Track track = trackOf({{1, 10}, {2, 30}, {4, -5}}, how);
        EXPECT_EQ(at(track, -kInfinity), 10);
        EXPECT_EQ(at(track, 0), 10);
        EXPECT_EQ(at(track, 1), 10);
        EXPECT_EQ(at(track, 2), 30);
        EXPECT_EQ(at(track, 4), -5);
        EXPECT_EQ(at(track, 1e9), -5);
    }
}

TEST(Track, StepHoldsEachKeyAndLinearGoesStraight) {
    EXPECT_EQ(at(trackOf({{1, 10}, {3, 30}}, Interpolation::Step), 2.999), 10);
    EXPECT_EQ(at(trackOf({{1, 10}, {3, 30}}, Interpolation::Linear), 1.5), 15);
}

TEST(Track, SmoothIsCatmullRomOfEvenKeys) {
    // 0.5·((2b) + (c−a)f + (2a−5b+4c−d)f² + (3b−a−3c+d)f³), the textbook's form.
    const double a = 3, b = -1, c = 4, d = 10;
    const Track track = trackOf({{0, a}, {1, b}, {2, c}, {3, d}}, Interpolation::Smooth);
    for (double f = 0; f < 1; f += 0.125) {
        const double expected =
            0.5 * (2 * b + (c - a) * f + (2 * a - 5 * b + 4 * c - d) * f * f + (3 * b - a - 3 * c + d) * f * f * f);
        EXPECT_NEAR(at(track, 1 + f), expected, 1e-13);
    }
}

TEST(Track, SmoothGivesALineBackForUnevenKeysOnOne) {
    const Track track = trackOf({{0, 1}, {0.5, 2}, {3, 7}, {3.25, 7.5}}, Interpolation::Smooth);
    for (double t = 0; t <= 3.25; t += 0.05) EXPECT_NEAR(at(track, t), 1 + 2 * t, 1e-12);
    EXPECT_NEAR(at(trackOf({{1, 1}, {2, 5}}, Interpolation::Smooth), 1.25), 2, 1e-15) << "two keys are a line";
}

TEST(Track, SmoothHasOneSlopeOnBothSidesOfAKey) {
    const Track track = trackOf({{0, 0}, {1, 5}, {3, 1}, {4, 8}}, Interpolation::Smooth);
    const double h = 1e-6;
    for (const double key : {1.0, 3.0})
        EXPECT_NEAR((at(track, key) - at(track, key - h)) / h, (at(track, key + h) - at(track, key)) / h, 1e-4);
    EXPECT_NEAR((at(track, 1 + h) - at(track, 1)) / h, (1.0 - 0.0) / 3, 1e-4) << "that of the neighbours' line";
}

TEST(Track, TwoKeysOfOneTimeAreAJump) {
    for (const auto how : {Interpolation::Step, Interpolation::Linear, Interpolation::Smooth}) {
        const Track track = trackOf({{0, 0}, {1, 0}, {1, 5}, {2, 5}}, how);
        EXPECT_NEAR(at(track, 1 - 1e-9), 0, 1e-8);
        EXPECT_EQ(at(track, 1), 5);
        for (double t = 0; t < 1; t += 0.1) EXPECT_EQ(at(track, t), 0) << t;
        for (double t = 1; t < 2; t += 0.1) EXPECT_EQ(at(track, t), 5) << t;
    }
}

TEST(NumbersOf, GoThereAndBack) {
    const auto check = [](const auto& value, std::size_t count) {
        const auto numbers = numbersOf(value);
        EXPECT_EQ(numbers.size(), count);
        auto back = std::remove_cvref_t<decltype(value)>{};
        setNumbers(back, numbers);
        EXPECT_EQ(back, value);
    };
    check(3.5, 1);
    check(Vec2(1, 2), 2);
    check(Vec3(1, 2, 3), 3);
    check(Mat4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16), 16);
    check(std::vector<double>{1, 2, 3, 4}, 4);
    check(std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}, 6);
    check(PiecewiseLinear{{{1, 2}, {3, 4}}}, 4);
    check(ColorTable{{{1, {2, 3, 4}}, {5, {6, 7, 8}}}}, 8);
    EXPECT_EQ(numbersOf(Mat4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16))[1], 5) << "row by row";
}

TEST(Tracked, WithoutTracksIsItsValue) {
    Tracked<Vec3> v{1, 2, 3};
    EXPECT_FALSE(v.animated());
    EXPECT_EQ(*v, Vec3(1, 2, 3));
    EXPECT_EQ(v.at(5), Vec3(1, 2, 3));
    EXPECT_EQ(v, Vec3(1, 2, 3));
    EXPECT_TRUE(v.tracks().empty());
}

TEST(Tracked, ReadsAsItsFirstKeysAndTakesPartsFromTracks) {
    Tracked<Vec3> v{1, 2, 3};
    v.setTracks({{1, trackOf({{0, 10}, {2, 20}}, Interpolation::Linear)}});
    EXPECT_TRUE(v.animated());
    EXPECT_EQ(*v, Vec3(1, 10, 3));
    EXPECT_EQ(v.at(1), Vec3(1, 15, 3));
    EXPECT_FALSE(v == Vec3(1, 10, 3)) << "a plain value has no tracks";
    v = Vec3(4, 5, 6);
    EXPECT_FALSE(v.animated()) << "assigning drops tracks";
}

TEST(Tracked, AWholeTrackOfAListDecidesItsLength) {
    Tracked<std::vector<Vec3>> v;
    v.setTracks({{PartTrack::kWhole, {{{0, {1, 2, 3, 4, 5, 6}}, {1, {3, 2, 1, 4, 5, 8}}}, Interpolation::Linear}}});
    EXPECT_THAT(*v, ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6)));
    EXPECT_THAT(v.at(0.5), ElementsAre(Vec3(2, 2, 2), Vec3(4, 5, 7)));
}

TEST(Tracked, CopiesAreEqualAndShareUntilOneChanges) {
    Tracked<double> a = 1;
    a.setTracks({{PartTrack::kWhole, trackOf({{0, 1}, {1, 2}}, Interpolation::Linear)}});
    Tracked<double> b = a;
    EXPECT_EQ(a, b);
    EXPECT_EQ(&a.tracks(), &b.tracks());
    b.setTracks({{PartTrack::kWhole, trackOf({{0, 1}, {1, 3}}, Interpolation::Linear)}});
    EXPECT_NE(a, b);
    EXPECT_EQ(*a, *b) << "they differ in a later key only";
}

TEST(Tracked, SetWithATimeChangesThatKeyOnly) {
    Tracked<Vec3> v{1, 2, 3};
    v.setTracks({{0, trackOf({{0, 1}, {2, 5}}, Interpolation::Linear)}});
    v.set(Vec3(9, 8, 7), 1);
    EXPECT_EQ(v.at(0), Vec3(1, 8, 7));
    EXPECT_EQ(v.at(1), Vec3(9, 8, 7));
    EXPECT_EQ(v.at(2), Vec3(5, 8, 7));
    v.set(Vec3(4, 8, 7), 2);
    EXPECT_EQ(v.tracks()[0].track.keys.size(), 3u) << "a key that is there is replaced";
    EXPECT_EQ(v.at(2), Vec3(4, 8, 7));
    v.set(Vec3(0), std::nullopt);
    EXPECT_EQ(v, Vec3(0));
}

}  // namespace
}  // namespace voledit
