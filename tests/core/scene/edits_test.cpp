#include "core/scene/edits.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

Scene headScene() {
    return sceneOfVolume("ct-head.nrrd", "head", "ct-bone");
}

Scene latticeScene() {
    Scene scene = headScene();
    addLattice(scene, "ffd", {}, Frame{});
    return scene;
}

Transfer namedAffine(const std::string& name) {
    Transfer transfer;
    transfer.kind = AffineTransfer{};
    transfer.name = name;
    return transfer;
}

TEST(SceneOfVolume, HasTheAssetTheObjectAndARootThatUsesIt) {
    const Scene scene = headScene();
    EXPECT_EQ(scene.assets.at("head"), (Asset{AssetKind::Volume, "ct-head.nrrd"}));
    EXPECT_EQ(scene.root->kind, decltype(Object::kind)(ObjectUse{"head"}));
    ASSERT_NE(findAppearance(scene, "head"), nullptr);
    EXPECT_EQ(findAppearance(scene, "head")->preset, "ct-bone");
}

TEST(AddLattice, WrapsTheRootAndAppendsToATransferThatIsThere) {
    Scene scene = headScene();
    const Frame frame{{1, 2, 3}, {Vec3{4, 0, 0}, Vec3{0, 5, 0}, Vec3{0, 0, 6}}};
    EXPECT_EQ(addLattice(scene, "ffd", {}, frame), "ffd");
    EXPECT_EQ(addLattice(scene, "ffd", {}, frame), "ffd 2");
    const auto& root = std::get<TransferObject>(scene.root->kind);
    ASSERT_EQ(root.by.size(), 2u);
    EXPECT_EQ(std::get<TransferUse>(root.by[0]->kind).name, "ffd");
    EXPECT_EQ(std::get<TransferUse>(root.by[1]->kind).name, "ffd 2");
    EXPECT_EQ(std::get<ObjectUse>(root.of->kind).name, "head");
    EXPECT_EQ(scene.transfers.at("ffd")->frame, frame);
    EXPECT_THAT(latticeNames(scene), ElementsAre("ffd 2", "ffd")) << "the outermost first";
}

TEST(RemoveTransfer, TakesItOutEverywhereAndUnwrapsAnEmptyTransfer) {
    Scene scene = headScene();
    const Scene before = scene;
    addLattice(scene, "ffd", {}, Frame{});
    removeTransfer(scene, "ffd");
    EXPECT_EQ(scene, before);
}

TEST(RemoveTransfer, TakesAliasesAndInlineOnesToo) {
    Scene scene = latticeScene();
    Transfer alias;
    alias.kind = TransferUse{"ffd"};
    scene.transfers["again"] = alias;
    auto& root = std::get<TransferObject>(scene.root.edit().kind);
    Transfer useAlias;
    useAlias.kind = TransferUse{"again"};
    root.by.emplace_back(useAlias);
    root.by.emplace_back(namedAffine("shift"));
    removeTransfer(scene, "ffd");
    EXPECT_THAT(scene.transfers, IsEmpty());
    EXPECT_EQ(std::get<TransferObject>(scene.root->kind).by.size(), 1u);
    removeTransfer(scene, "shift");
    EXPECT_TRUE(std::holds_alternative<ObjectUse>(scene.root->kind));
    EXPECT_THAT([&] { removeTransfer(scene, "shift"); }, ThrowsMessage<Error>(HasSubstr("\"shift\"")));
}

TEST(LatticeNames, FollowsUseFromTheOutsideInAndEndsWithUnusedOnes) {
    Scene scene = headScene();
    addLattice(scene, "inner", {}, Frame{});
    scene.objects["bent"] = *scene.root;
    scene.root = Object{ObjectUse{"bent"}};
    addLattice(scene, "outer", {}, Frame{});
    Transfer unused;
    unused.kind = FfdTransfer{};
    scene.transfers["a spare one"] = unused;
    EXPECT_THAT(latticeNames(scene), ElementsAre("outer", "inner", "a spare one"));
}

TEST(FindTransfer, FindsEntriesByKeyOrNameAndInlineOnes) {
    Scene scene = latticeScene();
    scene.transfers["t1"] = namedAffine("Shift");
    std::get<TransferObject>(scene.root.edit().kind).by.emplace_back(namedAffine("inline"));
    EXPECT_EQ(findTransfer(scene, "ffd"), &*scene.transfers.at("ffd"));
    EXPECT_EQ(findTransfer(scene, "Shift"), &*scene.transfers.at("t1"));
    ASSERT_NE(findTransfer(scene, "inline"), nullptr);
    EXPECT_EQ(findTransfer(scene, "inline")->name, "inline");
    EXPECT_EQ(findTransfer(scene, "none"), nullptr);
    EXPECT_EQ(findTransfer(scene, ""), nullptr);
}

