// Tracks of rotations run over quaternions.

#include "core/scene/scene_actors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace voledit {
namespace {

using Interpolation = Track::Interpolation;

Tracked<Rotation> turning(std::vector<Track::Key> keys, Interpolation how = Interpolation::Linear) {
    Tracked<Rotation> result;
    result.setTracks({{PartTrack::kWhole, {std::move(keys), how}}});
    return result;
}
Quat at(const Tracked<Rotation>& rotation, double t) {
    return quatOfDegrees(rotation.at(t).degrees);
}
/// Angle between two rotations, radians.
double between(const Quat& a, const Quat& b) {
    const Quat d = glm::conjugate(a) * b;
    return 2 * std::atan2(glm::length(Vec3(d.x, d.y, d.z)), std::abs(d.w));
}
std::vector<Track::Key> randomKeys(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(-180, 180), step(0.2, 1);
    std::vector<Track::Key> keys;
    double t = -1;
    for (int k = 0; k < count; ++k, t += step(random))
        keys.push_back({t, {angle(random), angle(random), angle(random)}});
    return keys;
}

TEST(RotationTrack, LinearIsSlerpAlongTheShortestPath) {
    const auto keys = randomKeys(3, 12);
    const auto track = turning(keys);
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
        const Quat a = quatOfDegrees({keys[k].value[0], keys[k].value[1], keys[k].value[2]});
        const Quat b = quatOfDegrees({keys[k + 1].value[0], keys[k + 1].value[1], keys[k + 1].value[2]});
        for (const double f : {0.1, 0.25, 0.5, 0.9}) {
            const Quat now = at(track, keys[k].time + f * (keys[k + 1].time - keys[k].time));
            EXPECT_LT(between(now, glm::slerp(a, b, f)), 1e-9) << k;  // glm's takes the shorter way
            EXPECT_NEAR(between(a, now), f * between(a, b), 1e-9) << k;
        }
    }
}

TEST(RotationTrack, GoesTheShorterWayRound) {
    const auto track = turning({{0, {0, 0, 170}}, {1, {0, 0, -170}}});
    EXPECT_LT(between(at(track, 0.5), quatOfDegrees({0, 0, 180})), 1e-12) << "through 180, not through 0";
    const auto wide = turning({{0, {0, 0, 0}}, {1, {0, 0, 270}}});
    EXPECT_LT(between(at(wide, 0.5), quatOfDegrees({0, 0, -45})), 1e-12);
}

TEST(RotationTrack, HasItsKeysVeryNumbersAndIsHeldBeyondThem) {
    const auto track = turning({{0, {370, 20, -400}}, {1, {1, 2, 3}}}, Interpolation::Smooth);
    EXPECT_EQ(track.at(0).degrees, Vec3(370, 20, -400));
    EXPECT_EQ(track.at(-7).degrees, Vec3(370, 20, -400));
    EXPECT_EQ(track.at(1).degrees, Vec3(1, 2, 3));
    EXPECT_EQ(track.at(7).degrees, Vec3(1, 2, 3));
}

TEST(RotationTrack, SmoothAboutOneAxisIsCatmullRomOfTheAngle) {
    const std::vector<double> times{0, 0.4, 1, 1.2, 2}, angles{0, 50, 40, 100, -20};
    std::vector<Track::Key> turns;
    Track numbers{{}, Interpolation::Smooth};
    for (std::size_t k = 0; k < times.size(); ++k) {
        turns.push_back({times[k], {0, angles[k], 0}});
        numbers.keys.push_back({times[k], {angles[k]}});
    }
    const auto track = turning(turns, Interpolation::Smooth);
    for (double t = -0.1; t < 2.1; t += 0.037)
        EXPECT_LT(between(at(track, t), quatOfDegrees({0, numbers.at(t)[0], 0})), 1e-9) << t;
}

TEST(RotationTrack, SmoothHasOneVelocityOnBothSidesOfAKey) {
    const auto keys = randomKeys(5, 9);
    const auto track = turning(keys, Interpolation::Smooth);
    const double h = 1e-6;
    for (std::size_t k = 1; k + 1 < keys.size(); ++k) {
        const auto velocity = [&](double from, double to) {
            const Quat d = glm::conjugate(at(track, from)) * at(track, to);
            return Vec3(d.x, d.y, d.z) * (2 / (d.w < 0 ? -1.0 : 1.0)) / (to - from);
        };
        const double t = keys[k].time;
        EXPECT_LT(glm::length(velocity(t - h, t) - velocity(t, t + h)), 1e-3) << "at key " << k;
    }
}

TEST(RotationTrack, StepHoldsAndASegmentMayHaveAnInterpolationOfItsOwn) {
    auto keys = std::vector<Track::Key>{{0, {0, 0, 0}}, {1, {90, 0, 0}}, {2, {0, 0, 0}}};
    keys[1].interpolation = Interpolation::Step;
    const auto track = turning(keys);
    EXPECT_LT(between(at(track, 0.5), quatOfDegrees({45, 0, 0})), 1e-12);
    EXPECT_EQ(track.at(1.9).degrees, Vec3(90, 0, 0));
}

TEST(RotationTrack, TracksOfOneComponentAreDegrees) {
    Tracked<Rotation> rotation(Rotation{{10, 20, 30}});
    rotation.setTracks({{1, {{{0, {0}}, {1, {400}}}, Interpolation::Linear}}});
    EXPECT_EQ(rotation.at(0.5).degrees, Vec3(10, 200, 30));
}

TEST(Track, AKeysOwnInterpolationHoldsToTheNextKey) {
    Track track{{{0, {0}}, {1, {10}}, {2, {20}}, {3, {0}}}, Interpolation::Linear};
    track.keys[0].interpolation = Interpolation::Step;
    track.keys[2].interpolation = Interpolation::Smooth;
    EXPECT_EQ(track.at(0.99)[0], 0);
    EXPECT_EQ(track.at(1.5)[0], 15);
    // The slope at 2 is (0 − 10)/2, at the end that of the segment.
    EXPECT_NEAR(track.at(2.5)[0], 10 + (-5.0 + 20.0) / 8, 1e-12);
}

TEST(Track, AStepIsAJumpToTheSlopesBesideIt) {
    Track track{{{0, {0}}, {1, {100}}, {2, {101}}}, Interpolation::Smooth};
    track.keys[0].interpolation = Interpolation::Step;
    EXPECT_NEAR(track.at(1.5)[0], 100.5, 1e-12) << "the jump to 100 bends nothing";
}

}  // namespace
}  // namespace voledit
