#include "app/editor/tools/actor_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/app/editor/actor_rig.h"

namespace voledit {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ActorViewTest : public testing::Test {
protected:
    ActorViewTest() { test::openActor(workspace); }
    JointRef named(const std::string& name) const {
        return jointNamed(workspace.document.scene(), &workspace.compiled, workspace.selection, name);
    }
    std::optional<JointHit> hit(const Vec2& at) const {
        return jointAt(workspace.compiled, workspace.camera, workspace.viewSize, at, 9);
    }
    Workspace workspace;
};

TEST_F(ActorViewTest, JointsAreNamedAloneOrWithTheirActor) {
    EXPECT_EQ(named("LeftHand").joint, 4);
    EXPECT_EQ(named("body/LeftHand").joint, 4);
    try {
        named("LeftFoot");
        FAIL() << "there is no such joint";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("LeftFoot"), HasSubstr("body: Hips, Chest"), HasSubstr("RightHand")));
    }
}

TEST_F(ActorViewTest, TheActorMeantIsTheSelectedOneOrTheOnlyOne) {
    const Scene& scene = workspace.document.scene();
    EXPECT_NE(activeActor(scene, &workspace.compiled, {}), nullptr);
    EXPECT_NE(activeActor(scene, &workspace.compiled, {"", {}, "/root", {}}), nullptr);
    const Selection other{"", {}, "/root/of", {}};
    EXPECT_EQ(activeActor(scene, &workspace.compiled, other), nullptr);
    EXPECT_NE(meantActor(scene, &workspace.compiled, other), nullptr);
    EXPECT_EQ(meantActor(scene, nullptr, {}), nullptr);
}

TEST_F(ActorViewTest, AJointGoesBeforeTheBonesAboutIt) {
    const auto joint = hit(test::jointPixel(workspace, "LeftForeArm") + Vec2(4, 0));
    ASSERT_TRUE(joint);
    EXPECT_EQ(joint->of.joint, 3);
    EXPECT_EQ(joint->to, -1);
    const Vec2 middle = 0.5 * (test::jointPixel(workspace, "LeftForeArm") + test::jointPixel(workspace, "LeftHand"));
    const auto bone = hit(middle + Vec2(0, 3));
    ASSERT_TRUE(bone);
    EXPECT_EQ(bone->of.joint, 3);
    EXPECT_EQ(bone->to, 4);
    EXPECT_NEAR(bone->at.x, 1.6, 1e-6);
    EXPECT_FALSE(hit({5, 5}));
}

TEST_F(ActorViewTest, OfJointsBehindEachOtherTheNearerIsTaken) {
    // Along the bar: all of the arms' joints lie behind each other.
    workspace.camera.eye = {100, 0, 1};
    workspace.camera.target = {0, 0, 1};
    const auto joint = hit(0.5 * Vec2(workspace.viewSize));
    ASSERT_TRUE(joint);
    EXPECT_EQ(joint->of.actor->skeleton.joints[std::size_t(joint->of.joint)].name, "LeftHand_End");
}

TEST_F(ActorViewTest, TheLimbsOfAJointBeginThereElseEndThere) {
    const ActorPtr actor = test::actorIn(workspace);
    EXPECT_THAT(limbsFrom(*actor, 2), ElementsAre(1));
    EXPECT_THAT(editedLimbs(*actor, 2), ElementsAre(1));
    EXPECT_THAT(editedLimbs(*actor, 5), ElementsAre(3));  // the hand's tip
    EXPECT_THAT(limbsFrom(*actor, 5), ElementsAre());
}

}  // namespace
}  // namespace voledit
