#include "core/skeleton/ik.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "core/base/error.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

using testing::HasSubstr;

/// root – j1 – … – jn with the given bones, below a turned parent that no chain may move.
Skeleton chainOf(const std::vector<Vec3>& bones) {
    Skeleton skeleton;
    skeleton.joints.push_back({"pelvis", Joint::kNoParent, Vec3(-1, 2, 3), {}});
    skeleton.joints.push_back({"root", 0, Vec3(0, 2, 3), {}});
    for (const Vec3& bone : bones) {
        const int parent = int(skeleton.joints.size()) - 1;
        skeleton.joints.push_back({"j" + std::to_string(parent), parent, skeleton.joints.back().at + bone, {}});
    }
    return skeleton;
}

Pose turnedBelowPelvis(Random& random, const Skeleton& skeleton) {
    Pose pose = randomPose(random, skeleton, 0);
    return pose;
}

Vec3 endOf(const Skeleton& skeleton, const Pose& pose) {
    return posedJoints(skeleton, pose).back().position;
}

void expectFinite(const Pose& pose) {
    for (const Quat& q : pose.rotate) EXPECT_NEAR(glm::length(q), 1, 1e-12);
    for (const Vec3& t : pose.translate) EXPECT_TRUE(isDefined(t));
}

/// Only the chain's own joints may turn, and no bone may change its length.
void expectOnlyTheChainTurns(const Skeleton& skeleton, const Pose& before, const Pose& after, const IkGoal& goal) {
    std::vector<bool> turns(skeleton.joints.size(), false);
    int j = goal.joint;
    for (int n = 0; n < goal.chain && skeleton.joints[std::size_t(j)].parent >= 0; ++n) {
        j = skeleton.joints[std::size_t(j)].parent;
        turns[std::size_t(j)] = true;
    }
    for (std::size_t k = 0; k < turns.size(); ++k) EXPECT_TRUE(turns[k] || after.rotate[k] == before.rotate[k]) << k;
    EXPECT_EQ(after.translate, before.translate);
}

TEST(Ik, TwoBonesReachToRounding) {
    Random random(1);
    for (int n = 0; n < 500; ++n) {
        const double a = randomNumber(random, 0.3, 2), b = n % 5 ? randomNumber(random, 0.3, 2) : a;
        const Skeleton skeleton =
            chainOf({randomRotation(random) * Vec3(a, 0, 0), randomRotation(random) * Vec3(0, b, 0)});
        const Pose pose = turnedBelowPelvis(random, skeleton);
        const Vec3 root = posedJoints(skeleton, pose)[1].position;
        const double reach = n % 7 == 0   ? a + b
                             : n % 7 == 1 ? std::abs(a - b)
                                          : randomNumber(random, std::abs(a - b), a + b);
        IkGoal goal{3, root + randomRotation(random) * Vec3(reach, 0, 0), 2, {}};
        if (n % 2) goal.pole = root + randomVector(random, 5);
        const Pose result = solved(skeleton, pose, goal);
        expectFinite(result);
        EXPECT_LT(glm::length(endOf(skeleton, result) - goal.target), 1e-13 * (a + b) + 1e-14);
        expectOnlyTheChainTurns(skeleton, pose, result, goal);
    }
}

TEST(Ik, TheElbowGoesTowardsThePole) {
    Random random(2);
    for (int n = 0; n < 200; ++n) {
        const Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0.2, 0, 1.1)});
        const Pose pose = turnedBelowPelvis(random, skeleton);
        const Vec3 root = posedJoints(skeleton, pose)[1].position;
        const Vec3 direction = glm::normalize(randomVector(random, 1)), pole = root + randomVector(random, 4);
        const Pose result = solved(skeleton, pose, {3, root + 1.5 * direction, 2, pole});
        const auto across = [&](const Vec3& v) { return v - direction * glm::dot(v, direction); };
        const Vec3 elbow = across(posedJoints(skeleton, result)[2].position - root), wanted = across(pole - root);
        EXPECT_NEAR(glm::dot(glm::normalize(elbow), glm::normalize(wanted)), 1, 1e-12);
    }
}

