#include "app/editor/tools/viewport_tools.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

class ViewportToolsTest : public testing::Test {
protected:
    ViewportToolsTest() { test::openIn(workspace, test::smallScene(true)); }
    double distance() const { return glm::distance(workspace.camera.eye, workspace.camera.target); }

    Workspace workspace;
    ViewportTools tools;
    test::Hand hand{workspace, tools};
    const Vec2 empty{20, 20};
};

TEST_F(ViewportToolsTest, LeftDragOnEmptySpaceOrbitsAndKeepsTheSelection) {
    workspace.selection = {"lattice", {3}};
    const Camera before = workspace.camera;
    const double far = distance();
    hand.drag(empty, {220, 60});
    EXPECT_EQ(workspace.camera.target, before.target);
    EXPECT_NEAR(distance(), far, 1e-9 * far);
    EXPECT_GT(glm::distance(workspace.camera.eye, before.eye), 10);
    EXPECT_EQ(workspace.selection.points.size(), 1u);
    EXPECT_TRUE(workspace.document.undoNames().empty());
}

TEST_F(ViewportToolsTest, MiddleDragOrbitsAlsoOverAPoint) {
    const Camera before = workspace.camera;
    const Vec2 at = test::pixelOf(workspace, {3, 0, 3});
    hand.drag(at, at + Vec2(100, 0), PointerButton::Middle);
    EXPECT_GT(glm::distance(workspace.camera.eye, before.eye), 10);
    EXPECT_TRUE(workspace.document.undoNames().empty());
}

TEST_F(ViewportToolsTest, ShiftMiddleDragPansWithTheTargetUnderThePointer) {
    const Vec3 target = workspace.camera.target;
    hand.with.shift = true;
    hand.drag({400, 300}, {480, 250}, PointerButton::Middle);
    const Vec3 pixel = project(workspace.camera, workspace.viewSize, target);
    EXPECT_NEAR(pixel.x, 480, 1e-6);
    EXPECT_NEAR(pixel.y, 250, 1e-6);
}

TEST_F(ViewportToolsTest, TheWheelZoomsTowardsThePointer) {
    const double far = distance();
    hand.send(PointerPhase::Wheel, {600, 100}, PointerButton::None, 2);
    EXPECT_NEAR(distance(), far * zoomFactor(2), 1e-9 * far);
    EXPECT_GT(workspace.camera.target.x, 0);
    EXPECT_GT(workspace.camera.target.z, 0);
}

TEST_F(ViewportToolsTest, AltLeftDragOrbitsOverAPoint) {
    const Scene before = workspace.document.scene();
    const Camera camera = workspace.camera;
    hand.with.alt = true;
    const Vec2 at = test::pixelOf(workspace, {3, 0, 3});
    hand.drag(at, at + Vec2(100, 0));
    EXPECT_NE(workspace.camera, camera);
    EXPECT_EQ(workspace.document.scene(), before);
}

TEST_F(ViewportToolsTest, APointerThatMovesPointsDoesNotMoveTheCamera) {
    const Camera before = workspace.camera;
    const Vec2 at = test::pixelOf(workspace, {3, 0, 3});
    hand.dragTo(at, at + Vec2(100, 0));
    EXPECT_TRUE(tools.active());
    EXPECT_TRUE(tools.capturing());
    hand.send(PointerPhase::Wheel, at, PointerButton::None, 3);
    hand.up(at + Vec2(100, 0));
    EXPECT_EQ(workspace.camera, before);
    EXPECT_FALSE(tools.active());
    EXPECT_FALSE(tools.capturing());
}

TEST_F(ViewportToolsTest, CancelEndsADragOfEitherKind) {
    const Scene before = workspace.document.scene();
    hand.dragTo(test::pixelOf(workspace, {3, 0, 3}), {300, 300});
    tools.cancel(toolContext(workspace));
    EXPECT_EQ(workspace.document.scene(), before);
    hand.dragTo(empty, {100, 100});
    tools.cancel(toolContext(workspace));
    const Camera still = workspace.camera;
    hand.move({300, 300});
    EXPECT_EQ(workspace.camera, still);
}

}  // namespace
}  // namespace voledit
