#include "core/scene/document.h"

#include <gmock/gmock.h>

#include "core/scene/edits.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::function<void(Scene&)> distance(double d) {
    return [d](Scene& scene) { scene.opacityDistance = d; };
}

Document document() {
    return Document(sceneOfVolume("head.nrrd", "head", ""), "/data/head.voledit");
}

TEST(Document, StartsUnmodifiedWithNothingToUndo) {
    Document doc = document();
    EXPECT_FALSE(doc.modified());
    EXPECT_FALSE(doc.undo());
    EXPECT_FALSE(doc.redo());
    EXPECT_FALSE(doc.previewing());
    EXPECT_EQ(doc.path(), "/data/head.voledit");
}

TEST(Document, AHundredPreviewsAreOneStepThatStartsFromTheLastCommit) {
    Document doc = document();
    const Scene before = doc.scene();
    for (int i = 1; i <= 100; ++i)
        doc.preview([](Scene& scene) { scene.opacityDistance = scene.opacityDistance.value_or(0) + 1; });
    EXPECT_EQ(doc.scene().opacityDistance, 1);
    EXPECT_EQ(doc.committed(), before);
    doc.commit("Change opacity distance");
    EXPECT_THAT(doc.undoNames(), ElementsAre("Change opacity distance"));
    EXPECT_TRUE(doc.modified());
    EXPECT_TRUE(doc.undo());
    EXPECT_EQ(doc.scene(), before);
    EXPECT_FALSE(doc.modified());
}

TEST(Document, CancelLeavesNothingBehind) {
    Document doc = document();
    const Scene before = doc.scene();
    doc.preview(distance(3));
    EXPECT_TRUE(doc.previewing());
    doc.cancel();
    EXPECT_EQ(doc.scene(), before);
    EXPECT_THAT(doc.undoNames(), IsEmpty());
    doc.commit("Nothing");
    EXPECT_THAT(doc.undoNames(), IsEmpty());
}

TEST(Document, AnEditThatChangesNothingIsNoStep) {
    Document doc = document();
    doc.apply("Nothing", [](Scene&) {});
    EXPECT_THAT(doc.undoNames(), IsEmpty());
    EXPECT_FALSE(doc.previewing());
}

TEST(Document, AnEditThatThrowsChangesNothing) {
    Document doc = document();
    doc.preview(distance(2));
    EXPECT_THROW(doc.preview([](Scene& scene) {
        scene.opacityDistance = 9;
        throw std::runtime_error("no");
    }),
                 std::runtime_error);
    EXPECT_EQ(doc.scene().opacityDistance, 2);
    EXPECT_EQ(doc.committed().opacityDistance, std::nullopt);
}

TEST(Document, UndoAndRedoWalkTheStepsAndANewStepForgetsRedo) {
    Document doc = document();
    doc.apply("one", distance(1));
    doc.apply("two", distance(2));
    doc.apply("three", distance(3));
    EXPECT_THAT(doc.undoNames(), ElementsAre("one", "two", "three"));
    EXPECT_TRUE(doc.undo());
    EXPECT_TRUE(doc.undo());
    EXPECT_EQ(doc.scene().opacityDistance, 1);
    EXPECT_THAT(doc.undoNames(), ElementsAre("one"));
    EXPECT_THAT(doc.redoNames(), ElementsAre("three", "two")) << "the next one last";
    EXPECT_TRUE(doc.redo());
    EXPECT_EQ(doc.scene().opacityDistance, 2);
    doc.apply("other", distance(7));
    EXPECT_THAT(doc.undoNames(), ElementsAre("one", "two", "other"));
    EXPECT_THAT(doc.redoNames(), IsEmpty());
    EXPECT_FALSE(doc.redo());
}

TEST(Document, UndoDropsAPreview) {
    Document doc = document();
    doc.apply("one", distance(1));
    doc.preview(distance(5));
    EXPECT_TRUE(doc.undo());
    EXPECT_FALSE(doc.previewing());
    EXPECT_EQ(doc.scene().opacityDistance, std::nullopt);
}

TEST(Document, IsUnmodifiedWhereItWasSavedAlsoAfterGoingBackAndOn) {
    Document doc = document();
    doc.apply("one", distance(1));
    doc.markSaved("/data/other.voledit");
    EXPECT_FALSE(doc.modified());
    EXPECT_EQ(doc.path(), "/data/other.voledit");
    doc.undo();
    EXPECT_TRUE(doc.modified());
    doc.redo();
    EXPECT_FALSE(doc.modified());
}

TEST(Document, SnapshotsShareWhatAnEditDoesNotTouch) {
    Document doc = document();
    const ObjectRef object = doc.scene().objects.at("head");
    doc.apply("Add lattice", [](Scene& scene) { addLattice(scene, "ffd", {}, Frame{}); });
    doc.apply("Move", [](Scene& scene) { moveControlPoints(scene, "ffd", {3}, {1, 0, 0}); });
    EXPECT_TRUE(doc.scene().objects.at("head").sharesWith(object));
}

}  // namespace
}  // namespace voledit
