#include "core/skeleton/motion.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "body_fixtures.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

using enum MotionChannel;

double difference(const Quat& a, const Quat& b) {
    return 1 - std::abs(glm::dot(a, b));
}

Motion oneJoint(std::vector<MotionChannel> channels, std::vector<double> values) {
    Motion motion;
    motion.joints = {{"root", Joint::kNoParent, Vec3(10, 20, 30), std::move(channels), false}};
    motion.frames = values.size() / motion.joints[0].channels.size();
    motion.values = std::move(values);
    return motion;
}

Quat about(const Vec3& axis, double degrees) {
    return glm::angleAxis(degrees * kPi / 180, axis);
}

TEST(Motion, RestPlacesAreSumsOfOffsets) {
    Motion motion;
    motion.joints = {{"a", Joint::kNoParent, Vec3(1, 2, 3), {}, false},
                     {"b", 0, Vec3(10, 0, 0), {}, false},
                     {"c", 1, Vec3(0, 100, 0), {}, true},
                     {"d", Joint::kNoParent, Vec3(5), {}, false}};
    const Skeleton skeleton = skeletonOf(motion);
    EXPECT_EQ(skeleton.joints[2].at, Vec3(11, 102, 3));
    EXPECT_EQ(skeleton.joints[2].parent, 1);
    EXPECT_EQ(skeleton.joints[3].at, Vec3(5));
    EXPECT_EQ(motion.channelCount(), 0u);
}

TEST(Motion, RotationsMultiplyInTheOrderOfTheChannels) {
    const Quat x = about({1, 0, 0}, 10), y = about({0, 1, 0}, 20), z = about({0, 0, 1}, 30);
    EXPECT_LT(
        difference(poseOfFrame(oneJoint({Zrotation, Xrotation, Yrotation}, {30, 10, 20}), 0).rotate[0], z * x * y),
        1e-15);
    EXPECT_LT(
        difference(poseOfFrame(oneJoint({Yrotation, Zrotation, Xrotation}, {20, 30, 10}), 0).rotate[0], y * z * x),
        1e-15);
    EXPECT_LT(difference(poseOfFrame(oneJoint({Xrotation}, {10}), 0).rotate[0], x), 1e-15);
    // Proper Euler angles name an axis twice.
    EXPECT_LT(difference(poseOfFrame(oneJoint({Zrotation, Xrotation, Zrotation}, {30, 10, -30}), 0).rotate[0],
                         z * x * about({0, 0, 1}, -30)),
              1e-15);
}

TEST(Motion, ARootsPositionsReplaceItsOffsetAxisByAxis) {
    const Motion motion = oneJoint({Zposition, Xposition}, {7, 8});
    const auto posed = posedJoints(skeletonOf(motion), poseOfFrame(motion, 0));
    EXPECT_EQ(posed[0].position, Vec3(8, 20, 7));
}

TEST(Motion, PositionsBelowTheRootAddToTheOffset) {
    Motion motion = oneJoint({Yrotation}, {90});
    motion.joints.push_back({"below", 0, Vec3(1, 0, 0), {Xposition, Yposition}, false});
    motion.values = {90, 2, 5};
    const auto posed = posedJoints(skeletonOf(motion), poseOfFrame(motion, 0));
    // Turned a quarter about y: x to −z.
    EXPECT_LT(glm::length(posed[1].position - Vec3(10, 25, 27)), 1e-12);
}

TEST(Motion, TimesBetweenFramesSlerpAndTheEndsAreHeld) {
    Motion motion = oneJoint({Xposition, Zrotation}, {0, 0, 10, 90, 20, -180});
    motion.frameTime = 0.5;
    EXPECT_EQ(motion.duration(), 1.0);
    for (std::size_t frame = 0; frame < 3; ++frame)
        EXPECT_EQ(poseAt(motion, double(frame) * 0.5), poseOfFrame(motion, frame));
    EXPECT_EQ(poseAt(motion, -3), poseOfFrame(motion, 0));
    EXPECT_EQ(poseAt(motion, 99), poseOfFrame(motion, 2));
    EXPECT_EQ(poseAt(motion, kNaN), poseOfFrame(motion, 0));
    const Pose between = poseAt(motion, 0.125);
    EXPECT_LT(difference(between.rotate[0], about({0, 0, 1}, 22.5)), 1e-15);
    EXPECT_NEAR(between.translate[0].x, 2.5 - 10, 1e-14);
    // From 90° to −180° the short way is up.
    EXPECT_LT(difference(poseAt(motion, 0.75).rotate[0], about({0, 0, 1}, 135)), 1e-15);
}

TEST(Motion, WithoutFramesThereIsTheRestPose) {
    Motion motion = oneJoint({Xposition}, {});
    motion.frames = 0;
    EXPECT_EQ(poseAt(motion, 1), restPose(skeletonOf(motion)));
    EXPECT_EQ(motion.duration(), 0.0);
}

TEST(Motion, EulerChannelsHoldAnyPose) {
    Random random(3);
    const Skeleton skeleton = randomSkeleton(random, 12);
    const Pose pose = randomPose(random, skeleton, 1);
    const Motion motion = motionOf(skeleton, {pose});
    const auto expected = posedJoints(skeleton, pose);
    const auto found = posedJoints(skeletonOf(motion), poseOfFrame(motion, 0));
    for (std::size_t j = 0; j < expected.size(); ++j)
        EXPECT_LT(glm::length(found[j].position - expected[j].position), 1e-12);
}

}  // namespace
}  // namespace voledit
