// retargeted and proposedMotionFit (core/skeleton/motion.h).

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "body_fixtures.h"
#include "core/base/error.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Frames of a body that moves: small random turns, travel of the root.
std::vector<Pose> movingFrames(Random& random, const Skeleton& skeleton, int count) {
    std::vector<Pose> frames;
    for (int f = 0; f < count; ++f) {
        Pose pose = restPose(skeleton);
        for (Quat& rotation : pose.rotate)
            rotation = glm::angleAxis(randomNumber(random, -0.6, 0.6), glm::normalize(randomVector(random, 1)));
        pose.translate[0] = randomVector(random, 4);
        frames.push_back(std::move(pose));
    }
    return frames;
}

/// The skeleton and its poses seen after x ↦ scale·turn·x.
Skeleton transformed(Skeleton skeleton, const Quat& turn, double scale) {
    for (Joint& joint : skeleton.joints) joint.at = scale * (turn * joint.at);
    return skeleton;
}
Pose transformed(Pose pose, const Quat& turn, double scale) {
    for (Quat& rotation : pose.rotate) rotation = turn * rotation * glm::conjugate(turn);
    for (Vec3& translation : pose.translate) translation = scale * (turn * translation);
    return pose;
}

void expectSamePlaces(const Skeleton& skeleton, const Pose& a, const Pose& b, double tolerance) {
    const auto x = posedJoints(skeleton, a), y = posedJoints(skeleton, b);
    for (std::size_t j = 0; j < x.size(); ++j) {
        EXPECT_LT(glm::length(x[j].position - y[j].position), tolerance) << skeleton.joints[j].name;
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(x[j].linear[c] - y[j].linear[c]), tolerance);
    }
}

TEST(Retargeting, OnItsOwnSkeletonAMotionIsItself) {
    Random random(1);
    for (int n = 0; n < 20; ++n) {
        // Random trees too, with all joints displaced: nothing of a body is needed.
        const Skeleton skeleton = n % 2 ? standingBiped() : randomSkeleton(random, 15);
        std::vector<Pose> frames = movingFrames(random, skeleton, 4);
        if (n % 4 == 0)
            for (Pose& pose : frames)
                for (Vec3& translation : pose.translate) translation = randomVector(random, 1);
        const Motion motion = motionOf(skeleton, frames);
        const Skeleton own = skeletonOf(motion);
        MotionMap map;
        map.joints = sameNames(own);
        for (const double t : {-1.0, 0.0, 0.05, 0.17, 0.3, 9.0})
            expectSamePlaces(own, retargeted(own, motion, map, t), poseAt(motion, t), 1e-9);
    }
}

TEST(Retargeting, AxesAndUnitsAreTheMaps) {
    Random random(2);
    for (int n = 0; n < 20; ++n) {
        const Skeleton skeleton = standingBiped();
        const Motion motion = motionOf(skeleton, movingFrames(random, skeleton, 3));
        const Quat turn = randomRotation(random);
        const double scale = randomNumber(random, 0.1, 10);
        const Skeleton other = transformed(skeleton, turn, scale);
        MotionMap map;
        map.joints = sameNames(skeleton);
        map.skeletonFromMotion = glm::scale(glm::mat4_cast(turn), Vec3(scale));
        expectSamePlaces(other, retargeted(other, motion, map, 0.13), transformed(poseAt(motion, 0.13), turn, scale),
                         1e-6 * scale);
    }
}

/// Joints whose one mapped joint below is their child: not hubs.
const char* const kBones[][2] = {{"Spine", "Spine1"},          {"Spine1", "Spine2"},         {"Neck", "Head"},
                                 {"Head", "Head_End"},         {"LeftUpLeg", "LeftLeg"},     {"LeftLeg", "LeftFoot"},
                                 {"LeftFoot", "LeftToeBase"},  {"LeftShoulder", "LeftArm"},  {"LeftArm", "LeftForeArm"},
                                 {"LeftForeArm", "LeftHand"},  {"LeftHand", "LeftHand_End"}, {"RightUpLeg", "RightLeg"},
                                 {"RightArm", "RightForeArm"}, {"RightForeArm", "RightHand"}};

