#include "app/editor/panels/inspector_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/editor/add_actions.h"
#include "app/editor/node_actions.h"
#include "core/scene/node_edits.h"
#include "core/scene/scene_json.h"
#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/panel_harness.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct InspectorTest : testing::Test {
    Workspace workspace;
    InspectorPanel panel;
    test::PanelHarness ui{[this] {
        if (!workspace.open || !hasInspector(workspace)) return;
        panel.draw(workspace);
        settleSelection(workspace);
        test::recompile(workspace);
    }};

    InspectorTest() {
        test::openIn(workspace, test::smallScene(false));
        addNodeActions(workspace.actions, workspace);
        addAddActions(workspace.actions, workspace, [] {});
    }
    Document& document() { return workspace.document; }
    const Scene& scene() { return workspace.document.scene(); }
    /// Does it, and forgets the step.
    void given(const char* id, const std::string& argument) {
        workspace.actions.run(id, argument);
        document() = Document(document().scene());
        test::recompile(workspace);
        ui.frame(2);
    }
    void open(const std::string& json, const std::string& node) {
        test::openIn(workspace, sceneFromJson(json, "test.voledit"));
        workspace.selection = {"", {}, node};
        ui.frame(2);
    }
    const Transfer& transfer(const std::string& name) { return *scene().transfers.at(name); }
    double number(const std::string& name, const std::string& argument) {
        const auto& use = std::get<LibraryTransfer>(transfer(name).kind);
        return (*std::get<Tracked<std::vector<double>>>(use.arguments.at(argument)))[0];
    }
    void type(const std::string& text) {
        for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        ui.frame(2);
    }
    void replaceText(const std::string& label, const std::string& text) {
        ui.click(label);
        ui.hold(Key::Ctrl, true);
        ui.press(Key::A);
        ui.hold(Key::Ctrl, false);
        type(text);
    }
};

TEST_F(InspectorTest, ATwistsAngleIsASliderAndADragIsOneStep) {
    given("transfer.add", "twist");
    EXPECT_EQ(number("twist", "angle"), 90);
    ui.drag("Angle", {30, 0});
    EXPECT_GT(number("twist", "angle"), 95);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change angle"));
    document().undo();
    EXPECT_EQ(number("twist", "angle"), 90);
    ui.frame(2);
    ui.dragTo(ui.at("Angle"), ui.at("Angle") + Vec2(40, 0));
    EXPECT_NE(number("twist", "angle"), 90);
    ui.press(Key::Escape);
    ui.button(false);
    EXPECT_EQ(number("twist", "angle"), 90);
    EXPECT_THAT(document().undoNames(), IsEmpty());
    ui.enter("Angle", "1000");  // beyond the slider, allowed
    EXPECT_EQ(number("twist", "angle"), 1000);
}

TEST_F(InspectorTest, AxisAmountEnabledAndFrame) {
    given("transfer.add", "twist");
    ui.click("Axis/X");
    ui.drag("Amount", {-60, 0});
    ui.click("Enabled");
    ui.frame(2);
    ui.enter("Frame min X", "-30");
    const Transfer& twist = transfer("twist");
    EXPECT_EQ(std::get<LibraryTransfer::Axes>(std::get<LibraryTransfer>(twist.kind).arguments.at("axis")).axes,
              std::vector<int>{0});
    EXPECT_LT(*twist.amount, 0.9);
    EXPECT_FALSE(twist.enabled);
    EXPECT_EQ(boundsOf(*twist.frame), (Box3{Vec3(-30, -40, -40), Vec3(40)}));
    ui.click("Fit to object");
    EXPECT_EQ(boundsOf(*transfer("twist").frame), (Box3{Vec3(-40), Vec3(40)}));
    EXPECT_THAT(document().undoNames(),
                ElementsAre("Change axis", "Change amount", "Disable", "Change frame min", "Fit frame"));
}

TEST_F(InspectorTest, EveryLibraryTransferHasARowForEachParameter) {
    for (const TransferDefinitionPtr& definition : transferLibrary()) {
        test::openIn(workspace, test::smallScene(false));
        workspace.selection = {};
        given("transfer.add", definition->name());
        EXPECT_TRUE(ui.has("Title")) << definition->name();
        EXPECT_TRUE(ui.has("Amount")) << definition->name();
        EXPECT_EQ(ui.has("Outside/Hide"), definition->usesOutside()) << definition->name();
        EXPECT_EQ(ui.has("Fit to object"), definition->usesFrame()) << definition->name();
        for (const TransferParameter& parameter : definition->parameters()) {
            std::string label = parameter.name;
            label[0] = char(std::toupper(label[0]));
            const bool one = parameter.kind == TransferParameter::Kind::Number;
            const char* part = one                                                 ? ""
                               : parameter.kind == TransferParameter::Kind::Pair   ? " 1"
                               : parameter.kind == TransferParameter::Kind::Vector ? " X"
                               : parameter.kind == TransferParameter::Kind::Line   ? " point X"
                                                                                   : "/X";
            EXPECT_TRUE(ui.has(label + part)) << definition->name() << " " << label + part;
        }
        EXPECT_THAT(document().undoNames(), IsEmpty()) << definition->name();
    }
}

