#include "app/editor/tools/joint_edits.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/app/editor/actor_rig.h"

namespace voledit {
namespace {

class JointEditsTest : public testing::Test {
protected:
    JointEditsTest() { test::openActor(workspace); }
    const CompiledActor& actor() const { return *workspace.compiled.actors.at(0); }
    int find(const std::string& joint) const { return actor().skeleton.find(joint); }
    /// Writes `pose` and compiles what comes of it.
    void put(const Pose& pose) {
        const ActorPtr before = workspace.compiled.actors.at(0);
        workspace.document.apply("Pose", [&](Scene& scene) { setPose(scene, *before, pose, {}); });
        test::recompile(workspace);
    }
    void expectPose(const Pose& wanted) const {
        for (std::size_t j = 0; j < wanted.rotate.size(); ++j) {
            EXPECT_NEAR(std::abs(glm::dot(actor().pose.rotate[j], wanted.rotate[j])), 1, 1e-12) << j;
            EXPECT_LT(glm::distance(actor().pose.translate[j], wanted.translate[j]), 1e-12) << j;
        }
    }
    Workspace workspace;
};

TEST_F(JointEditsTest, HandsAndFeetTurnTwoBonesOthersUpToTheBranch) {
    const Skeleton& skeleton = actor().skeleton;
    EXPECT_EQ(usualChain(skeleton, find("LeftHand")), 2);
    EXPECT_EQ(usualChain(skeleton, find("LeftHand_End")), 3);
    EXPECT_EQ(usualChain(skeleton, find("LeftForeArm")), 1);
    EXPECT_EQ(usualChain(skeleton, find("LeftArm")), 1);  // at the branch itself one bone turns all the same
    EXPECT_EQ(usualChain(skeleton, find("Chest")), 1);
    Skeleton named;
    for (const char* name : {"root", "a", "b", "c", "foot.L"})
        named.joints.push_back({name, int(named.joints.size()) - 1, Vec3(0, 0, double(named.joints.size())), {}});
    EXPECT_EQ(usualChain(named, 4), 2);
    EXPECT_EQ(usualChain(named, 3), 3);
}

TEST_F(JointEditsTest, APoseThatIsWrittenIsThePoseThatIsShown) {
    Pose pose = actor().pose;
    pose.rotate[std::size_t(find("LeftArm"))] = quatOfDegrees({20, -130, 40});
    pose.rotate[std::size_t(find("Hips"))] = quatOfDegrees({0, 95, -170});
    pose.translate[0] = {0.25, -1, 2};
    put(pose);
    expectPose(pose);
    // Once more, from there.
    pose.rotate[std::size_t(find("LeftArm"))] = quatOfDegrees({-60, 10, 5});
    pose.translate[0] = {};
    put(pose);
    expectPose(pose);
}

TEST_F(JointEditsTest, OnTopOfAMotionTheOwnRotationIsWhatIsLeft) {
    CompiledActor moved = actor();
    const auto arm = std::size_t(find("LeftArm"));
    moved.motionPose.rotate[arm] = quatOfDegrees({0, 40, 0});
    moved.pose.rotate[arm] = quatOfDegrees({0, 50, 0});
    Pose pose = moved.pose;
    pose.rotate[arm] = quatOfDegrees({0, 70, 0});
    const Vec3 own = degreesOf(ownRotation(moved, pose, int(arm)));
    EXPECT_LT(glm::distance(own, Vec3(0, 30, 0)), 1e-9);
}

TEST_F(JointEditsTest, TurningAboutAWorldAxisIsTheSameForEveryFit) {
    for (const double scale : {1.0, -1.0}) {
        workspace.document.apply("Fit", [&](Scene& scene) {
            editRig(scene, "/root", [&](ActorRig& rig) {
                rig.skeleton.fit.scale = Vec3(1, scale, 1);
                rig.skeleton.fit.rotate = Vec3(0, 0, 30);
            });
        });
        test::recompile(workspace);
        const int arm = find("LeftArm"), below = find("LeftForeArm");
        const Vec3 before = shownJoint(actor(), below) - shownJoint(actor(), arm);
        put(turned(actor(), {arm}, {std::nullopt, Vec3(0, 0, 1)}, 90));
        const Vec3 after = shownJoint(actor(), below) - shownJoint(actor(), arm);
        EXPECT_LT(glm::distance(after, Vec3(-before.y, before.x, before.z)), 1e-9) << "scale " << scale;
        workspace.document.undo();
        workspace.document.undo();
        test::recompile(workspace);
    }
}

}  // namespace
}  // namespace voledit
