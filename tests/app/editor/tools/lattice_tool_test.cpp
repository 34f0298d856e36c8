#include "app/editor/tools/lattice_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/editor/theme.h"
#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

using test::indexOf;
using testing::ElementsAre;
using testing::IsEmpty;

class LatticeToolTest : public testing::Test {
protected:
    LatticeToolTest() { test::openIn(workspace, test::smallScene(true)); }

    Vec2 pixel(const Index3& at) const { return test::pixelOf(workspace, at); }
    Document& document() { return workspace.document; }
    const std::vector<std::size_t>& selected() const { return workspace.selection.points; }

    Workspace workspace;
    ViewportTools tools;
    test::Hand hand{workspace, tools};
};

TEST_F(LatticeToolTest, ADraggedPointEndsUnderThePointer) {
    const Vec2 to = pixel({3, 0, 3}) + Vec2(60, -45);
    hand.drag(pixel({3, 0, 3}), to);
    EXPECT_NEAR(glm::distance(pixel({3, 0, 3}), to), 0, 1e-6);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move control point"));
    EXPECT_FALSE(document().previewing());
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
    EXPECT_EQ(workspace.selection.lattice, "lattice");
}

TEST_F(LatticeToolTest, ADragIsOneStepAndUndoRestoresTheScene) {
    const Scene before = document().scene();
    hand.drag(pixel({3, 0, 3}), {300, 200});
    EXPECT_NE(document().scene(), before);
    EXPECT_TRUE(document().undo());
    EXPECT_EQ(document().scene(), before);
    EXPECT_FALSE(document().undo());
}

TEST_F(LatticeToolTest, EscapeRestoresTheSceneByValue) {
    const Scene before = document().scene();
    hand.dragTo(pixel({0, 0, 0}), {300, 200});
    EXPECT_NE(document().scene(), before);
    EXPECT_TRUE(hand.key("Escape"));
    EXPECT_EQ(document().scene(), before);
    hand.up({300, 200});
    EXPECT_THAT(document().undoNames(), IsEmpty());
    EXPECT_TRUE(tools.lattice().idle());
}

TEST_F(LatticeToolTest, TheRightButtonCancelsToo) {
    const Scene before = document().scene();
    hand.dragTo(pixel({0, 0, 0}), {300, 200});
    hand.down({300, 200}, PointerButton::Right);
    EXPECT_EQ(document().scene(), before);
    EXPECT_FALSE(tools.lattice().moving());
}

TEST_F(LatticeToolTest, ADragOutsideTheOuterMapsStaysUnderThePointer) {
    Placement turned;
    turned.rotate = {20, -35, 50};
    turned.scale = {1.5, 0.7, 1};
    turned.translate = {5, 10, -5};
    Scene scene = document().scene();
    scene.root = Object{PlaceObject{turned, scene.root}};
    test::openIn(workspace, scene);
    const Vec2 to = pixel({3, 0, 3}) + Vec2(40, 30);
    hand.drag(pixel({3, 0, 3}), to);
    EXPECT_NEAR(glm::distance(pixel({3, 0, 3}), to), 0, 1e-6);
}

TEST_F(LatticeToolTest, ALockedAxisMovesAlongItOnly) {
    const Vec3 before = test::pointOf(workspace, {3, 0, 3});
    hand.dragTo(pixel({3, 0, 3}), pixel({3, 0, 3}) + Vec2(60, -45));
    EXPECT_TRUE(hand.key("Z"));
    hand.up(pixel({3, 0, 3}));
    const Vec3 by = test::pointOf(workspace, {3, 0, 3}) - before;
    EXPECT_EQ(by.x, 0);
    EXPECT_EQ(by.y, 0);
    EXPECT_GT(by.z, 5);
}

TEST_F(LatticeToolTest, SeveralPointsMoveTogetherInOneNamedStep) {
    hand.click(pixel({3, 0, 3}));
    hand.with.shift = true;
    hand.click(pixel({0, 0, 3}));
    hand.with.shift = false;
    EXPECT_THAT(selected(), ElementsAre(indexOf({0, 0, 3}), indexOf({3, 0, 3})));
    const Vec3 first = test::pointOf(workspace, {0, 0, 3}), second = test::pointOf(workspace, {3, 0, 3});
    hand.drag(pixel({3, 0, 3}), pixel({3, 0, 3}) + Vec2(30, -20));
    const Vec3 by = test::pointOf(workspace, {3, 0, 3}) - second;
    EXPECT_GT(glm::length(by), 1);
    EXPECT_NEAR(glm::distance(test::pointOf(workspace, {0, 0, 3}) - first, by), 0, 1e-12);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move 2 control points"));
}

