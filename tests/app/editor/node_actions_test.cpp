#include "app/editor/node_actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/editor/add_actions.h"
#include "core/base/error.h"
#include "core/scene/nodes.h"
#include "tests/app/editor/editor_rig.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct NodeActionsTest : testing::Test {
    Workspace workspace;
    bool asked = false;

    NodeActionsTest() {
        test::openIn(workspace, test::smallScene(false));
        addNodeActions(workspace.actions, workspace);
        addAddActions(workspace.actions, workspace, [this] { asked = true; });
    }
    const Scene& scene() const { return workspace.document.scene(); }
    void run(const char* id, const std::string& argument = {}) {
        workspace.actions.run(id, argument);
        workspace.compiled = compile(scene(), workspace.assets, 0, &workspace.compiled);
    }
    std::string problemOf(const char* id, const std::string& argument) {
        try {
            run(id, argument);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
    template <class T>
    const T* rootAs() const {
        return std::get_if<T>(&scene().root->kind);
    }
};

TEST_F(NodeActionsTest, EveryLibraryTransferIsAddedAsOneStepAndSelected) {
    for (const TransferDefinitionPtr& definition : transferLibrary()) {
        test::openIn(workspace, test::smallScene(false));
        workspace.selection = {};
        run("transfer.add", definition->name());
        ASSERT_NE(rootAs<TransferObject>(), nullptr) << definition->name();
        EXPECT_THAT(workspace.document.undoNames(), ElementsAre("Add " + definition->name()));
        EXPECT_EQ(workspace.selection.node, "/root/by/0");
        const Transfer& added = *scene().transfers.at(definition->name());
        EXPECT_EQ(added.frame.has_value(), definition->usesFrame()) << definition->name();
        EXPECT_FALSE(workspace.compiled.root->bounds.empty());
    }
}

TEST_F(NodeActionsTest, TheFrameIsTheOperandsBox) {
    run("transfer.add", "twist");
    const auto& frame = scene().transfers.at("twist")->frame;
    ASSERT_TRUE(frame);
    EXPECT_EQ(boundsOf(*frame), (Box3{Vec3(-40), Vec3(40)}));
}

TEST_F(NodeActionsTest, MoreAreAppendedToTheSelectedOnesList) {
    run("transfer.add", "twist");
    run("transfer.add", "bend");
    run("transfer.add", "lattice");
    run("transfer.add", "expression");
    ASSERT_NE(rootAs<TransferObject>(), nullptr);
    EXPECT_EQ(rootAs<TransferObject>()->by.size(), 4u);
    EXPECT_EQ(workspace.selection.node, "/root/by/3");
    run("transfer.add", "twist");
    EXPECT_TRUE(scene().transfers.contains("twist"));
    EXPECT_EQ(scene().transfers.size(), 5u);
}

TEST_F(NodeActionsTest, ASelectedObjectIsWrappedWhereItStands) {
    run("solid.add", "sphere");
    ASSERT_NE(rootAs<CvgObject>(), nullptr);
    EXPECT_EQ(workspace.selection.node, "/root/of/1");
    run("transfer.add", "twist");
    ASSERT_NE(rootAs<CvgObject>(), nullptr);
    EXPECT_TRUE(std::holds_alternative<TransferObject>(rootAs<CvgObject>()->of[1]->kind));
    EXPECT_TRUE(std::holds_alternative<ObjectUse>(rootAs<CvgObject>()->of[0]->kind));
}

TEST_F(NodeActionsTest, EveryOperatorAndEveryShapeCompiles) {
    for (const AddChoice& choice : combineChoices())
        for (const AddChoice& shape : solidChoices()) {
            test::openIn(workspace, test::smallScene(false));
            workspace.selection = {};
            run("object.combine", std::string(choice.name) + " " + shape.name);
            ASSERT_NE(rootAs<CvgObject>(), nullptr);
            EXPECT_STREQ(choice.name, combineChoices()[std::size_t(rootAs<CvgObject>()->by)].name);
            EXPECT_EQ(workspace.document.undoNames().size(), 1u);
        }
}

TEST_F(NodeActionsTest, PlaceRecolourAndDisplaceGoAroundTheSelection) {
    run("object.wrap", "place");
    EXPECT_NE(rootAs<PlaceObject>(), nullptr);
    EXPECT_EQ(workspace.selection.node, "/root");
    run("object.wrap", "recolor");
    EXPECT_NE(rootAs<RecolorObject>(), nullptr);
    run("object.wrap", "displace");
    ASSERT_NE(rootAs<DisplaceObject>(), nullptr);
    EXPECT_TRUE(std::holds_alternative<ScaleDisplacement>(rootAs<DisplaceObject>()->by->kind));
}

TEST_F(NodeActionsTest, WrongArgumentsSayWhatThereIs) {
    EXPECT_THAT(problemOf("transfer.add", "wobble"), HasSubstr("twist"));
    EXPECT_THAT(problemOf("solid.add", "pyramid"), HasSubstr("torus"));
    EXPECT_THAT(problemOf("object.combine", "plus"), HasSubstr("difference"));
    EXPECT_THAT(problemOf("object.wrap", "paper"), HasSubstr("place"));
    EXPECT_THAT(problemOf("node.select", "/root/of/of/of"), HasSubstr("no node"));
    EXPECT_THAT(problemOf("transfer.add-file", "/nowhere/x.stf"), HasSubstr("/nowhere/x.stf"));
    EXPECT_TRUE(workspace.document.undoNames().empty());
}

TEST_F(NodeActionsTest, AUsersFileIsAddedByItsPath) {
    const std::filesystem::path folder = test::scratchFolder();
    workspace.folder = folder;
    std::ofstream(folder / "ripple.stf")
        << "title: Ripple\ndescription: Waves.\nparameter height number = 0.1 slider [0, 1] \"How high\"\n\n[map]\n"
           "z = z + height * sin(10 * x)\n";
    run("transfer.add-file");
    EXPECT_TRUE(asked);
    run("transfer.add-file", (folder / "ripple.stf").string());
    const auto* use = std::get_if<LibraryTransfer>(&scene().transfers.at("ripple")->kind);
    ASSERT_NE(use, nullptr);
    EXPECT_TRUE(use->isFile);
    EXPECT_EQ(use->definition, "ripple.stf");
    EXPECT_THAT(workspace.formulaFiles.recent(), ElementsAre(folder / "ripple.stf"));
}

TEST_F(NodeActionsTest, DeletingTheLastUseDeletesWhatIsNamedButASharedOneStays) {
    run("transfer.add", "twist");
    workspace.document.apply("share", [](Scene& s) {
        editObjectAt(s, "/root", [](Object& root) {
            auto& list = std::get<TransferObject>(root.kind).by;
            list.push_back(list.front());
        });
    });
    run("node.select", "/root/by/1");
    run("node.delete");
    EXPECT_EQ(rootAs<TransferObject>()->by.size(), 1u);
    EXPECT_TRUE(scene().transfers.contains("twist"));
    run("node.select", "/root/by/0");
    run("node.delete");
    EXPECT_FALSE(scene().transfers.contains("twist"));
    EXPECT_EQ(rootAs<TransferObject>(), nullptr);
}

TEST_F(NodeActionsTest, UndoTakesTheSelectionOfWhatIsGone) {
    run("transfer.add", "twist");
    workspace.document.undo();
    settleSelection(workspace);
    EXPECT_TRUE(workspace.selection.empty());
}

TEST(ListPlaceTest, OnlyElementsOfListsHaveOne) {
    EXPECT_EQ(listPlace("/root/by/3")->list, "/root/by");
    EXPECT_EQ(listPlace("/root/by/3")->index, 3u);
    EXPECT_FALSE(listPlace("/root/of"));
    EXPECT_FALSE(listPlace("/root"));
    EXPECT_FALSE(listPlace(""));
}

}  // namespace
}  // namespace voledit
