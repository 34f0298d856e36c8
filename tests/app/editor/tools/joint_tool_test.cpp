#include "app/editor/tools/joint_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/editor/node_actions.h"
#include "app/editor/theme.h"
#include "core/base/error.h"
#include "core/rigging/curve_skeleton.h"
#include "tests/app/editor/actor_rig.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class JointToolTest : public testing::Test {
protected:
    JointToolTest() { test::openActor(workspace); }

    Vec2 pixel(const std::string& joint) const { return test::jointPixel(workspace, joint); }
    Vec3 at(const std::string& joint) const { return test::jointIn(workspace, joint); }
    Vec3 degrees(const std::string& joint) const { return test::degreesIn(workspace, joint); }
    Document& document() { return workspace.document; }
    void selectJoint(const std::string& name) { workspace.selection = {"", {}, "/root", {name}}; }
    double length(const std::string& a, const std::string& b) const { return glm::distance(at(a), at(b)); }
    void expectNear(const Vec3& a, const Vec3& b, double tolerance) const {
        EXPECT_LT(glm::distance(a, b), tolerance)
            << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
    }

    Workspace workspace;
    ViewportTools tools;
    test::Hand hand{workspace, tools};
};

TEST_F(JointToolTest, ADraggedHandEndsUnderThePointerByTwoBones) {
    const double upper = length("LeftArm", "LeftForeArm"), fore = length("LeftForeArm", "LeftHand");
    const Vec2 to = pixel("LeftHand") + Vec2(-70, -60);
    hand.drag(pixel("LeftHand"), to);
    EXPECT_LT(glm::distance(pixel("LeftHand"), to), 1e-3);
    EXPECT_THAT(document().undoNames(), ElementsAre("Pose LeftHand"));
    EXPECT_NEAR(length("LeftArm", "LeftForeArm"), upper, 1e-9);
    EXPECT_NEAR(length("LeftForeArm", "LeftHand"), fore, 1e-9);
    std::vector<std::string> turned;
    for (const auto& [joint, degree] : poseOf(document().scene(), "/root", 0)) turned.push_back(joint);
    EXPECT_THAT(turned, ElementsAre("LeftArm", "LeftForeArm"));
    EXPECT_THAT(workspace.selection.joints, ElementsAre("LeftHand"));
    EXPECT_EQ(workspace.selection.node, "/root");
}

TEST_F(JointToolTest, ATargetOutOfReachStretchesTheArmTowardsIt) {
    hand.drag(pixel("LeftHand"), pixel("LeftHand") + Vec2(30, -300));
    EXPECT_NEAR(length("LeftArm", "LeftHand"), 1.6, 1e-6);
    EXPECT_GT(at("LeftHand").z, 1.5);
}