TEST_F(LatticeToolTest, ClicksSelectShiftClicksToggleAndEmptySpaceClears) {
    hand.click(pixel({3, 0, 3}));
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
    hand.click(pixel({0, 0, 0}));
    EXPECT_THAT(selected(), ElementsAre(indexOf({0, 0, 0})));
    hand.with.shift = true;
    hand.click(pixel({3, 0, 3}));
    hand.click(pixel({0, 0, 0}));
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
    hand.with.shift = false;
    hand.click({5, 5});
    EXPECT_THAT(selected(), IsEmpty());
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(LatticeToolTest, ClickingOneOfSeveralSelectsItAlone) {
    workspace.selection = {"lattice", {indexOf({0, 0, 0}), indexOf({3, 0, 3})}};
    hand.click(pixel({3, 0, 3}));
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
}

TEST_F(LatticeToolTest, OfPointsBehindEachOtherTheNearestIsTaken) {
    workspace.camera = {{0, -4000, 0}, {0, 0, 0}, {0, 0, 1}, 2};
    hand.click(pixel({3, 0, 3}));
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
}

TEST_F(LatticeToolTest, CtrlDragSelectsByABoxAndShiftAdds) {
    // Seen from the front, the box about the upper right corner holds the four points behind each other.
    workspace.camera = {{0, -4000, 0}, {0, 0, 0}, {0, 0, 1}, 2};
    hand.with.ctrl = true;
    hand.drag(pixel({3, 0, 3}) - Vec2(15, 15), pixel({3, 0, 3}) + Vec2(15, 15));
    EXPECT_THAT(selected(),
                ElementsAre(indexOf({3, 0, 3}), indexOf({3, 1, 3}), indexOf({3, 2, 3}), indexOf({3, 3, 3})));
    hand.with.shift = true;
    hand.drag(pixel({0, 0, 0}) + Vec2(15, 15), pixel({0, 0, 0}) - Vec2(15, 15));
    EXPECT_EQ(selected().size(), 8u);
    hand.with = {.ctrl = true};
    hand.drag({3, 3}, {9, 9});
    EXPECT_THAT(selected(), IsEmpty());
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(LatticeToolTest, BThenADragSelectsByABox) {
    tools.lattice().armBox();
    hand.dragTo({1, 1}, {799, 599});
    ASSERT_TRUE(tools.lattice().box());
    hand.up({799, 599});
    EXPECT_EQ(selected().size(), 64u);
    EXPECT_FALSE(tools.lattice().box());
}

TEST_F(LatticeToolTest, GrabFollowsThePointerUntilAClick) {
    workspace.selection = {"lattice", {indexOf({3, 0, 3})}};
    hand.move({300, 300});
    ASSERT_TRUE(tools.lattice().grab(toolContext(workspace)));
    const Vec2 before = pixel({3, 0, 3});
    hand.move({350, 280});
    EXPECT_NEAR(glm::distance(pixel({3, 0, 3}), before + Vec2(50, -20)), 0, 1e-6);
    hand.click({350, 280});
    EXPECT_THAT(document().undoNames(), ElementsAre("Move control point"));
    EXPECT_TRUE(tools.lattice().idle());
    EXPECT_FALSE(tools.capturing());
}

TEST_F(LatticeToolTest, GrabTakesTypedDistances) {
    workspace.selection = {"lattice", {indexOf({3, 0, 3})}};
    const Vec3 before = test::pointOf(workspace, {3, 0, 3});
    hand.move({300, 300});
    tools.lattice().grab(toolContext(workspace));
    for (const char* key : {"X", "-", "7", ".", "5", "Enter"}) EXPECT_TRUE(hand.key(key));
    EXPECT_NEAR(glm::distance(test::pointOf(workspace, {3, 0, 3}), before + Vec3(-7.5, 0, 0)), 0, 1e-12);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move control point"));
}

TEST_F(LatticeToolTest, GrabNeedsASelection) {
    EXPECT_FALSE(tools.lattice().grab(toolContext(workspace)));
    EXPECT_TRUE(tools.lattice().idle());
}

TEST_F(LatticeToolTest, IdleItTakesNoKeys) {
    for (const char* key : {"Escape", "X", "1", "Enter"}) EXPECT_FALSE(hand.key(key));
}

TEST_F(LatticeToolTest, HoverFindsThePointUnderThePointer) {
    hand.move(pixel({3, 0, 3}) + Vec2(4, 4));
    EXPECT_EQ(tools.lattice().hovered(), indexOf({3, 0, 3}));
    hand.move({5, 5});
    EXPECT_EQ(tools.lattice().hovered(), std::nullopt);
}

TEST_F(LatticeToolTest, ASelectionThatUndoTookAwayIsPassedOver) {
    workspace.selection = {"gone", {500}};
    hand.drag(pixel({3, 0, 3}), pixel({3, 0, 3}) + Vec2(20, 0));
    EXPECT_EQ(workspace.selection.lattice, "lattice");
    EXPECT_THAT(selected(), ElementsAre(indexOf({3, 0, 3})));
}

TEST_F(LatticeToolTest, AFailingEditEndsTheMove) {
    hand.dragTo(pixel({3, 0, 3}), {300, 200});
    document() = Document(test::smallScene(false));
    EXPECT_THROW(tools.pointer(toolContext(workspace), {PointerPhase::Move, {10, 10}}), std::exception);
    EXPECT_TRUE(tools.lattice().idle());
    EXPECT_FALSE(document().previewing());
}

TEST_F(LatticeToolTest, TheOverlayShowsEveryPointAndMarksSelectedAndFolding) {
    Overlay overlay;
    tools.lattice().fillOverlay(toolContext(workspace), overlay);
    EXPECT_EQ(overlay.points.size(), 64u);
    EXPECT_EQ(overlay.lines.size(), 3u * 3 * 16);  // no box at rest while nothing is moved

    // A corner pushed through the opposite one turns cells inside out.
    workspace.selection = {"lattice", {0}};
    document().apply("Fold", [](Scene& s) { moveControlPoints(s, "lattice", {indexOf({3, 3, 3})}, Vec3(-400)); });
    test::recompile(workspace);
    Overlay folded;
    tools.lattice().fillOverlay(toolContext(workspace), folded);
    EXPECT_EQ(folded.lines.size(), 3u * 3 * 16 + 12);
    const auto colored = [&](const Vec4f& color) {
        return std::count_if(folded.points.begin(), folded.points.end(),
                             [&](const OverlayPoint& p) { return Vec3f(p.color) == Vec3f(color); });
    };
    EXPECT_EQ(colored(theme::kAccent), 1);
    EXPECT_GE(colored(theme::kWarning), 1);
}

}  // namespace
}  // namespace voledit