TEST(Ik, WithoutAPoleTheElbowStaysInItsPlane) {
    // The target moves within the plane of the bend: elbow and hand stay in it, on the same side.
    const Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0, 0.5, 1)});
    const Vec3 root = skeleton.joints[1].at;
    for (const double angle : {-2.0, -0.5, 0.0, 0.7, 2.5}) {
        const Vec3 direction(0, std::sin(angle), std::cos(angle));
        const auto joints =
            posedJoints(skeleton, solved(skeleton, restPose(skeleton), {3, root + 1.2 * direction, 2, {}}));
        EXPECT_NEAR(joints[2].position.x, root.x, 1e-14);
        // At rest the elbow lies towards −y of the line from root to hand, that is, to its left seen from +x.
        EXPECT_GT(glm::cross(direction, joints[2].position - root).x, 0.1);
    }
}

TEST(Ik, TheHingeStaysAHingeInTheLimb) {
    // The elbow bends about the limb's own axis: the forearm's local rotation keeps the axis that it had.
    Random random(3);
    const Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0, 0, 1)});
    for (int n = 0; n < 100; ++n) {
        Pose pose = turnedBelowPelvis(random, skeleton);
        const Vec3 axis = glm::normalize(Vec3(randomNumber(random, -1, 1), randomNumber(random, -1, 1), 0));
        pose.rotate[2] = glm::angleAxis(randomNumber(random, 0.3, 2.5), axis);
        const Vec3 root = posedJoints(skeleton, pose)[1].position;
        IkGoal goal{3, root + randomRotation(random) * Vec3(randomNumber(random, 0.1, 1.9), 0, 0), 2, {}};
        if (n % 2) goal.pole = root + randomVector(random, 3);
        const Quat elbow = solved(skeleton, pose, goal).rotate[2];
        EXPECT_LT(glm::length(glm::cross(Vec3(elbow.x, elbow.y, elbow.z), axis)), 1e-9);
    }
}

TEST(Ik, OutOfReachTheChainPointsAlong) {
    Random random(4);
    for (int bones = 1; bones <= 5; ++bones)
        for (int n = 0; n < 20; ++n) {
            std::vector<Vec3> vectors;
            double length = 0;
            for (int b = 0; b < bones; ++b) {
                vectors.push_back(randomVector(random, 1));
                length += glm::length(vectors.back());
            }
            const Skeleton skeleton = chainOf(vectors);
            const Pose pose = turnedBelowPelvis(random, skeleton);
            const Vec3 root = posedJoints(skeleton, pose)[1].position,
                       direction = glm::normalize(randomVector(random, 1));
            const IkGoal goal{bones + 1, root + (length * randomNumber(random, 1.001, 4)) * direction, bones, {}};
            const Pose result = solved(skeleton, pose, goal);
            EXPECT_LT(glm::length(endOf(skeleton, result) - (root + length * direction)), 1e-12 * length);
            expectOnlyTheChainTurns(skeleton, pose, result, goal);
        }
}

TEST(Ik, TooNearTheChainFoldsAsFarAsItCan) {
    const Skeleton skeleton = chainOf({Vec3(0, 0, 2), Vec3(0, 0.1, 0.5)});
    const double upper = 2, lower = glm::length(Vec3(0, 0.1, 0.5));
    const Vec3 root = skeleton.joints[1].at;
    const Vec3 target = root + Vec3(0.3, 0.4, 0);
    const Vec3 end = endOf(skeleton, solved(skeleton, restPose(skeleton), {3, target, 2, {}}));
    EXPECT_NEAR(glm::length(end - target), upper - lower - 0.5, 1e-14);
}

TEST(Ik, ChainsReachWhatIsInReach) {
    Random random(5);
    for (int bones = 3; bones <= 8; ++bones)
        for (int n = 0; n < 40; ++n) {
            std::vector<Vec3> vectors;
            double length = 0;
            for (int b = 0; b < bones; ++b) {
                vectors.push_back(randomRotation(random) * Vec3(0, 0, randomNumber(random, 0.5, 1)));
                length += glm::length(vectors.back());
            }
            const Skeleton skeleton = chainOf(vectors);
            const Pose pose = turnedBelowPelvis(random, skeleton);
            const Vec3 root = posedJoints(skeleton, pose)[1].position;
            IkGoal goal{bones + 1,
                        root + randomRotation(random) * Vec3(length * randomNumber(random, 0, 0.9999), 0, 0),
                        bones,
                        {}};
            if (n % 3 == 0) goal.pole = root + randomVector(random, 5);
            const Pose result = solved(skeleton, pose, goal);
            expectFinite(result);
            EXPECT_LT(glm::length(endOf(skeleton, result) - goal.target), 1e-6 * length);
            expectOnlyTheChainTurns(skeleton, pose, result, goal);
        }
}