TEST(Retargeting, BonesPointAsInTheMotionWhateverTheRestPoses) {
    Random random(3);
    const Skeleton hanging = standingBiped({0.1, -0.99, 0.1}), level = standingBiped({1, 0, 0}),
                   slanted = standingBiped();
    for (const Skeleton* source : {&hanging, &level, &slanted}) {
        for (const Skeleton* target : {&hanging, &level, &slanted}) {
            const Motion motion = motionOf(*source, movingFrames(random, *source, 3));
            MotionMap map;
            map.joints = sameNames(*source);
            const auto theirs = posedJoints(*source, poseAt(motion, 0.12));
            const auto ours = posedJoints(*target, retargeted(*target, motion, map, 0.12));
            for (const auto& bone : kBones) {
                const std::size_t a = std::size_t(source->find(bone[0])), b = std::size_t(source->find(bone[1]));
                EXPECT_LT(angle(theirs[b].position - theirs[a].position, ours[b].position - ours[a].position), 1e-6)
                    << bone[0];
            }
            EXPECT_LT(glm::length(theirs[0].position - ours[0].position), 1e-9);
        }
    }
}

TEST(Retargeting, CollarsThatBeginElsewhereDoNotShrug) {
    const Skeleton target = standingBiped();
    Skeleton source = target;
    for (const char* name : {"LeftShoulder", "RightShoulder"})
        source.joints[std::size_t(source.find(name))].at = {0, 13.8, -0.2};
    source.joints[std::size_t(source.find("Neck"))].at.z += 0.5;
    source.joints[std::size_t(source.find("LeftFoot"))].at.y += 0.4;
    const Motion motion = motionOf(source, {restPose(source)});
    MotionMap map;
    map.joints = sameNames(source);
    const Pose pose = retargeted(target, motion, map, 0);
    for (const char* name : {"LeftShoulder", "RightShoulder", "Spine2", "Neck", "Head", "LeftFoot", "LeftToeBase"}) {
        const auto posed = posedJoints(target, pose)[std::size_t(target.find(name))];
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(posed.linear[c] - Mat3(1.0)[c]), 1e-9) << name;
    }
}

TEST(Retargeting, BonesKeepTheirLengthsOnOtherProportions) {
    Random random(4);
    const Skeleton source = standingBiped();
    Skeleton target = source;
    for (Joint& joint : target.joints) joint.at *= Vec3(1.2, 0.8, 1.1);
    std::vector<Pose> frames = movingFrames(random, source, 2);
    // Position channels of other bones than one's own are no use.
    for (Vec3& translation : frames[1].translate) translation = randomVector(random, 3);
    const Motion motion = motionOf(source, frames);
    MotionMap map;
    map.joints = sameNames(source);
    const auto ours = posedJoints(target, retargeted(target, motion, map, 0.1));
    for (std::size_t j = 1; j < ours.size(); ++j) {
        const std::size_t parent = std::size_t(target.joints[j].parent);
        EXPECT_NEAR(glm::length(ours[j].position - ours[parent].position),
                    glm::length(target.joints[j].at - target.joints[parent].at), 1e-9);
    }
}

TEST(Retargeting, UnmappedJointsFollowTheirParents) {
    Random random(5);
    const Skeleton skeleton = standingBiped();
    const Motion motion = motionOf(skeleton, movingFrames(random, skeleton, 2));
    MotionMap map;
    map.joints = {{"Hips", "Hips"}, {"LeftArm", "RightArm"}, {"Nobody", "Hips"}, {"Head", "Nobody"}};
    const Pose pose = retargeted(skeleton, motion, map, 0.05);
    for (std::size_t j = 0; j < pose.rotate.size(); ++j) {
        const std::string& name = skeleton.joints[j].name;
        if (name == "Hips" || name == "LeftArm") continue;
        EXPECT_EQ(pose.rotate[j], Quat(1, 0, 0, 0)) << name;
        EXPECT_EQ(pose.translate[j], Vec3(0)) << name;
    }
    EXPECT_EQ(retargeted(skeleton, motion, MotionMap(), 0.05), restPose(skeleton));
}

TEST(Retargeting, InPlaceKeepsOnlyWhatGoesUp) {
    const Skeleton skeleton = standingBiped();
    Pose walked = restPose(skeleton);
    walked.translate[0] = {5, 0.5, -7};
    const Motion motion = motionOf(skeleton, {walked});
    MotionMap map;
    map.joints = sameNames(skeleton);
    map.inPlace = true;
    map.up = 1;
    EXPECT_LT(glm::length(retargeted(skeleton, motion, map, 0).translate[0] - Vec3(0, 0.5, 0)), 1e-12);
    map.inPlace = false;
    EXPECT_LT(glm::length(retargeted(skeleton, motion, map, 0).translate[0] - Vec3(5, 0.5, -7)), 1e-12);
}

