#include "core/skeleton/skeleton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "random_skeletons.h"

namespace voledit {
namespace {

using testing::HasSubstr;

Joint named(const std::string& name, const Vec3& at = Vec3(0)) {
    return {name, Joint::kNoParent, at, {}};
}

std::string messageOf(std::vector<Joint> joints, const std::vector<std::string>& parents) {
    try {
        makeSkeleton(std::move(joints), parents);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

double distance(const Mat3& a, const Mat3& b) {
    return std::max({glm::length(a[0] - b[0]), glm::length(a[1] - b[1]), glm::length(a[2] - b[2])});
}

TEST(Skeleton, ParentsComeBeforeChildrenAndTheRestKeepsItsOrder) {
    const Skeleton skeleton = makeSkeleton({named("hand"), named("root"), named("arm"), named("leg"), named("lone")},
                                           {"arm", "", "root", "root", ""});
    std::vector<std::string> names;
    for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
    EXPECT_EQ(names, (std::vector<std::string>{"root", "arm", "hand", "leg", "lone"}));
    EXPECT_EQ(skeleton.joints[0].parent, Joint::kNoParent);
    EXPECT_EQ(skeleton.joints[1].parent, 0);
    EXPECT_EQ(skeleton.joints[2].parent, 1);
    EXPECT_EQ(skeleton.joints[3].parent, 0);
    EXPECT_EQ(skeleton.find("hand"), 2);
    EXPECT_EQ(skeleton.find("tail"), -1);
    EXPECT_EQ(skeleton.childrenOf(0), (std::vector<int>{1, 3}));
    EXPECT_EQ(skeleton.childrenOf(Joint::kNoParent), (std::vector<int>{0, 4}));
}

TEST(Skeleton, JointsInOrderStayAsTheyAre) {
    Random random(1);
    const Skeleton skeleton = randomSkeleton(random, 200);
    std::vector<std::string> parents;
    for (const Joint& joint : skeleton.joints)
        parents.push_back(joint.parent < 0 ? "" : skeleton.joints[std::size_t(joint.parent)].name);
    EXPECT_EQ(makeSkeleton(skeleton.joints, parents), skeleton);
}

TEST(Skeleton, RefusalsNameTheJoint) {
    EXPECT_THAT(messageOf({named("a"), named("b")}, {"", "tail"}), HasSubstr("'b': its parent 'tail' is missing"));
    EXPECT_THAT(messageOf({named("a"), named("a")}, {"", ""}), HasSubstr("'a': its name is given twice"));
    EXPECT_THAT(messageOf({named("a"), named("")}, {"", "a"}), HasSubstr("joint 1: it has no name"));
    EXPECT_THAT(messageOf({named("a", {0, kNaN, 0})}, {""}), HasSubstr("'a': its position is not finite"));
    EXPECT_THAT(messageOf({named("a", {kInfinity, 0, 0})}, {""}), HasSubstr("'a': its position is not finite"));
    EXPECT_THAT(messageOf({named("a")}, {"a"}), HasSubstr("'a': it is its own ancestor"));
    EXPECT_THAT(messageOf({named("a"), named("b"), named("c"), named("d")}, {"", "d", "b", "c"}),
                HasSubstr("it is its own ancestor"));
    Joint knee = named("knee");
    knee.limits = JointLimits{Vec3(0, 0, 10), Vec3(0, 0, 9)};
    EXPECT_THAT(messageOf({knee}, {""}), HasSubstr("'knee': its limits about z leave no angle"));
    knee.limits = JointLimits{Vec3(0, kNaN, 0), Vec3(0)};
    EXPECT_THAT(messageOf({knee}, {""}), HasSubstr("'knee': its limits about y leave no angle"));
}

/// A chain whose last joint stands first: `count` joints deep for one that walks upwards.
std::string chainMessage(std::size_t count, bool circle) {
    std::vector<Joint> joints;
    std::vector<std::string> parents;
    for (std::size_t j = count; j-- > 0;) {
        joints.push_back(named("j" + std::to_string(j)));
        parents.push_back(j > 0 ? "j" + std::to_string(j - 1) : circle ? "j" + std::to_string(count - 1) : "");
    }
    return messageOf(std::move(joints), parents);
}

TEST(Skeleton, DeepChains) {
    EXPECT_EQ(chainMessage(kMostJoints, false), "");
    EXPECT_THAT(chainMessage(kMostJoints, true), HasSubstr("circle"));
    EXPECT_THAT(chainMessage(kMostJoints + 1, false), HasSubstr("10001 joints are too many"));
    EXPECT_THAT(chainMessage(100'000, false), HasSubstr("100000 joints are too many"));
}

TEST(ForwardKinematics, RestIsRestToTheBit) {
    Random random(2);
    for (int n = 0; n < 50; ++n) {
        const Skeleton skeleton = randomSkeleton(random, 40);
        const auto posed = posedJoints(skeleton, restPose(skeleton));
        const Mat4 fit(Vec4(randomVector(random, 2), 0), Vec4(randomVector(random, 2), 0),
                       Vec4(randomVector(random, 2), 0), Vec4(randomVector(random, 9), 1));
        const auto laid = laidInto(posed, fit);
        const Skeleton laidSkeleton = laidInto(skeleton, fit);
        for (std::size_t j = 0; j < posed.size(); ++j) {
            EXPECT_EQ(posed[j].position, skeleton.joints[j].at);
            EXPECT_EQ(posed[j].linear, Mat3(1));
            EXPECT_EQ(laid[j].position, laidSkeleton.joints[j].at);
            EXPECT_EQ(laid[j].linear, Mat3(1));
        }
    }
}

TEST(ForwardKinematics, IsTheProductOfTheJointsMatrices) {
    Random random(3);
    for (int n = 0; n < 50; ++n) {
        const Skeleton skeleton = randomSkeleton(random, 30);
        const Pose pose = randomPose(random, skeleton, 0.5);
        const auto posed = posedJoints(skeleton, pose);
        std::vector<Mat4> global;
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
            const Joint& joint = skeleton.joints[j];
            const bool root = joint.parent == Joint::kNoParent;
            const Vec3 bone = root ? joint.at : joint.at - skeleton.joints[std::size_t(joint.parent)].at;
            Mat4 local = glm::mat4_cast(pose.rotate[j]);
            local[3] = Vec4(bone + pose.translate[j], 1);
            global.push_back(root ? local : global[std::size_t(joint.parent)] * local);
            EXPECT_LT(glm::length(posed[j].position - Vec3(global[j][3])), 1e-13);
            EXPECT_LT(distance(posed[j].linear, Mat3(global[j])), 1e-13);
        }
    }
}

TEST(ForwardKinematics, LaidIntoAnObjectTheRigidMapsAreConjugated) {
    Random random(4);
    const Skeleton skeleton = randomSkeleton(random, 20);
    const auto posed = posedJoints(skeleton, randomPose(random, skeleton));
    Mat4 fit(1.0);
    fit[0] = {2, 0.3, 0, 0};
    fit[1] = {0, -1, 0.5, 0};
    fit[2] = {0.1, 0, 3, 0};
    fit[3] = {7, 8, 9, 1};
    const auto laid = laidInto(posed, fit);
    for (std::size_t j = 0; j < posed.size(); ++j) {
        // A point fixed to the joint, carried and then laid in, or laid in and then carried.
        const Vec3 rest = skeleton.joints[j].at, q = rest + randomVector(random, 1);
        const Vec3 carried = posed[j].position + posed[j].linear * (q - rest);
        const Vec3 laidQ = Vec3(fit * Vec4(q, 1)), laidRest = Vec3(fit * Vec4(rest, 1));
        const Vec3 expected = Vec3(fit * Vec4(carried, 1));
        EXPECT_LT(glm::length(laid[j].position + laid[j].linear * (laidQ - laidRest) - expected), 1e-12);
    }
}

TEST(Pose, InterpolationGoesFromOneToTheOther) {
    Random random(5);
    const Skeleton skeleton = randomSkeleton(random, 20);
    const Pose a = randomPose(random, skeleton, 1), b = randomPose(random, skeleton, 1);
    EXPECT_EQ(interpolated(a, b, 0), a);
    EXPECT_EQ(interpolated(a, a, 0.3), a);
    for (const double s : {0.2, 0.5, 1.0}) {
        const Pose pose = interpolated(a, b, s);
        for (std::size_t j = 0; j < a.rotate.size(); ++j) {
            EXPECT_LT(glm::length(pose.translate[j] - glm::mix(a.translate[j], b.translate[j], s)), 1e-15);
            // The angle from a grows in proportion, along the shorter of both ways.
            const auto angle = [](const Quat& from, const Quat& to) {
                return 2 * std::acos(std::min(1.0, std::abs(glm::dot(from, to))));
            };
            const double whole = angle(a.rotate[j], b.rotate[j]);
            EXPECT_NEAR(angle(a.rotate[j], pose.rotate[j]), s * whole, 1e-7);
            EXPECT_NEAR(angle(pose.rotate[j], b.rotate[j]), (1 - s) * whole, 1e-7);
        }
    }
}

}  // namespace
}  // namespace voledit