TEST(Ik, LimitsHold) {
    Random random(6);
    for (int n = 0; n < 100; ++n) {
        Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 0.5)});
        const JointLimits ball{Vec3(-60, -40, -20), Vec3(80, 50, 30)}, hinge{Vec3(-140, 0, 0), Vec3(0)};
        skeleton.joints[1].limits = ball;
        skeleton.joints[2].limits = hinge;
        Pose within = restPose(skeleton);
        const auto inside = [&](const JointLimits& limits) {
            return quatOfDegrees(limits.min + (limits.max - limits.min) * (0.5 * (randomVector(random, 1) + 1.0)));
        };
        within.rotate[1] = inside(ball);
        within.rotate[2] = inside(hinge);
        const Vec3 reachable = posedJoints(skeleton, within)[3].position;
        const Vec3 anywhere = skeleton.joints[1].at + randomVector(random, 2);
        for (const Vec3& target : {reachable, anywhere})
            for (const int chain : {2, 3}) {
                const IkGoal goal{chain + 1, target, chain, {}};
                const Pose result = solved(skeleton, restPose(skeleton), goal);
                expectFinite(result);
                for (const std::size_t j : {1, 2}) {
                    const JointLimits& limits = *skeleton.joints[j].limits;
                    const Vec3 degrees = degreesOf(result.rotate[j]);
                    for (int a = 0; a < 3; ++a) {
                        EXPECT_GE(degrees[a], limits.min[a] - 1e-9);
                        EXPECT_LE(degrees[a], limits.max[a] + 1e-9);
                    }
                }
                expectOnlyTheChainTurns(skeleton, restPose(skeleton), result, goal);
                const double missed = glm::length(posedJoints(skeleton, result)[3].position - target);
                const bool twoBonesCan = chain == 2 && target == reachable;
                EXPECT_TRUE(!twoBonesCan || missed < 2e-6) << n << ": " << missed;
            }
    }
}

TEST(Ik, LimitsThatAreNotInTheWayChangeNothing) {
    Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0.3, 0, 1)});
    const IkGoal goal{3, skeleton.joints[1].at + Vec3(0.5, 0.6, 0.7), 2, Vec3(9, 2, 3)};
    const Pose free = solved(skeleton, restPose(skeleton), goal);
    for (Joint& joint : skeleton.joints) joint.limits = JointLimits{Vec3(-179), Vec3(179)};
    EXPECT_EQ(solved(skeleton, restPose(skeleton), goal), free);
}

TEST(Ik, DegenerateGoalsStayFinite) {
    Random random(7);
    const std::vector<std::vector<Vec3>> chains{{Vec3(0, 0, 1)},
                                                {Vec3(0, 0, 1), Vec3(0, 0, 1)},
                                                {Vec3(0, 0, 1), Vec3(0, 0, -1)},
                                                {Vec3(0, 0, 1), Vec3(0)},
                                                {Vec3(0), Vec3(0, 0, 1)},
                                                {Vec3(0), Vec3(0)},
                                                {Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)},
                                                {Vec3(0, 0, 1), Vec3(0), Vec3(0, 0, 1)}};
    for (const auto& bones : chains) {
        const Skeleton skeleton = chainOf(bones);
        const int joint = int(bones.size()) + 1;
        const Vec3 root = skeleton.joints[1].at, end = skeleton.joints.back().at;
        const std::vector<Vec3> targets{root,
                                        end,
                                        0.5 * (root + end),
                                        root + 3.0 * (root - end),
                                        root + 0.3 * (root - end),
                                        root + Vec3(1e-200, 0, 0),
                                        root + Vec3(1e200, 0, 0)};
        for (const Vec3& target : targets)
            for (const int chain : {0, 1, 2, 50})
                for (const std::optional<Vec3>& pole :
                     {std::optional<Vec3>(), std::optional(root), std::optional(end)}) {
                    const Pose result = solved(skeleton, restPose(skeleton), {joint, target, chain, pole});
                    expectFinite(result);
                    for (const PosedJoint& posed : posedJoints(skeleton, result))
                        EXPECT_TRUE(isDefined(posed.position));
                }
    }
}

