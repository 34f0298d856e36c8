#include "app/editor/widgets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/edits.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A document whose opacity distance a widget edits, as panels do.
struct Edited {
    Document document{[] {
        Scene scene;
        scene.opacityDistance = 10;
        return scene;
    }()};
    double value() const { return *document.scene().opacityDistance; }
    void apply(const Edit& edit, double to) {
        applyEdit(document, edit, "Change", [&](Scene& scene) { setOpacityDistance(scene, to); });
    }
};

struct NumberTest : testing::Test, Edited {
    test::PanelHarness ui{[this] {
        double shown = value();
        NumberFormat format{1, 100, 0.5, 2};
        const Edit edit = ui::number("Length", shown, format, "A length");
        apply(edit, shown);
    }};
};

TEST_F(NumberTest, ADragPreviewsAndIsOneStep) {
    ui.dragTo(ui.at("Length"), ui.at("Length") + Vec2(40, 0));
    EXPECT_GT(value(), 15);
    EXPECT_TRUE(document.previewing());
    EXPECT_THAT(document.undoNames(), IsEmpty());
    ui.button(false);
    ui.frame();
    EXPECT_THAT(document.undoNames(), ElementsAre("Change"));
    EXPECT_FALSE(document.previewing());
    document.undo();
    EXPECT_EQ(value(), 10);
}

TEST_F(NumberTest, EscapeDuringADragRestores) {
    ui.dragTo(ui.at("Length"), ui.at("Length") + Vec2(40, 0));
    ui.press(Key::Escape);
    EXPECT_EQ(value(), 10);
    EXPECT_FALSE(document.previewing());
    // The button is still down, but the drag is over.
    ui.move(ui.at("Length") + Vec2(80, 0));
    ui.button(false);
    EXPECT_EQ(value(), 10);
    EXPECT_THAT(document.undoNames(), IsEmpty());
}

TEST_F(NumberTest, TypingIsOneStepAndIsClamped) {
    ui.enter("Length", "62.5");
    EXPECT_EQ(value(), 62.5);
    EXPECT_THAT(document.undoNames(), ElementsAre("Change"));
    ui.enter("Length", "1000");
    EXPECT_EQ(value(), 100);
    EXPECT_EQ(document.undoNames().size(), 2u);
}

TEST_F(NumberTest, EscapeWhileTypingRestores) {
    ui.hold(Key::Ctrl, true);
    ui.click("Length");
    ui.hold(Key::Ctrl, false);
    ImGui::GetIO().AddInputCharacter('7');
    ui.frame(2);
    ui.press(Key::Escape);
    ui.frame(2);
    EXPECT_EQ(value(), 10);
    EXPECT_THAT(document.undoNames(), IsEmpty());
    EXPECT_FALSE(document.previewing());
}

TEST_F(NumberTest, AClickWithoutAChangeIsNoStep) {
    ui.click("Length");
    ui.press(Key::Enter);
    EXPECT_EQ(value(), 10);
    EXPECT_THAT(document.undoNames(), IsEmpty());
}

TEST(Widgets, SliderDragIsOneStep) {
    Edited edited;
    test::PanelHarness ui{[&] {
        double shown = edited.value();
        const Edit edit = ui::slider("Share", shown, NumberFormat{1, 100});
        edited.apply(edit, shown);
    }};
    ui.drag("Share", {30, 0});
    EXPECT_GT(edited.value(), 50);
    EXPECT_EQ(edited.document.undoNames().size(), 1u);
}

TEST(Widgets, VectorNotesItsParts) {
    Vec3 value(1, 2, 3);
    int finished = 0;
    test::PanelHarness ui{[&] { finished += ui::vector("Position", value).finished; }};
    ui.enter("Position Y", "-4.5");
    EXPECT_EQ(value, Vec3(1, -4.5, 3));
    EXPECT_EQ(finished, 1);
    EXPECT_LT(ui.place("Position X").max.x, ui.place("Position Y").min.x);
    EXPECT_LE(ui.place("Position Z").max.x, 340);
}

TEST(Widgets, CheckboxFinishesAtOnce) {
    bool value = false;
    int finished = 0;
    test::PanelHarness ui{[&] { finished += ui::checkbox("Shading", value).finished; }};
    ui.click("Shading");
    EXPECT_TRUE(value);
    EXPECT_EQ(finished, 1);
}

TEST(Widgets, ComboListsItsItemsByName) {
    int index = 0;
    const std::vector<std::string> items{"one", "two", "three"};
    test::PanelHarness ui{[&] { ui::combo("Kind", index, items); }};
    EXPECT_FALSE(ui.has("Kind/two"));
    ui.click("Kind");
    ui.click("Kind/three");
    EXPECT_EQ(index, 2);
    EXPECT_FALSE(ui.has("Kind/two"));
}

TEST(Widgets, ChoiceIsOneOfSeveralButtons) {
    int index = 0, finished = 0;
    const std::vector<std::string> items{"Hide", "Keep"};
    test::PanelHarness ui{[&] { finished += ui::choice("Outside", index, items).finished; }};
    ui.click("Outside/Keep");
    EXPECT_EQ(index, 1);
    ui.click("Outside/Keep");
    EXPECT_EQ(finished, 1);
}

TEST(Widgets, ColorPickerDragIsOneChange) {
    Vec3 value(0.2, 0.4, 0.6);
    int changes = 0, finished = 0;
    test::PanelHarness ui{[&] {
        const Edit edit = ui::color("Background", value);
        changes += edit.changed;
        finished += edit.finished;
    }};
    ui.click("Background");
    const WidgetPlace picker = ui.place("Background/Picker");
    ui.drag(picker.min + Vec2(60, 60), picker.min + Vec2(120, 30));
    EXPECT_GE(changes, 2);
    EXPECT_EQ(finished, 1);
    EXPECT_NE(value, Vec3(0.2, 0.4, 0.6));
}

TEST(Widgets, AnActionsButtonRunsItOnlyWhereEnabled) {
    Actions actions;
    int ran = 0;
    bool enabled = false;
    actions.add({"test.run", "Run It", "R", "", "Runs", [&](const std::string&) { ++ran; }, [&] { return enabled; }});
    test::PanelHarness ui{[&] { ui::actionButton(actions, "test.run"); }};
    ui.click("Run It");
    EXPECT_EQ(ran, 0);
    enabled = true;
    ui.click("Run It");
    EXPECT_EQ(ran, 1);
}

TEST(Widgets, IntegersStayWithinTheirBounds) {
    Index3 value(3);
    test::PanelHarness ui{[&] { ui::integers("Degree", value, 1, 8); }};
    ui.enter("Degree Z", "99");
    EXPECT_EQ(value, Index3(3, 3, 8));
}

}  // namespace
}  // namespace voledit