TEST(Retargeting, SeveralTopmostJointsOfATreeStayWhereTheyAre) {
    Random random(6);
    const Skeleton skeleton = standingBiped();
    const Motion motion = motionOf(skeleton, movingFrames(random, skeleton, 1));
    MotionMap map;
    map.joints = {{"LeftArm", "LeftArm"}, {"RightArm", "RightArm"}};
    for (const Vec3& translation : retargeted(skeleton, motion, map, 0).translate) EXPECT_EQ(translation, Vec3(0));
}

TEST(Retargeting, AFurtherTurnTurnsTheWholeBody) {
    Random random(7);
    const Skeleton source = standingBiped({1, 0, 0}), target = standingBiped({0.1, -0.99, 0.1});
    const Motion motion = motionOf(source, movingFrames(random, source, 2));
    MotionMap map;
    map.joints = sameNames(source);
    const Pose straight = retargeted(target, motion, map, 0.03);
    const Quat turn = glm::angleAxis(2.5, Vec3(0, 1, 0));
    map.skeletonFromMotion = glm::mat4_cast(turn);
    const auto before = posedJoints(target, straight),
               after = posedJoints(target, retargeted(target, motion, map, 0.03));
    for (std::size_t j = 0; j < before.size(); ++j)
        EXPECT_LT(glm::length(after[j].position - turn * before[j].position), 1e-6) << target.joints[j].name;
}

/// The same movement from a rest pose that is no posture: but for hubs, every bone lies along x, and each joint's axes
/// are turned about its bone at will, as some programs write them.
Motion throughFlatRest(const Skeleton& body, const std::vector<Pose>& frames) {
    Skeleton flat = body;
    std::vector<Quat> axes(body.joints.size(), Quat(1, 0, 0, 0));  // from a joint's flat axes to the body's
    for (std::size_t j = 0; j < flat.joints.size(); ++j) {
        const auto children = body.childrenOf(int(j));
        if (j > 0) {
            const std::size_t parent = std::size_t(flat.joints[j].parent);
            const Vec3 bone = body.joints[j].at - body.joints[parent].at;
            flat.joints[j].at = flat.joints[parent].at + glm::conjugate(axes[parent]) * bone;
        }
        if (children.size() != 1) continue;
        const Vec3 bone = body.joints[std::size_t(children.front())].at - body.joints[j].at;
        axes[j] = shortestArc(Vec3(1, 0, 0), bone) * glm::angleAxis(1.0 + double(j), Vec3(1, 0, 0));
    }
    std::vector<Pose> flatFrames;
    for (Pose pose : frames) {
        for (std::size_t j = 0; j < axes.size(); ++j) {
            const int parent = body.joints[j].parent;
            const Quat above = parent == Joint::kNoParent ? Quat(1, 0, 0, 0) : axes[std::size_t(parent)];
            pose.rotate[j] = glm::conjugate(above) * pose.rotate[j] * axes[j];
        }
        flatFrames.push_back(std::move(pose));
    }
    return motionOf(flat, flatFrames);
}

TEST(Retargeting, ARestPoseThatIsNoPostureIsNotBelieved) {
    Random random(9);
    const Skeleton body = standingBiped({1, 0, 0});
    std::vector<Pose> frames = movingFrames(random, body, 3);
    frames[1] = restPose(body);
    frames[1].rotate[0] = glm::angleAxis(2.0, Vec3(0, 1, 0));  // here it stands, turned away
    const Motion motion = throughFlatRest(body, frames);
    MotionMap map;
    map.joints = sameNames(body);
    for (int frame = 0; frame < 3; ++frame) {
        const Pose& wanted = frames[std::size_t(frame)];
        const auto x = posedJoints(body, retargeted(body, motion, map, 0.1 * frame)), y = posedJoints(body, wanted);
        for (std::size_t j = 0; j < x.size(); ++j) {
            EXPECT_LT(glm::length(x[j].position - y[j].position), 1e-6) << body.joints[j].name;
            // No twist either: that is what tears a body.
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(x[j].linear[c] - y[j].linear[c]), 1e-6);
        }
    }
}