TEST(Ik, AStraightArmBendsToATargetOnItsLine) {
    for (const int bones : {2, 3, 6}) {
        const Skeleton skeleton = chainOf(std::vector<Vec3>(std::size_t(bones), Vec3(1, 0, 0)));
        const Vec3 target = skeleton.joints[1].at + Vec3(0.6 * bones, 0, 0);
        const Pose result = solved(skeleton, restPose(skeleton), {bones + 1, target, bones, {}});
        EXPECT_LT(glm::length(endOf(skeleton, result) - target), 1e-6 * bones);
    }
}

TEST(Ik, TheTargetWhereTheEndIsChangesNothing) {
    Random random(8);
    const Skeleton skeleton = chainOf({Vec3(0, 0, 1), Vec3(0, 0.5, 1)});
    const Pose pose = turnedBelowPelvis(random, skeleton);
    const auto before = posedJoints(skeleton, pose);
    const auto after = posedJoints(skeleton, solved(skeleton, pose, {3, before[3].position, 2, {}}));
    for (std::size_t j = 0; j < before.size(); ++j)
        EXPECT_LT(glm::length(after[j].position - before[j].position), 1e-13);
}

TEST(Ik, Refusals) {
    const Skeleton skeleton = chainOf({Vec3(0, 0, 1)});
    for (const int joint : {-1, 3}) EXPECT_THROW(solved(skeleton, restPose(skeleton), {joint, Vec3(0), 2, {}}), Error);
    EXPECT_THROW(solved(skeleton, restPose(skeleton), {2, Vec3(kNaN, 0, 0), 2, {}}), Error);
    EXPECT_THROW(solved(skeleton, restPose(skeleton), {2, Vec3(0), 2, Vec3(0, kInfinity, 0)}), Error);
    // The root has no bone above it.
    EXPECT_EQ(solved(skeleton, restPose(skeleton), {0, Vec3(9), 2, {}}), restPose(skeleton));
}

TEST(Limited, KeepsWhatIsWithin) {
    Random random(9);
    const JointLimits limits{Vec3(-30, -20, -10), Vec3(170, 150, 90)};
    for (int n = 0; n < 300; ++n) {
        // Also with y beyond 90°, which has two sets of angles.
        const Vec3 degrees = limits.min + (limits.max - limits.min) * (0.5 * (randomVector(random, 1) + 1.0));
        const Quat rotation = quatOfDegrees(degrees);
        EXPECT_EQ(limited(rotation, limits), rotation) << degrees.x << " " << degrees.y << " " << degrees.z;
    }
}

TEST(Limited, ClampsEachAngle) {
    const JointLimits limits{Vec3(-30, -20, -10), Vec3(40, 50, 60)};
    const auto expectLimited = [&](const Vec3& degrees, const Vec3& expected) {
        EXPECT_LT(glm::length(degreesOf(limited(quatOfDegrees(degrees), limits)) - expected), 1e-11);
    };
    expectLimited({90, 0, 0}, {40, 0, 0});
    expectLimited({-90, 10, 20}, {-30, 10, 20});
    expectLimited({0, -80, 0}, {0, -20, 0});
    expectLimited({0, 0, 150}, {0, 0, 60});
    expectLimited({0, 0, -150}, {0, 0, -10});
    expectLimited({50, 60, 70}, {40, 50, 60});
    // Around the back: −170° is nearer to 170° than to −30°.
    EXPECT_LT(glm::length(degreesOf(limited(quatOfDegrees({0, 0, -170}), {Vec3(0, 0, -30), Vec3(0, 0, 170)})) -
                          Vec3(0, 0, 170)),
              1e-11);
}

}  // namespace
}  // namespace voledit