TEST(MoveControlPoints, AddsUpAndComesBackToRest) {
    Scene scene = latticeScene();
    const Scene rest = scene;
    const Vec3 before = controlPoint(scene, "ffd", 21, Frame{});
    moveControlPoints(scene, "ffd", {21, 22}, {1, 2, 3});
    moveControlPoints(scene, "ffd", {21}, {0.5, 0, 0});
    EXPECT_EQ(controlPoint(scene, "ffd", 21, Frame{}), before + Vec3(1.5, 2, 3));
    moveControlPoints(scene, "ffd", {21}, {-1.5, -2, -3});
    moveControlPoints(scene, "ffd", {22}, {-1, -2, -3});
    EXPECT_EQ(scene, rest);
}

TEST(MoveControlPoints, MovesPointsThatHoldAPositionToo) {
    Scene scene = latticeScene();
    setControlPoint(scene, "ffd", 5, {7, 8, 9});
    moveControlPoints(scene, "ffd", {5}, {1, 1, 1});
    EXPECT_EQ(controlPoint(scene, "ffd", 5, Frame{}), Vec3(8, 9, 10));
}

TEST(MoveControlPoints, RefusesPointsAndLatticesThatAreNotThere) {
    Scene scene = latticeScene();
    EXPECT_THAT([&] { moveControlPoints(scene, "ffd", {64}, {1, 0, 0}); }, ThrowsMessage<Error>(HasSubstr("64")));
    EXPECT_THAT([&] { moveControlPoints(scene, "gone", {0}, {1, 0, 0}); }, ThrowsMessage<Error>(HasSubstr("gone")));
    scene.transfers["shift"] = namedAffine("");
    EXPECT_THAT([&] { setControlPoint(scene, "shift", 0, {}); }, ThrowsMessage<Error>(HasSubstr("not a lattice")));
    EXPECT_THROW(controlPoint(scene, "shift", 0, Frame{}), Error);
}

TEST(ResetLattice, PutsAllOrSomePointsBack) {
    Scene scene = latticeScene();
    const Scene rest = scene;
    moveControlPoints(scene, "ffd", {1, 2, 3}, {1, 0, 0});
    resetLattice(scene, "ffd", {1, 3});
    EXPECT_EQ(std::get<FfdTransfer>(scene.transfers.at("ffd")->kind).moves.size(), 1u);
    resetLattice(scene, "ffd", {});
    EXPECT_EQ(scene, rest);
}

TEST(Edits, ReachInlineTransfersDeepInside) {
    Scene scene = headScene();
    Transfer inlineLattice;
    inlineLattice.kind = FfdTransfer{};
    inlineLattice.name = "deep";
    TransferObject inner;
    inner.by.emplace_back(inlineLattice);
    inner.of = Object{ObjectUse{"head"}};
    PlaceObject place;
    place.of = Object{inner};
    scene.root = Object{place};
    moveControlPoints(scene, "deep", {0}, {1, 2, 3});
    setTransferEnabled(scene, "deep", false);
    setTransferAmount(scene, "deep", 0.25);
    setTransferOutside(scene, "deep", Outside::Keep);
    const Transfer* found = findTransfer(scene, "deep");
    ASSERT_NE(found, nullptr);
    EXPECT_FALSE(found->enabled);
    EXPECT_EQ(found->amount, 0.25);
    EXPECT_EQ(found->outside, Outside::Keep);
    EXPECT_EQ(controlPoint(scene, "deep", 0, Frame{}), Vec3(1, 2, 3));
    EXPECT_THROW(setTransferAmount(scene, "deep", 1.5), Error);
    EXPECT_THROW(setTransferAmount(scene, "deep", kNaN), Error);
}

TEST(SetAppearance, ChangesEveryObjectThatShowsTheAsset) {
    Scene scene = headScene();
    VolumeObject second;
    second.asset = "head";
    PlaceObject place;
    place.of = Object{second};
    scene.objects["placed"] = Object{place};
    Appearance appearance;
    appearance.preset = "ct-skin";
    setAppearance(scene, "head", appearance);
    EXPECT_EQ(std::get<VolumeObject>(scene.objects.at("head")->kind).appearance, appearance);
    const auto& placed = std::get<PlaceObject>(scene.objects.at("placed")->kind);
    EXPECT_EQ(std::get<VolumeObject>(placed.of->kind).appearance, appearance);
    EXPECT_THROW(setAppearance(scene, "none", appearance), Error);
    EXPECT_EQ(findAppearance(scene, "none"), nullptr);
}

TEST(Settings, AreSetAndChecked) {
    Scene scene = headScene();
    const Camera camera{{1, 2, 3}, {0, 0, 0}, {0, 0, 1}, 40};
    setCamera(scene, camera);
    RenderSettings settings;
    settings.shading = false;
    setRenderSettings(scene, settings);
    setOpacityDistance(scene, 2);
    EXPECT_EQ(scene.camera, camera);
    EXPECT_EQ(scene.render, settings);
    EXPECT_EQ(scene.opacityDistance, 2);
    EXPECT_THROW(setOpacityDistance(scene, 0), Error);
    EXPECT_THROW(setOpacityDistance(scene, kNaN), Error);
}

}  // namespace
}  // namespace voledit
