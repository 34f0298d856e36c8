#include "app/editor/panels/lattice_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using test::indexOf;
using testing::ElementsAre;

class LatticePanelTest : public testing::Test {
protected:
    LatticePanelTest() {
        test::openIn(workspace, test::smallScene(true));
        addToolActions(workspace.actions, workspace, tools);
    }
    Document& document() { return workspace.document; }
    const Transfer& transfer() const { return *findTransfer(workspace.document.scene(), "lattice"); }
    const FfdTransfer& ffd() const { return std::get<FfdTransfer>(transfer().kind); }

    Workspace workspace;
    ViewportTools tools;
    LatticePanel panel;
    test::PanelHarness ui{[this] {
        if (!workspace.open) return;
        panel.draw(workspace);
        test::recompile(workspace);
    }};
};

TEST_F(LatticePanelTest, DragOfTheAmountIsOneStep) {
    ui.frame();
    ui.drag("Amount", {-40, 0});
    EXPECT_LT(transfer().amount, 0.6);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change amount"));
    document().undo();
    EXPECT_EQ(document().scene(), test::smallScene(true));
}

TEST_F(LatticePanelTest, OnePointsPositionCanBeTyped) {
    workspace.selection = {"lattice", {indexOf({3, 3, 3})}};
    ui.frame(2);
    ui.enter("Position X", "55.5");
    EXPECT_EQ(test::pointOf(workspace, {3, 3, 3}), Vec3(55.5, 40, 40));
    ui.enter("Position Z", "-10");
    EXPECT_EQ(test::pointOf(workspace, {3, 3, 3}), Vec3(55.5, 40, -10));
    EXPECT_THAT(document().undoNames(), ElementsAre("Move control point", "Move control point"));
}

TEST_F(LatticePanelTest, ThePositionIsTheShownOneUnderOuterMaps) {
    Scene scene = test::smallScene(true);
    Placement scaled;
    scaled.scale = Vec3(2);
    scaled.translate = {10, 0, 0};
    scene.root = Object{PlaceObject{scaled, scene.root}};
    test::openIn(workspace, scene);
    workspace.selection = {"lattice", {indexOf({3, 3, 3})}};
    ui.frame(2);
    ui.enter("Position X", "100");
    EXPECT_NEAR(test::pointOf(workspace, {3, 3, 3}).x, 100, 1e-9);
    EXPECT_NEAR(test::pointOf(workspace, {3, 3, 3}).y, 80, 1e-9);
}

TEST_F(LatticePanelTest, TheMeanOfSeveralMovesThemAll) {
    workspace.selection = {"lattice", {indexOf({0, 3, 3}), indexOf({3, 3, 3})}};
    ui.frame(2);
    ui.drag("Mean Y", {30, 0});
    const double by = test::pointOf(workspace, {3, 3, 3}).y - 40;
    EXPECT_GT(by, 1);
    EXPECT_NEAR(test::pointOf(workspace, {0, 3, 3}).y, 40 + by, 1e-9);
    EXPECT_THAT(document().undoNames(), ElementsAre("Move 2 control points"));
}

TEST_F(LatticePanelTest, ADegreeRaisedKeepsTheShape) {
    document().apply("move", [](Scene& s) { moveControlPoints(s, "lattice", {indexOf({3, 3, 3})}, {10, 5, 0}); });
    workspace.selection = {"lattice", {indexOf({3, 3, 3})}};
    ui.frame(2);
    ui.enter("Degree X", "5");
    EXPECT_EQ(ffd().points, Index3(6, 4, 4));
    EXPECT_TRUE(workspace.selection.points.empty());
    EXPECT_THAT(document().undoNames(), ElementsAre("move", "Change degree"));
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {5, 3, 3}), Vec3(50, 45, 40));
}

TEST_F(LatticePanelTest, BasisCellsAndOutsideAreSteps) {
    ui.frame();
    ui.click("Basis/B-spline");
    EXPECT_EQ(ffd().basis, LatticeBasis::BSpline);
    ui.frame(2);
    ui.enter("Points Y", "6");
    EXPECT_EQ(ffd().points.y, 6);
    ui.enter("Cells Z", "8");
    EXPECT_EQ(ffd().cells.z, 8);
    ui.click("Outside/Keep");
    EXPECT_EQ(transfer().outside, Outside::Keep);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change basis", "Change points", "Change cells", "Change outside"));
}

TEST_F(LatticePanelTest, ResetPutsTheSelectedPointsBack) {
    document().apply("move", [](Scene& s) { moveControlPoints(s, "lattice", {0, 5}, {1, 2, 3}); });
    workspace.selection = {"lattice", {5}};
    ui.frame(2);
    ui.click("Reset");
    EXPECT_EQ(ffd().moves.size(), 1u);
    workspace.selection = {};
    ui.frame(2);
    ui.click("Reset");
    EXPECT_TRUE(ffd().moves.empty());
}

TEST_F(LatticePanelTest, AFoldIsToldAndGoesAwayWithIt) {
    ui.frame();
    EXPECT_FALSE(ui.has("Fold warning"));
    document().apply("fold", [](Scene& s) { moveControlPoints(s, "lattice", {indexOf({3, 3, 3})}, Vec3(-400)); });
    ui.frame(3);
    EXPECT_TRUE(ui.has("Fold warning"));
    document().undo();
    ui.frame(3);
    EXPECT_FALSE(ui.has("Fold warning"));
}

TEST_F(LatticePanelTest, WithoutALatticeItOffersOne) {
    test::openIn(workspace, test::smallScene(false));
    ui.frame(2);
    ui.click("Add Lattice");
    EXPECT_EQ(latticeNames(document().scene()).size(), 1u);
}

}  // namespace
}  // namespace voledit