TEST_F(InspectorTest, AnExpressionIsCheckedWhileItIsTyped) {
    given("transfer.add", "expression");
    const auto formula = [&] { return std::get<ExpressionTransfer>(transfer("expression").kind).x; };
    replaceText("X", "x + 0.1 * sin(6 * z)");
    EXPECT_EQ(formula(), "x + 0.1 * sin(6 * z)");
    EXPECT_FALSE(ui.has("Mistake"));
    type(" + * 2");
    EXPECT_TRUE(ui.has("Mistake"));
    EXPECT_EQ(formula(), "x + 0.1 * sin(6 * z)");
    for (int n = 0; n < 6; ++n) ui.press(Key::Backspace);
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_FALSE(ui.has("Mistake"));
    EXPECT_EQ(formula(), "x + 0.1 * sin(6 * z)");
    EXPECT_THAT(document().undoNames(), ElementsAre("Change x"));
    ui.click("Space/World");
    EXPECT_TRUE(std::get<ExpressionTransfer>(transfer("expression").kind).world);
}

TEST_F(InspectorTest, LetsAreAddedNamedAndRemoved) {
    given("transfer.add", "expression");
    const auto& lets = [&]() -> const auto& {
        return std::get<ExpressionTransfer>(transfer("expression").kind).let;
    };
    ui.click("Add let");
    ui.frame(2);
    ASSERT_EQ(lets().size(), 1u);
    replaceText("Let 1", "2 * z");
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(lets()[0].second, "2 * z");
    replaceText("Name 1", "twice");
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(lets()[0].first, "twice");
    ui.click("Remove let 1");
    EXPECT_TRUE(lets().empty());
    EXPECT_THAT(document().undoNames(), ElementsAre("Add let", "Change let 1", "Rename let", "Remove let"));
}

TEST_F(InspectorTest, ASolidsNumbersAndItsOpacityAsAFormula) {
    given("solid.add", "sphere");
    const auto solid = [&] { return std::get<SolidObject>(scene().objects.at("sphere")->kind); };
    ui.enter("Radius", "12");
    EXPECT_EQ(*std::get<SolidSphere>(solid().shape).radius, 12);
    ui.enter("Radius", "-3");
    EXPECT_GT(*std::get<SolidSphere>(solid().shape).radius, 0);
    ui.click("Opacity formula");
    ui.frame(2);
    replaceText("Opacity", "0.5 * (1 - r / 12)");
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_EQ(std::get<std::string>(solid().opacity), "0.5 * (1 - r / 12)");
    // A mere number is one again when the field is left.
    replaceText("Opacity", "0.25");
    ui.press(Key::Enter);
    ui.frame(2);
    ASSERT_TRUE(std::holds_alternative<Tracked<double>>(solid().opacity));
    EXPECT_EQ(*std::get<Tracked<double>>(solid().opacity), 0.25);
    EXPECT_TRUE(ui.has("Opacity formula"));
}

TEST_F(InspectorTest, AnOperatorBecomesABlendWithAWeight) {
    given("object.combine", "union sphere");
    workspace.selection = {"", {}, "/root"};
    ui.frame(2);
    ui.click("Operator");
    ui.frame(2);
    ui.click("Operator/Blend");
    ui.frame(2);
    const auto cvg = [&] { return std::get<CvgObject>(scene().root->kind); };
    EXPECT_EQ(cvg().by, CvgOperator::Blend);
    ui.enter("Weight", "0.25");
    EXPECT_EQ(*std::get<NumberField>(cvg().weight->kind).value, 0.25);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change operator", "Change weight"));
}

constexpr const char* kKeyedTwist = R"({ "voledit": 1, "transfers": { "turn": { "type": "twist", "axis": "z",
          "angle": { "keys": [[0, 10], [1, 30]] } } },
          "root": { "type": "transfer", "by": [{ "use": "turn" }],
                    "of": { "type": "solid", "shape": { "sphere": { "center": [0,0,0], "radius": 1 } },
                            "color": [1,1,1], "opacity": 1 } } })";

const std::vector<PartTrack>& tracksOf(const Scene& scene, const std::string& name, const std::string& argument) {
    const auto& use = std::get<LibraryTransfer>(scene.transfers.at(name)->kind);
    return std::get<Tracked<std::vector<double>>>(use.arguments.at(argument)).tracks();
}

TEST_F(InspectorTest, EditingAValueThatHasKeysSetsTheOneOfTheTimeShown) {
    open(kKeyedTwist, "/root/by/0");
    EXPECT_TRUE(ui.has("Angle animated"));
    workspace.time = 0.5;
    ui.frame();
    ui.enter("Angle", "45");
    EXPECT_TRUE(ui.has("Angle animated"));
    const std::vector<Track::Key>& keys = tracksOf(scene(), "turn", "angle").at(0).track.keys;
    ASSERT_EQ(keys.size(), 3u);
    EXPECT_EQ(keys[1].time, 0.5);
    EXPECT_THAT(keys[1].value, ElementsAre(45));
    EXPECT_THAT(keys[2].value, ElementsAre(30));
    EXPECT_THAT(document().undoNames(), ElementsAre("Change angle"));
    // Once more: the same key, not another beside it.
    workspace.time = 0.5 + 1e-9;
    ui.frame();
    ui.enter("Angle", "50");
    EXPECT_EQ(tracksOf(scene(), "turn", "angle").at(0).track.keys.size(), 3u);
}

