#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/editor/panel.h"
#include "app/editor/panels/history_panel.h"
#include "app/editor/panels/render_panel.h"
#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::ElementsAre;

class PanelsTest : public testing::Test {
protected:
    PanelsTest() {
        test::openIn(workspace, test::smallScene(true));
        addToolActions(workspace.actions, workspace, tools);
    }
    Document& document() { return workspace.document; }

    Workspace workspace;
    ViewportTools tools;
};

TEST_F(PanelsTest, RenderPanelEditsTheSettings) {
    test::PanelHarness ui{[&] { drawRenderPanel(workspace); }};
    ui.click("Renderer/Rays");
    EXPECT_EQ(workspace.renderer, RendererChoice::Rays);
    EXPECT_TRUE(document().undoNames().empty());  // not part of the scene
    ui.drag("Ambient", {40, 0});
    EXPECT_GT(document().scene().render.ambient, 0.3);
    ui.click("Light");
    ui.frame();
    ui.click("Light/Fixed direction");
    EXPECT_TRUE(document().scene().render.light.has_value());
    ui.frame();
    ui.enter("Direction X", "3");
    EXPECT_EQ(document().scene().render.light.value()->x, 3);
    ui.click("Shading");
    EXPECT_FALSE(document().scene().render.shading);
    ui.frame();
    EXPECT_FALSE(ui.has("Ambient"));
    EXPECT_THAT(document().undoNames(),
                ElementsAre("Change ambient", "Change light", "Change light", "Change shading"));
}

TEST_F(PanelsTest, RenderPanelChoosesLightsAndTones) {
    test::PanelHarness ui{[&] { drawRenderPanel(workspace); }};
    ui.click("Light");
    ui.frame();
    ui.click("Light/Dramatic");
    EXPECT_EQ(document().scene().render.rig, LightRig::Dramatic);
    EXPECT_FALSE(document().scene().render.light.has_value());
    EXPECT_FALSE(ui.has("Occlusion radius"));
    ui.drag("Occlusion", {40, 0});
    EXPECT_GT(document().scene().render.occlusion, 0);
    ui.frame();
    EXPECT_TRUE(ui.has("Occlusion radius"));
    ui.drag("Shadows", {60, 0});
    EXPECT_GT(document().scene().render.shadows, 0);
    ui.click("Tone mapping/Filmic");
    EXPECT_EQ(document().scene().render.toneMapping, ToneMapping::Filmic);
    ui.click("Transparent");
    EXPECT_TRUE(document().scene().render.transparent);
    EXPECT_THAT(document().undoNames(), ElementsAre("Change light", "Change occlusion", "Change shadows",
                                                    "Change tone mapping", "Change transparent"));
}

TEST_F(PanelsTest, TheFrameBudgetIsNoEditOfTheScene) {
    test::PanelHarness ui{[&] { drawRenderPanel(workspace); }};
    ui.enter("Frame budget", "50");
    EXPECT_EQ(workspace.frameBudgetMs, 50);
    EXPECT_TRUE(document().undoNames().empty());
}

TEST_F(PanelsTest, HistoryPanelGoesBackAndForth) {
    for (const char* name : {"one", "two", "three"})
        document().apply(name, [&](Scene& s) { moveControlPoints(s, "lattice", {0}, {1, 0, 0}); });
    test::PanelHarness ui{[&] { drawHistoryPanel(workspace); }};
    ui.click("Step 1");
    EXPECT_THAT(document().undoNames(), ElementsAre("one"));
    ui.click("Step 3");
    EXPECT_THAT(document().undoNames(), ElementsAre("one", "two", "three"));
    ui.click("Step 0");
    EXPECT_TRUE(document().undoNames().empty());
}

TEST_F(PanelsTest, EveryPanelDrawsWithAndWithoutAScene) {
    const std::vector<Panel> panels = makePanels();
    EXPECT_GE(panels.size(), 5u);
    Workspace closed;
    for (Workspace* shown : {&workspace, &closed})
        for (const Panel& panel : panels) {
            if (panel.shown && !panel.shown(*shown)) continue;
            EXPECT_NO_THROW(test::PanelHarness([&] { panel.draw(*shown); })) << panel.title;
        }
}

}  // namespace
}  // namespace voledit