TEST(Retargeting, PlacesWithoutInverseAreRefused) {
    const Skeleton skeleton = standingBiped();
    const Motion motion = motionOf(skeleton, {restPose(skeleton)});
    MotionMap map;
    map.joints = sameNames(skeleton);
    map.skeletonFromMotion = Mat4(0.0);
    EXPECT_THROW(retargeted(skeleton, motion, map, 0), Error);
    map.skeletonFromMotion = Mat4(kNaN);
    EXPECT_THROW(retargeted(skeleton, motion, map, 0), Error);
}

TEST(Retargeting, AMotionWithoutFramesLeavesTheBodyInItsRest) {
    const Skeleton source = standingBiped({1, 0, 0}), target = standingBiped();
    MotionMap map;
    map.joints = sameNames(source);
    const auto ours = posedJoints(target, retargeted(target, motionOf(source, {}), map, 0));
    const std::size_t arm = std::size_t(target.find("LeftArm")), hand = std::size_t(target.find("LeftHand"));
    EXPECT_LT(angle(ours[hand].position - ours[arm].position, Vec3(1, 0, 0)), 1e-6);
}

TEST(ProposedMotionFit, FeetOnTheGroundUpIsUpLeftIsLeft) {
    Random random(8);
    const Skeleton target = standingBiped();
    const Quat zUp = glm::angleAxis(kPi / 2, Vec3(1, 0, 0)), around = glm::angleAxis(kPi, Vec3(0, 0, 1));
    for (const Quat& turn : {Quat(1, 0, 0, 0), zUp, around * zUp, glm::angleAxis(kPi, Vec3(1, 0, 0))}) {
        // Another unit, other arms, another place.
        const Skeleton source = transformed(standingBiped({1, 0, 0}), turn, 25);
        std::vector<Pose> frames = movingFrames(random, source, 2);
        for (Quat& rotation : frames[0].rotate) rotation = Quat(1, 0, 0, 0);
        const Motion motion = motionOf(source, frames);
        MotionMap map;
        map.joints = matchingJoints(target, motion);
        map.skeletonFromMotion = proposedMotionFit(target, motion, map.joints);
        const Mat3 linear(map.skeletonFromMotion);
        EXPECT_NEAR(std::cbrt(glm::determinant(linear)), 1.0 / 25, 1e-9);
        EXPECT_LT(glm::length(linear * (turn * Vec3(0, 25, 0)) - Vec3(0, 1, 0)), 1e-9);
        EXPECT_LT(glm::length(linear * (turn * Vec3(25, 0, 0)) - Vec3(1, 0, 0)), 1e-9);
        const auto posed = posedJoints(target, retargeted(target, motion, map, 0));
        double low = kInfinity;
        for (const PosedJoint& joint : posed) low = std::min(low, joint.position.y);
        EXPECT_NEAR(low, 1.3, 1e-6);  // as high as the toes at rest
        EXPECT_NEAR(posed[0].position.x, 0, 1e-6);
        EXPECT_NEAR(posed[0].position.z, 0, 1e-6);
        EXPECT_GT(posed[std::size_t(target.find("LeftHand"))].position.x, 3);
        EXPECT_GT(posed[std::size_t(target.find("Head"))].position.y, 16);
    }
}

TEST(ProposedMotionFit, OfItselfIsTheIdentityButForTheFirstFramesPlace) {
    const Skeleton skeleton = standingBiped();
    Pose away = restPose(skeleton);
    away.translate[0] = {40, 3, -20};
    const Motion motion = motionOf(skeleton, {away});
    const Mat4 fit = proposedMotionFit(skeleton, motion, sameNames(skeleton));
    const Mat4 expected = glm::translate(Mat4(1.0), Vec3(-40, -3, 20));
    for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(fit[c] - expected[c]), 1e-9);
}

TEST(ProposedMotionFit, NeedsTwoJoints) {
    const Skeleton skeleton = standingBiped();
    const Motion motion = motionOf(skeleton, {restPose(skeleton)});
    EXPECT_THROW(proposedMotionFit(skeleton, motion, {}), Error);
    EXPECT_THROW(proposedMotionFit(skeleton, motion, {{"Hips", "Hips"}}), Error);
    EXPECT_THROW(proposedMotionFit(skeleton, motion, {{"Hips", "Hips"}, {"Head", "nobody"}}), Error);
}

}  // namespace
}  // namespace voledit
