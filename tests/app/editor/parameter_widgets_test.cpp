#include "app/editor/parameter_widgets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::ElementsAre;

/// All rows in one panel; what they did last.
struct ParameterWidgetsTest : testing::Test {
    double angle = 90, radius = 3;
    std::array<double, 2> range{0.25, 0.75};
    int axis = 2;
    std::vector<int> axes{0, 2};
    Edit last;
    void keep(const Edit& edit) {
        if (edit.changed || edit.finished || edit.cancelled) last = last | edit;
    }
    test::PanelHarness ui{[this] {
        const ParameterFormat degrees{{-180, 180, 0, 1, "°"}, {-720, 720}};
        keep(ui::parameter("Angle", angle, degrees, "Over the frame"));
        keep(ui::parameter("Radius", radius, {{-kInfinity, kInfinity, 0.1, 2}, {0, kInfinity}}));
        keep(ui::pair("Range", range, {{0, 1, 0, 2}, {-1, 2}}));
        keep(ui::axis("Axis", axis));
        ui::animatedMark("Axes");
        keep(ui::axes("Axes", axes));
    }};
};

TEST_F(ParameterWidgetsTest, ASliderDragsWithinItsRangeAndTypesBeyondIt) {
    ui.drag("Angle", {4000, 0});
    EXPECT_EQ(angle, 180);
    EXPECT_TRUE(last.changed && last.finished);
    ui.enter("Angle", "500");
    EXPECT_EQ(angle, 500);
    ui.enter("Angle", "9000");
    EXPECT_EQ(angle, 720);
    // Where it stands beyond the slider, a drag takes it back into the slider.
    ui.dragTo(ui.at("Angle"), ui.at("Angle") + Vec2(-4000, 0));
    ui.button(false);
    EXPECT_EQ(angle, -180);
}

TEST_F(ParameterWidgetsTest, WithoutEndsANumberIsDraggedWithinWhatIsAllowed) {
    ui.drag("Radius", {20, 0});
    EXPECT_GT(radius, 3);
    ui.enter("Radius", "-5");
    EXPECT_EQ(radius, 0);
}

TEST_F(ParameterWidgetsTest, APairsNumbersAreEditedOneByOne) {
    ui.enter("Range 2", "1.5");
    ui.enter("Range 1", "-3");
    EXPECT_THAT(range, ElementsAre(-1, 1.5));
}

TEST_F(ParameterWidgetsTest, OneAxisIsChosen) {
    ui.click("Axis/X");
    EXPECT_EQ(axis, 0);
    EXPECT_TRUE(last.changed && last.finished);
    last = {};
    ui.click("Axis/X");
    EXPECT_FALSE(last.changed);
}

TEST_F(ParameterWidgetsTest, AxesAreSwitchedButNeverAllOff) {
    ui.click("Axes/Y");
    EXPECT_THAT(axes, ElementsAre(0, 1, 2));
    ui.click("Axes/X");
    ui.click("Axes/Z");
    EXPECT_THAT(axes, ElementsAre(1));
    ui.click("Axes/Y");
    EXPECT_THAT(axes, ElementsAre(1));
}

TEST_F(ParameterWidgetsTest, TheMarkStandsBetweenLabelAndField) {
    const WidgetPlace mark = ui.place("Axes animated");
    EXPECT_LT(mark.max.x, ui.place("Axes/X").min.x);
    EXPECT_NEAR(mark.center().y, ui.at("Axes/X").y, 1);
}

}  // namespace
}  // namespace voledit