TEST_F(InspectorTest, OnlyWithAutoKeyAnyOtherValueGetsKeys) {
    open(kKeyedTwist, "/root/by/0");
    workspace.time = 0.25;
    ui.frame();
    ui.enter("Amount", "0.5");
    EXPECT_FALSE(transfer("turn").amount.animated());
    workspace.timeline.autoKey = true;
    ui.enter("Amount", "0.75");
    ASSERT_TRUE(transfer("turn").amount.animated());
    EXPECT_EQ(transfer("turn").amount.tracks()[0].track.keys[0].time, 0.25);
    EXPECT_EQ(*transfer("turn").amount, 0.75);
}

TEST_F(InspectorTest, PlaceAndRecolourAndVolume) {
    given("object.wrap", "place");
    ui.enter("Translate X", "5");
    ui.enter("Rotate Z", "30");
    ui.enter("Scale Y", "0");  // nothing could be seen: refused
    const auto& place = std::get<PlaceObject>(scene().root->kind).placement;
    EXPECT_EQ(place.translate->x, 5);
    EXPECT_EQ(place.rotate->z, 30);
    EXPECT_EQ(place.scale->y, 1);
    workspace.selection = {"", {}, "/root/of"};
    ui.frame(2);
    ui.click("Interpolation/Cubic");
    EXPECT_EQ(std::get<VolumeObject>(scene().objects.at("small")->kind).interpolation, Interpolation::Cubic);
    workspace.selection = {};
    given("object.wrap", "recolor");
    ui.click("Colour");
    EXPECT_TRUE(std::get<RecolorObject>(scene().root->kind).color);
    ui.frame(2);
    ui.click("Colour");
    EXPECT_FALSE(std::get<RecolorObject>(scene().root->kind).color);
    // One of the two there must be.
    ui.frame(2);
    ui.click("Opacity");
    EXPECT_TRUE(std::get<RecolorObject>(scene().root->kind).opacity);
}

TEST_F(InspectorTest, DisplacementsAndFields) {
    open(R"({ "voledit": 1, "root": { "type": "displace",
          "by": { "type": "scale", "by": 0.5, "of": { "type": "sum", "of": [ { "type": "fields", "x": 0.1, "y": { "expression": "z" }, "z": 0 } ] } },
          "of": { "type": "fields", "opacity": { "expression": "x" }, "color": [1, 0.5, 0] } } })",
         "/root/by");
    ui.enter("Scale", "0.75");
    const auto& displace = [&]() -> const auto& {
        return std::get<DisplaceObject>(scene().root->kind);
    };
    const auto& scale = std::get<ScaleDisplacement>(displace().by->kind);
    EXPECT_EQ(*std::get<NumberField>(scale.by->kind).value, 0.75);
    workspace.selection = {"", {}, "/root/of"};
    ui.frame(2);
    replaceText("Opacity", "0.5 * y + nothing");
    EXPECT_TRUE(ui.has("Mistake"));
    ui.press(Key::Escape);
    ui.frame(2);
    replaceText("Opacity", "0.5 * y");
    ui.press(Key::Enter);
    ui.frame(2);
    const auto& fields = std::get<FieldsObject>(displace().of->kind);
    EXPECT_EQ(std::get<FormulaField>(fields.opacity->kind).expression, "0.5 * y");
    workspace.selection = {"", {}, "/root/by/of"};
    ui.frame(2);
    ui.click("Combine/Union");
    EXPECT_THAT(document().undoNames(), ElementsAre("Change scale", "Change opacity", "Change combine"));
}

TEST_F(InspectorTest, AUsersBrokenFileShowsItsMistake) {
    const std::filesystem::path folder = test::scratchFolder();
    workspace.folder = folder;
    const auto write = [&](const char* formula) {
        std::ofstream(folder / "ripple.stf")
            << "title: Ripple\ndescription: Waves.\n"
               "parameter height number = 0.1 slider [0, 1] \"How high\"\n\n[map]\nz = "
            << formula << "\n";
    };
    write("z + height * sin(10 * x)");
    given("transfer.add-file", (folder / "ripple.stf").string());
    ui.drag("Height", {50, 0});
    EXPECT_GT(number("ripple", "height"), 0.1);
    write("z + height * * x");
    workspace.formulaFiles.refresh(scene(), folder, workspace.assets, true);
    ui.frame(2);
    EXPECT_TRUE(ui.has("Mistake"));
    EXPECT_TRUE(ui.has("Height"));
}

}  // namespace
}  // namespace voledit
