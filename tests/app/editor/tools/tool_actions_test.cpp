#include "app/editor/tools/tool_actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

using test::indexOf;
using testing::ElementsAre;

class ToolActionsTest : public testing::Test {
protected:
    ToolActionsTest() {
        test::openIn(workspace, test::smallScene(false));
        addToolActions(workspace.actions, workspace, tools);
    }
    void run(const std::string& id, const std::string& argument = "") {
        workspace.actions.run(id, argument);
        test::recompile(workspace);
    }

    Workspace workspace;
    ViewportTools tools;
};

TEST_F(ToolActionsTest, AddLaysALatticeAboutTheObjectAndSelectsIt) {
    EXPECT_FALSE(workspace.actions.find("lattice.remove")->isEnabled());
    run("lattice.add");
    EXPECT_EQ(activeLattice(workspace), "lattice");
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {0, 0, 0}), Vec3(-40));
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {3, 3, 3}), Vec3(40));
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {4, 0, 0}), std::nullopt);
    EXPECT_EQ(shownControlPoint(workspace, "another", {0, 0, 0}), std::nullopt);
    EXPECT_THAT(workspace.document.undoNames(), ElementsAre("Add lattice"));
}

TEST_F(ToolActionsTest, RemoveGivesTheSceneBack) {
    const Scene before = workspace.document.scene();
    run("lattice.add");
    run("lattice.remove");
    EXPECT_EQ(workspace.document.scene(), before);
    EXPECT_TRUE(workspace.selection.empty());
}

TEST_F(ToolActionsTest, MoveAndResetActOnTheSelection) {
    run("lattice.add");
    EXPECT_FALSE(workspace.actions.find("lattice.move")->isEnabled());
    run("select.points", "3,3,3 0,0,0");
    run("lattice.move", "1,2.5,-3");
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {3, 3, 3}), Vec3(41, 42.5, 37));
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {0, 0, 0}), Vec3(-39, -37.5, -43));
    run("select.points", "3,3,3");
    run("lattice.reset");
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {3, 3, 3}), Vec3(40));
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {0, 0, 0}), Vec3(-39, -37.5, -43));
    run("select.none");
    run("lattice.reset");
    EXPECT_EQ(shownControlPoint(workspace, "lattice", {0, 0, 0}), Vec3(-40));
    EXPECT_THAT(workspace.document.undoNames(),
                ElementsAre("Add lattice", "Move 2 control points", "Reset control points", "Reset lattice"));
}

TEST_F(ToolActionsTest, SelectAllNoneInvert) {
    run("lattice.add");
    run("select.all");
    EXPECT_EQ(workspace.selection.points.size(), 64u);
    run("select.points", "1,2,3");
    run("select.invert");
    EXPECT_EQ(workspace.selection.points.size(), 63u);
    run("select.invert");
    EXPECT_THAT(workspace.selection.points, ElementsAre(indexOf({1, 2, 3})));
    run("select.none");
    EXPECT_TRUE(workspace.selection.points.empty());
}

TEST_F(ToolActionsTest, EnableSwitchesTheDeformation) {
    run("lattice.add");
    const Action* enable = workspace.actions.find("lattice.enable");
    EXPECT_TRUE(enable->checked());
    run("lattice.enable");
    EXPECT_FALSE(enable->checked());
    run("lattice.enable", "on");
    EXPECT_TRUE(enable->checked());
}

TEST_F(ToolActionsTest, WrongArgumentsAreErrorsThatSayWhatIsMeant) {
    run("lattice.add");
    for (const char* bad : {"1,2", "1,2,3,4", "a,b,c", "", "1;2;3"}) {
        run("select.all");
        EXPECT_THROW(run("lattice.move", bad), Error) << bad;
    }
    EXPECT_THROW(run("select.points", "0,0,4"), Error);
    EXPECT_THROW(run("select.points", "-1,0,0"), Error);
}

TEST_F(ToolActionsTest, GrabAndBoxStartTheTool) {
    run("lattice.add");
    run("select.points", "3,0,3");
    run("tool.grab");
    EXPECT_TRUE(tools.lattice().moving());
    tools.cancel(toolContext(workspace));
    run("select.box");
    EXPECT_FALSE(tools.lattice().idle());
}

}  // namespace
}  // namespace voledit