TEST_F(JointToolTest, UndoTakesADragBackAndEscapeLeavesNothing) {
    const Scene before = document().scene();
    hand.drag(pixel("LeftHand"), pixel("LeftHand") + Vec2(-40, -60));
    EXPECT_NE(document().scene(), before);
    EXPECT_TRUE(document().undo());
    EXPECT_EQ(document().scene(), before);
    test::recompile(workspace);
    hand.dragTo(pixel("LeftHand"), pixel("LeftHand") + Vec2(-40, -60));
    EXPECT_NE(document().scene(), before);
    EXPECT_TRUE(hand.key("Escape"));
    EXPECT_EQ(document().scene(), before);
    hand.up({1, 1});
    EXPECT_TRUE(tools.joints().idle());
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(JointToolTest, TheRootMovesAndTakesAllAlong) {
    const Vec3 hips = at("Hips"), handAt = at("RightHand");
    const Vec2 to = pixel("Hips") + Vec2(50, 20);
    hand.drag(pixel("Hips"), to);
    EXPECT_LT(glm::distance(pixel("Hips"), to), 1e-6);
    expectNear(at("RightHand") - handAt, at("Hips") - hips, 1e-12);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move Hips"));
    // And from there once more: displacements do not add up wrongly.
    hand.drag(pixel("Hips"), to - Vec2(50, 20));
    expectNear(at("Hips"), hips, 1e-9);
}

TEST_F(JointToolTest, ABoneDraggedPointsToThePointer) {
    const Vec2 middle = 0.5 * (pixel("LeftForeArm") + pixel("LeftHand"));
    const Vec2 to = pixel("LeftForeArm") + Vec2(0, -40);
    hand.drag(middle, to);
    const Vec2 along = pixel("LeftHand") - pixel("LeftForeArm");
    EXPECT_NEAR(along.x / glm::length(along), 0, 1e-6);
    EXPECT_LT(along.y, 0);
    EXPECT_NEAR(length("LeftForeArm", "LeftHand"), 0.8, 1e-9);
    EXPECT_EQ(degrees("LeftArm"), Vec3(0));
    EXPECT_THAT(workspace.selection.joints, ElementsAre("LeftForeArm"));
}

TEST_F(JointToolTest, TypedDegreesTurnAboutTheJointsOwnAxis) {
    selectJoint("LeftArm");
    hand.move({300, 300});
    ASSERT_TRUE(tools.joints().turn(toolContext(workspace)));
    for (const char* key : {"Y", "-", "3", "0"}) EXPECT_TRUE(hand.key(key));
    EXPECT_EQ(tools.readout(), "Rotate Y -30_°");
    EXPECT_TRUE(hand.key("Enter"));
    expectNear(degrees("LeftArm"), {0, -30, 0}, 1e-9);
    EXPECT_THAT(document().undoNames(), ElementsAre("Rotate LeftArm"));
    expectNear(at("LeftForeArm") - at("LeftArm"), 0.8 * Vec3(std::cos(kPi / 6), 0, 0.5), 1e-9);
}

TEST_F(JointToolTest, TheOwnAxisTurnsWithTheJoint) {
    document().apply("Turn", [](Scene& s) { setJointRotation(s, "/root", "LeftArm", quatOfDegrees({0, -90, 0}), {}); });
    test::recompile(workspace);
    selectJoint("LeftArm");
    tools.joints().turn(toolContext(workspace));
    // About the arm itself, which points up now: the arm stays.
    const Vec3 before = at("LeftForeArm");
    for (const char* key : {"X", "4", "5", "Enter"}) hand.key(key);
    expectNear(at("LeftForeArm"), before, 1e-9);
    EXPECT_NE(degrees("LeftArm"), Vec3(0, -90, 0));
}

TEST_F(JointToolTest, TheMouseTurnsAboutTheView) {
    // The camera looks along +y at the arm's own place: a quarter round on the screen is one in the picture's plane.
    workspace.camera.eye = {0.4, -10, 1};
    workspace.camera.target = {0.4, 0, 1};
    selectJoint("LeftArm");
    const Vec2 pivot = pixel("LeftArm");
    hand.move(pivot + Vec2(100, 0));
    tools.joints().turn(toolContext(workspace));
    for (int n = 1; n <= 9; ++n) {
        const double angle = n * kPi / 18;
        hand.move(pivot + 100.0 * Vec2(std::cos(angle), -std::sin(angle)));
    }
    expectNear(at("LeftForeArm"), at("LeftArm") + Vec3(0, 0, 0.8), 1e-9);
    hand.click(pivot + Vec2(0, -100));
    EXPECT_THAT(document().undoNames(), ElementsAre("Rotate LeftArm"));
    EXPECT_TRUE(tools.joints().idle());
    expectNear(at("LeftForeArm"), at("LeftArm") + Vec3(0, 0, 0.8), 1e-9);
}

TEST_F(JointToolTest, ARingTurnsAboutItsAxisWhereverItIsTaken) {
    selectJoint("LeftArm");
    // The ring about y faces the camera: it is a circle about the joint.
    const double radius = 62;
    const Vec2 pivot = pixel("LeftArm"), from = pivot + radius * Vec2(0.6, -0.8);
    hand.move(from);
    EXPECT_TRUE(tools.joints().hoversAny());
    hand.down(from);
    for (int n = 1; n <= 6; ++n) {
        const double angle = std::atan2(0.8, 0.6) + n * kPi / 36;
        hand.move(pivot + radius * Vec2(std::cos(angle), -std::sin(angle)));
    }
    hand.up(pivot);
    // Counterclockwise from the front is a negative turn about +y, which points away.
    expectNear(degrees("LeftArm"), {0, -30, 0}, 0.5);
    EXPECT_THAT(document().undoNames(), ElementsAre("Rotate LeftArm"));
}

TEST_F(JointToolTest, LimitsHoldBackTurnsAndIk) {
    const JointLimits limits{{0, -20, 0}, {0, 20, 0}};
    document().apply("Limit", [&](Scene& s) {
        setJointLimits(s, "/root", "LeftArm", limits);
        setJointLimits(s, "/root", "LeftForeArm", limits);
    });
    test::recompile(workspace);
    selectJoint("LeftArm");
    tools.joints().turn(toolContext(workspace));
    for (const char* key : {"Y", "9", "0", "Enter"}) hand.key(key);
    expectNear(degrees("LeftArm"), {0, 20, 0}, 1e-9);
    hand.drag(pixel("LeftHand"), pixel("LeftHand") + Vec2(-200, -250));
    for (const char* joint : {"LeftArm", "LeftForeArm"})
        for (int a = 0; a < 3; ++a) {
            EXPECT_LE(degrees(joint)[a], limits.max[a] + 1e-6) << joint << " axis " << a;
            EXPECT_GE(degrees(joint)[a], limits.min[a] - 1e-6) << joint << " axis " << a;
        }
}

TEST_F(JointToolTest, SeveralJointsTurnTogetherButNoneTwice) {
    workspace.selection = {"", {}, "/root", {"LeftArm", "LeftForeArm", "RightArm"}};
    tools.joints().turn(toolContext(workspace));
    for (const char* key : {"Y", "1", "0", "Enter"}) hand.key(key);
    expectNear(degrees("LeftArm"), {0, 10, 0}, 1e-9);
    expectNear(degrees("RightArm"), {0, 10, 0}, 1e-9);
    EXPECT_EQ(degrees("LeftForeArm"), Vec3(0));
    EXPECT_THAT(document().undoNames(), ElementsAre("Rotate 3 joints"));
}

TEST_F(JointToolTest, GrabFollowsThePointerWithoutAButton) {
    selectJoint("LeftHand");
    hand.move({500, 300});
    ASSERT_TRUE(tools.joints().grab(toolContext(workspace)));
    const Vec2 before = pixel("LeftHand");
    hand.move({450, 260});
    EXPECT_LT(glm::distance(pixel("LeftHand"), before + Vec2(-50, -40)), 1e-3);
    hand.click({450, 260});
    EXPECT_THAT(document().undoNames(), ElementsAre("Pose LeftHand"));
    workspace.selection.joints.clear();
    EXPECT_FALSE(tools.joints().grab(toolContext(workspace)));
}

TEST_F(JointToolTest, ClicksSelectShiftAddsAndEmptySpaceClears) {
    hand.click(pixel("LeftHand"));
    EXPECT_THAT(workspace.selection.joints, ElementsAre("LeftHand"));
    hand.with.shift = true;
    hand.click(pixel("RightArm"));
    EXPECT_THAT(workspace.selection.joints, ElementsAre("LeftHand", "RightArm"));
    hand.click(pixel("LeftHand"));
    EXPECT_THAT(workspace.selection.joints, ElementsAre("RightArm"));
    hand.with.shift = false;
    hand.click({5, 5});
    EXPECT_TRUE(workspace.selection.empty());
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(JointToolTest, TheJointUnderThePointerIsNamed) {
    hand.move(pixel("RightForeArm") + Vec2(3, 3));
    EXPECT_EQ(tools.joints().hoveredName(), "RightForeArm");
    // On the bone, its upper joint.
    hand.move(0.5 * (pixel("RightArm") + pixel("RightForeArm")));
    EXPECT_EQ(tools.joints().hoveredName(), "RightArm");
    hand.move({5, 5});
    EXPECT_EQ(tools.joints().hoveredName(), "");
}

TEST_F(JointToolTest, ADragWhereKeysAreSetByThemselvesMakesOne) {
    workspace.timeline.autoKey = true;
    hand.drag(pixel("LeftHand"), pixel("LeftHand") + Vec2(-70, -60));
    const ActorObject* actor = findActorAt(document().scene(), "/root");
    for (const SceneJoint& joint : actor->rig.skeleton.joints)
        EXPECT_EQ(joint.rotate.animated(), joint.name == "LeftArm" || joint.name == "LeftForeArm") << joint.name;
}

TEST_F(JointToolTest, WhileTheRigIsEditedADragMovesTheRestPlaceAndChildrenStay) {
    workspace.actors.rigEdit = true;
    const Vec3 handAt = at("LeftHand");
    const Vec2 to = pixel("LeftForeArm") + Vec2(0, 10);
    hand.drag(pixel("LeftForeArm"), to);
    EXPECT_LT(glm::distance(pixel("LeftForeArm"), to), 1e-6);
    expectNear(at("LeftHand"), handAt, 1e-12);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move rest of LeftForeArm"));
    EXPECT_THAT(poseOf(document().scene(), "/root", 0), IsEmpty());
}

TEST_F(JointToolTest, WhileTheRigIsEditedJointsSnapToTheMiddleUnlessCtrlIsHeld) {
    workspace.actors.rigEdit = true;
    auto body = std::make_shared<ActorBody>();
    body->of = test::actorIn(workspace)->of;
    body->voxels = opaqueVoxels(*body->of, 0.1, 96);
    body->distance = distanceField(body->voxels);
    workspace.actors.body = body;
    const Vec2 away = pixel("LeftForeArm") + Vec2(0, 7);
    hand.drag(pixel("LeftForeArm"), away);
    // The bar's middle is at z = 1, y = 0.
    EXPECT_NEAR(at("LeftForeArm").z, 1, 0.06);
    EXPECT_NEAR(at("LeftForeArm").y, 0, 0.06);
    EXPECT_GT(glm::distance(pixel("LeftForeArm"), away), 3);
    hand.with.ctrl = true;
    hand.drag(pixel("LeftForeArm"), away);
    EXPECT_LT(glm::distance(pixel("LeftForeArm"), away), 1e-6);
}

TEST_F(JointToolTest, TheRestPoseOfAMotionIsNotDragged) {
    workspace.actors.rigEdit = true;
    document().apply("Bind",
                     [](Scene& s) { editRig(s, "/root", [](ActorRig& rig) { rig.skeleton.motion = "walk"; }); });
    tools.pointer(toolContext(workspace), {PointerPhase::Down, pixel("LeftHand"), PointerButton::Left});
    EXPECT_THROW(tools.pointer(toolContext(workspace), {PointerPhase::Move, pixel("LeftHand") + Vec2(30, 0)}), Error);
    EXPECT_TRUE(tools.joints().idle());
    EXPECT_FALSE(document().previewing());
}

TEST_F(JointToolTest, LookingAroundStillStartsOnEmptySpace) {
    const Camera before = workspace.camera;
    hand.drag({20, 20}, {80, 40});
    EXPECT_NE(workspace.camera, before);
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(JointToolTest, TheOverlayMarksWhatIsSelectedAndShowsItsRegion) {
    Overlay plain, selected;
    tools.joints().fillOverlay(toolContext(workspace), plain);
    EXPECT_EQ(plain.points.size(), 10u);
    selectJoint("LeftArm");
    tools.joints().fillOverlay(toolContext(workspace), selected);
    const auto accents = [](const Overlay& overlay) {
        return std::count_if(overlay.points.begin(), overlay.points.end(),
                             [](const OverlayPoint& p) { return Vec3f(p.color) == Vec3f(theme::kAccent); });
    };
    EXPECT_EQ(accents(plain), 0);
    EXPECT_EQ(accents(selected), 1);
    EXPECT_GT(selected.lines.size(), plain.lines.size() + 4 * 64);  // the rings, and the region
    // Another node selected: the same, but fainter.
    workspace.selection = {"", {}, "/root/of", {}};
    Overlay dim;
    tools.joints().fillOverlay(toolContext(workspace), dim);
    ASSERT_EQ(dim.points.size(), plain.points.size());
    for (std::size_t i = 0; i < dim.points.size(); ++i) EXPECT_LT(dim.points[i].color.w, plain.points[i].color.w);
}

}  // namespace
}  // namespace voledit
