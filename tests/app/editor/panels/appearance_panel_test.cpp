#include "app/editor/panels/appearance_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/appearance.h"
#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class AppearancePanelTest : public testing::Test {
protected:
    // The grey ramp of the small volume runs from (−1000, 0) to (3000, 1).
    AppearancePanelTest() { test::openIn(workspace, test::smallScene(false)); }

    TransferFunction tables() const {
        return resolve(*findAppearance(workspace.document.scene(), "small"), *workspace.assets.volumes.at("small"));
    }
    Document& document() { return workspace.document; }
    /// A place in the plot by its share of width and height.
    Vec2 inPlot(double x, double y) const {
        const WidgetPlace plot = ui.place("Opacity plot");
        return plot.min + (plot.max - plot.min) * Vec2(x, y);
    }

    Workspace workspace;
    AppearancePanel panel;
    test::PanelHarness ui{[this] {
        if (workspace.open) panel.draw(workspace);
    }};
};

TEST_F(AppearancePanelTest, DraggingAPointIsOneStep) {
    ui.frame();
    const double plotHeight = ui.place("Opacity plot").max.y - ui.place("Opacity plot").min.y;
    ui.dragTo(ui.at("Opacity point 2"), ui.at("Opacity point 2") + Vec2(-60, 0.3 * plotHeight));
    EXPECT_TRUE(document().previewing());
    const Vec2 moved = tables().opacity.points.at(1);
    EXPECT_LT(moved.x, 2600);
    EXPECT_LT(moved.y, 0.8);
    ui.button(false);
    EXPECT_THAT(document().undoNames(), ElementsAre("Edit opacity"));
    EXPECT_EQ(tables().opacity.points.at(1), moved);
    // The point is where the mouse let it go.
    const Vec2 mouse{ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
    ui.frame();
    EXPECT_LE(glm::distance(ui.at("Opacity point 2"), mouse), 1.0);
    document().undo();
    EXPECT_EQ(tables(), greyRamp(-1000, 3000));
}

TEST_F(AppearancePanelTest, EscapeRestoresTheTables) {
    ui.frame();
    const Scene before = document().scene();
    ui.dragTo(ui.at("Opacity point 2"), ui.at("Opacity point 2") + Vec2(-60, 30));
    ui.press(Key::Escape);
    EXPECT_EQ(document().scene(), before);
    ui.move(inPlot(0.2, 0.2));
    ui.button(false);
    EXPECT_EQ(document().scene(), before);
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(AppearancePanelTest, DoubleClickAddsAPointWhereTheMouseIsAndRightClickRemovesIt) {
    ui.frame();
    ui.doubleClick(inPlot(0.5, 0.25));
    ASSERT_EQ(tables().opacity.points.size(), 3u);
    const Vec2 added = tables().opacity.points[1];
    EXPECT_NEAR(added.x, 1000, 30);
    EXPECT_NEAR(added.y, 0.77, 0.05);
    EXPECT_THAT(document().undoNames(), ElementsAre("Add opacity point"));
    ui.frame();
    ui.click(ui.at("Opacity point 2"), 1);
    EXPECT_EQ(tables().opacity.points.size(), 2u);
    EXPECT_THAT(document().undoNames(), ElementsAre("Add opacity point", "Remove opacity point"));
}

TEST_F(AppearancePanelTest, DeleteRemovesTheSelectedPoint) {
    ui.frame();
    ui.click(ui.at("Opacity point 1"));
    ui.press(Key::Delete);
    EXPECT_EQ(tables().opacity.points.size(), 1u);
    EXPECT_THAT(document().undoNames(), ElementsAre("Remove opacity point"));
}

TEST_F(AppearancePanelTest, TheSelectedPointsNumbersCanBeTyped) {
    ui.frame();
    ui.click(ui.at("Opacity point 2"));
    ui.frame();
    ui.enter("Opacity", "0.25");
    ui.enter("Value", "512");
    EXPECT_EQ(tables().opacity.points.at(1), Vec2(512, 0.25));
    EXPECT_EQ(document().undoNames().size(), 2u);
}

TEST_F(AppearancePanelTest, ColourStopsAreAddedMovedAndPainted) {
    ui.frame();
    const WidgetPlace bar = ui.place("Color bar");
    ui.doubleClick(bar.center());
    ASSERT_EQ(tables().color.points.size(), 3u);
    EXPECT_NEAR(tables().color.points[1].value, 1000, 30);
    ui.frame(40);
    ui.drag(ui.at("Color stop 2"), ui.at("Color stop 2") + Vec2(40, 0));
    EXPECT_GT(tables().color.points[1].value, 1200);
    EXPECT_THAT(document().undoNames(), ElementsAre("Add colour", "Edit colour"));
    ui.frame();
    ui.click("Colour");
    ui.frame();
    const WidgetPlace picker = ui.place("Colour/Picker");
    ui.drag(picker.min + Vec2(100, 40), picker.min + Vec2(110, 30));
    EXPECT_EQ(document().undoNames().size(), 3u);
    EXPECT_NE(tables().color.points[1].color.x, tables().color.points[1].color.z);
}

TEST_F(AppearancePanelTest, GradientOpacityIsSwitchedOnAndOffByOneStepEach) {
    ui.frame();
    const TransferFunction before = tables();
    EXPECT_FALSE(ui.has("Gradient plot"));
    ui.click("Gradient opacity");
    ASSERT_EQ(tables().gradientOpacity.points.size(), 2u);
    EXPECT_EQ(tables().opacity, before.opacity);
    EXPECT_EQ(tables().color, before.color);
    // Values grow by 500 in 10 units everywhere.
    EXPECT_GT(tables().gradientOpacity.points[0].x, 0);
    EXPECT_LT(tables().gradientOpacity.points[1].x, 50);
    ui.frame();
    EXPECT_TRUE(ui.has("Gradient plot"));
    ui.click("Gradient opacity");
    EXPECT_TRUE(tables().gradientOpacity.points.empty());
    EXPECT_THAT(document().undoNames(), ElementsAre("Change gradient opacity", "Change gradient opacity"));
    document().undo();
    document().undo();
    EXPECT_EQ(tables(), before);
}

TEST_F(AppearancePanelTest, AGradientPointIsDraggedInOneStepAndLeavesTheRest) {
    ui.frame();
    ui.click("Gradient opacity");
    ui.frame();
    const TransferFunction before = tables();
    ui.drag(ui.at("Gradient point 2"), ui.at("Gradient point 2") + Vec2(40, 20));
    EXPECT_GT(tables().gradientOpacity.points[1].x, before.gradientOpacity.points[1].x);
    EXPECT_LT(tables().gradientOpacity.points[1].y, 1);
    EXPECT_EQ(tables().opacity, before.opacity);
    EXPECT_EQ(tables().color, before.color);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change gradient opacity", "Edit factor"));
    ui.frame();
    ui.enter("Factor", "0.5");
    EXPECT_EQ(tables().gradientOpacity.points[1].y, 0.5);
    document().undo();
    document().undo();
    EXPECT_EQ(tables(), before);
}

TEST_F(AppearancePanelTest, ShiftDragMovesEverything) {
    ui.frame();
    ui.hold(Key::Shift, true);
    ui.drag(inPlot(0.5, 0.2), inPlot(0.6, 0.2));
    ui.hold(Key::Shift, false);
    const TransferFunction after = tables();
    EXPECT_GT(after.opacity.points[0].x, -900);
    EXPECT_NEAR(after.opacity.points[1].x - after.opacity.points[0].x, 4000, 1e-9);
    EXPECT_NEAR(after.color.points[0].value, after.opacity.points[0].x, 1e-9);
    EXPECT_THAT(document().undoNames(), ElementsAre("Shift appearance"));
}

TEST_F(AppearancePanelTest, TheWheelZoomsWithoutAnEdit) {
    ui.frame();
    const double before = ui.at("Opacity point 1").x;
    ui.move(inPlot(1, 0.5) - Vec2(2, 0));
    ImGui::GetIO().MouseWheel = 1;
    ui.frame(2);
    EXPECT_FALSE(ui.has("Opacity point 1"));  // went out at the left
    EXPECT_TRUE(ui.has("Opacity point 2"));
    EXPECT_GT(before, 0);
    EXPECT_THAT(document().undoNames(), IsEmpty());
}

TEST_F(AppearancePanelTest, APresetIsOneStep) {
    ui.frame();
    ui.click("Preset");
    ui.click("Preset/CT bone");
    EXPECT_EQ(findAppearance(document().scene(), "small")->preset, "ct-bone");
    EXPECT_THAT(document().undoNames(), ElementsAre("Change preset"));
    document().undo();
    EXPECT_EQ(findAppearance(document().scene(), "small")->preset, "");
}

TEST_F(AppearancePanelTest, EditingAPresetKeepsItsOtherTables) {
    document().apply("preset", [](Scene& scene) {
        Appearance appearance;
        appearance.preset = "ct-bone";
        setAppearance(scene, "small", appearance);
    });
    const TransferFunction before = tables();
    ui.frame(2);
    ui.drag(ui.at("Opacity point 1"), ui.at("Opacity point 1") + Vec2(-10, -10));
    EXPECT_EQ(tables().color, before.color);
    EXPECT_NE(tables().opacity, before.opacity);
    EXPECT_EQ(findAppearance(document().scene(), "small")->preset, "");
}

TEST_F(AppearancePanelTest, DensityLengthIsTheScenesOpacityDistance) {
    ui.frame();
    ui.enter("Opacity distance", "2.5");
    EXPECT_EQ(document().scene().opacityDistance, 2.5);
}

}  // namespace
}  // namespace voledit
