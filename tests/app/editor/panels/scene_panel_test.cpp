#include "app/editor/panels/scene_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/editor/add_actions.h"
#include "app/editor/node_actions.h"
#include "core/scene/nodes.h"
#include "tests/app/editor/editor_rig.h"
#include "tests/app/editor/panel_harness.h"

namespace voledit {
namespace {

using testing::ElementsAre;

/// A volume that is split, then twisted, then bent by a lattice.
struct ScenePanelTest : testing::Test {
    Workspace workspace;
    ViewportTools tools;
    test::PanelHarness ui{[this] {
        if (!workspace.open) return;
        drawScenePanel(workspace);
        settleSelection(workspace);
    }};

    ScenePanelTest() {
        test::openIn(workspace, test::smallScene(true));
        addToolActions(workspace.actions, workspace, tools);
        addNodeActions(workspace.actions, workspace);
        addAddActions(workspace.actions, workspace, [] {});
        for (const char* name : {"split", "twist"}) {
            workspace.actions.run("transfer.add", name);
            workspace.document = Document(workspace.document.scene());
        }
        workspace.selection = {};
        ui.frame(2);
    }
    Document& document() { return workspace.document; }
    const std::string& selected() const { return workspace.selection.node; }
    /// Names of the root's list, in order.
    std::vector<std::string> list() {
        std::vector<std::string> names;
        const auto* root = std::get_if<TransferObject>(&document().scene().root->kind);
        if (root)
            for (const TransferRef& by : root->by) names.push_back(std::get<TransferUse>(by->kind).name);
        return names;
    }
    void act(const char* id, const std::string& argument = {}) {
        workspace.actions.run(id, argument);
        ui.frame(2);
    }
};

TEST_F(ScenePanelTest, AClickSelectsANodeAndALatticeWithIt) {
    ui.click("twist");
    EXPECT_EQ(selected(), "/root/by/2");
    EXPECT_EQ(workspace.selection.lattice, "");
    EXPECT_FALSE(workspace.selection.showsLattice());
    ui.click("lattice");
    EXPECT_EQ(workspace.selection.lattice, "lattice");
    // And the other way round.
    workspace.selection = {"lattice", {3}};
    ui.frame();
    EXPECT_EQ(selected(), "/root/by/0");
    EXPECT_THAT(workspace.selection.points, ElementsAre(3));
}

TEST_F(ScenePanelTest, TheEyeSwitchesADeformationAndSelectsNothing) {
    ui.click("Show twist");
    EXPECT_FALSE(document().scene().transfers.at("twist")->enabled);
    EXPECT_EQ(selected(), "");
    ui.click("Show twist");
    EXPECT_TRUE(document().scene().transfers.at("twist")->enabled);
    EXPECT_THAT(document().undoNames(), ElementsAre("Disable twist", "Enable twist"));
}

TEST_F(ScenePanelTest, AnArrowHidesWhatIsBelow) {
    ui.click("Open Transfer");
    EXPECT_FALSE(ui.has("twist"));
    ui.click("Open Transfer");
    EXPECT_TRUE(ui.has("twist"));
}

TEST_F(ScenePanelTest, RowsAreWalkedByKeys) {
    act("node.next");
    EXPECT_EQ(selected(), "/root");
    act("node.next");
    act("node.next");
    EXPECT_EQ(selected(), "/root/by/1");
    act("node.previous");
    EXPECT_EQ(selected(), "/root/by/0");
    act("node.close");
    EXPECT_EQ(selected(), "/root");
    act("node.close");
    EXPECT_FALSE(ui.has("twist"));
    act("node.open");
    EXPECT_TRUE(ui.has("twist"));
    act("node.open");
    EXPECT_EQ(selected(), "/root/by/0");
}

TEST_F(ScenePanelTest, DraggingARowReordersItsList) {
    EXPECT_THAT(list(), ElementsAre("lattice", "split", "twist"));
    ui.drag(ui.at("twist"), ui.at("lattice"));
    ui.frame(2);
    EXPECT_THAT(list(), ElementsAre("twist", "lattice", "split"));
    EXPECT_EQ(selected(), "/root/by/0");
    // A volume is no place in that list.
    ui.drag(ui.at("twist"), ui.at("small"));
    EXPECT_THAT(list(), ElementsAre("twist", "lattice", "split"));
    EXPECT_THAT(document().undoNames(), ElementsAre("Move deformation"));
}

TEST_F(ScenePanelTest, MovingUpAndDownStopsAtTheEnds) {
    act("node.select", "split");
    act("node.move-up");
    EXPECT_THAT(list(), ElementsAre("split", "lattice", "twist"));
    EXPECT_FALSE(workspace.actions.find("node.move-up")->isEnabled());
    act("node.move-down");
    act("node.move-down");
    EXPECT_THAT(list(), ElementsAre("lattice", "twist", "split"));
    EXPECT_FALSE(workspace.actions.find("node.move-down")->isEnabled());
    EXPECT_EQ(selected(), "/root/by/2");
}

TEST_F(ScenePanelTest, DeleteTakesTheNodeAndItsEntryAway) {
    act("node.select", "split");
    act("node.delete");
    EXPECT_THAT(list(), ElementsAre("lattice", "twist"));
    EXPECT_FALSE(document().scene().transfers.contains("split"));
    EXPECT_THAT(document().undoNames(), ElementsAre("Delete split"));
    document().undo();
    EXPECT_THAT(list(), ElementsAre("lattice", "split", "twist"));
}

TEST_F(ScenePanelTest, WithControlPointsSelectedDeleteLeavesTheLattice) {
    workspace.selection = {"lattice", {0}};
    ui.frame();
    EXPECT_FALSE(workspace.actions.find("node.delete")->isEnabled());
}

TEST_F(ScenePanelTest, ANameIsTypedInPlace) {
    ui.doubleClick(ui.at("twist"));
    ui.frame(2);
    ASSERT_TRUE(ui.has("Name"));
    for (const char c : std::string("turn")) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    ui.frame();
    ui.press(Key::Enter);
    ui.frame(2);
    EXPECT_THAT(list(), ElementsAre("lattice", "split", "turn"));
    EXPECT_EQ(selected(), "/root/by/2");
    EXPECT_THAT(document().undoNames(), ElementsAre("Rename twist"));
    // Escape leaves it.
    act("node.rename");
    for (const char c : std::string("other")) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    ui.frame();
    ui.press(Key::Escape);
    ui.frame(2);
    EXPECT_THAT(list(), ElementsAre("lattice", "split", "turn"));
}

TEST_F(ScenePanelTest, TheRightButtonOpensAMenuForTheRow) {
    ui.click(ui.at("twist"), 1);
    ui.frame(2);
    EXPECT_EQ(selected(), "/root/by/2");
    ui.click("Node/Delete");
    EXPECT_THAT(list(), ElementsAre("lattice", "split"));
}

}  // namespace
}  // namespace voledit
