#include "core/scene/compile.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/scene/edits.h"
#include "core/scene/limits.h"
#include "core/scene/scene_json.h"
#include "core/stf/affine.h"

namespace voledit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// 9 × 9 × 5 samples of spacing (1, 1, 2): the box [0, 8]³.
std::shared_ptr<const Volume> boxVolume(double spacing = 1) {
    VolumeGrid grid;
    grid.size = {9, 9, 5};
    grid.worldFromIndex = placementMatrix(Vec3(0), Vec3(0), spacing * Vec3(1, 1, 2));
    std::vector<float> values(grid.valueCount());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i);
    return Volume::fromValues(grid, std::move(values));
}

Scene boxScene() {
    return sceneOfVolume("box.nrrd", "box", "");
}
LoadedVolumes boxVolumes() {
    return {{"box", boxVolume()}};
}

Transfer lattice(std::optional<Frame> frame = std::nullopt) {
    Transfer transfer;
    transfer.kind = FfdTransfer{};
    transfer.frame = frame;
    return transfer;
}

Transfer shift(const Vec3& by) {
    AffineTransfer affine;
    affine.placement.translate = by;
    Transfer transfer;
    transfer.kind = affine;
    return transfer;
}

Transfer useOf(const std::string& name) {
    Transfer transfer;
    transfer.kind = TransferUse{name};
    return transfer;
}

Object transferred(std::vector<Transfer> by, ObjectRef of) {
    TransferObject object;
    for (auto& one : by) object.by.emplace_back(one);
    object.of = std::move(of);
    return Object{object};
}

const TransferTerm& transferOf(const TermPtr& term) {
    return std::get<TransferTerm>(term->node);
}
const LatticeMap& latticeOf(const TermPtr& term) {
    return dynamic_cast<const LatticeMap&>(*transferOf(term).by);
}

TEST(Compile, DefaultsComeFromTheVolumes) {
    Scene scene = boxScene();
    scene.assets["fine"] = {AssetKind::Volume, "fine.nrrd"};
    LoadedVolumes volumes = boxVolumes();
    volumes["fine"] = boxVolume(0.25);
    PlaceObject place;
    place.placement.scale = Vec3(10);
    place.of = scene.root;
    scene.root = Object{place};
    const CompiledScene compiled = compile(scene, volumes, 0, nullptr);
    EXPECT_EQ(compiled.opacityDistance, 0.25) << "the smallest spacing of all volumes, before any place";
    EXPECT_EQ(compiled.unitStep, 0.25);
    EXPECT_EQ(compiled.stepLength(), 0.125);
    EXPECT_EQ(compiled.root->bounds, (Box3{Vec3(0), Vec3(80)}));
    EXPECT_EQ(compiled.camera, fittingCamera(compiled.root->bounds, 4.0 / 3.0));
}

TEST(Compile, WhatTheSceneSaysWins) {
    Scene scene = boxScene();
    scene.opacityDistance = 3;
    scene.camera = Camera{{1, 2, 3}, {0, 0, 0}, {0, 0, 1}, 50};
    scene.render.step = 0.1;
    const CompiledScene compiled = compile(scene, boxVolumes(), 1.5, nullptr);
    EXPECT_EQ(compiled.opacityDistance, 3);
    EXPECT_EQ(compiled.camera, scene.camera);
    EXPECT_DOUBLE_EQ(compiled.stepLength(), 0.1);
    EXPECT_EQ(compiled.time, 1.5);
}

TEST(Compile, AListAppliesTheFirstFirst) {
    Scene scene = boxScene();
    Transfer turn;
    AffineTransfer affine;
    affine.placement.rotate = {0, 0, 90};
    turn.kind = affine;
    scene.root = transferred({shift({10, 0, 0}), turn}, scene.root);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    // Shifted to x 10 … 18, then turned by 90° about z: y 10 … 18, x −8 … 0.
    EXPECT_NEAR(compiled.root->bounds.min.y, 10, 1e-12);
    EXPECT_NEAR(compiled.root->bounds.max.y, 18, 1e-12);
    EXPECT_NEAR(compiled.root->bounds.min.x, -8, 1e-12);
    EXPECT_EQ(transferOf(compiled.root).role, TransferRole::Outermost);
    EXPECT_EQ(transferOf(transferOf(compiled.root).of).role, TransferRole::SameList);
}

TEST(Compile, AFrameLeftOutIsTheOperandsBoxAfterTheTransfersBefore) {
    Scene scene = boxScene();
    scene.root = transferred({shift({5, 0, 0}), lattice()}, scene.root);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    EXPECT_EQ(latticeOf(compiled.root).lattice().frame, frameOf({{5, 0, 0}, {13, 8, 8}}));
}

TEST(Compile, ASharedTransferTakesTheFrameOfItsFirstUse) {
    Scene scene = boxScene();
    scene.transfers["pull"] = lattice();
    scene.transfers["alias"] = useOf("pull");
    const Object inner = transferred({useOf("alias")}, scene.root);
    scene.root = transferred({shift({5, 0, 0}), useOf("pull")}, inner);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    EXPECT_EQ(latticeOf(compiled.root).lattice().frame, frameOf({{0, 0, 0}, {8, 8, 8}}));
    EXPECT_EQ(transferOf(compiled.root).by, transferOf(transferOf(transferOf(compiled.root).of).of).by) << "one map";
}

TEST(Compile, ADisabledFirstUseStillGivesTheFrame) {
    Scene scene = boxScene();
    Transfer pull = lattice();
    scene.transfers["pull"] = pull;
    Transfer wide = lattice(frameOf({Vec3(-4), Vec3(12)}));
    wide.enabled = false;
    scene.root = transferred({useOf("pull"), wide, lattice()}, scene.root);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    EXPECT_EQ(latticeOf(compiled.root).lattice().frame, frameOf({Vec3(0), Vec3(8)}))
        << "a disabled lattice does not move the box";
}

TEST(Compile, DisabledOrAmountZeroIsExactlyTheIdentityAndKeepsItsPlaceInTheTerm) {
    Scene scene = boxScene();
    Transfer off = lattice();
    std::get<FfdTransfer>(off.kind).moves[0] = {{3, 3, 3}, false};
    off.enabled = false;
    Transfer none = off;
    none.enabled = true;
    none.amount = 0;
    none.name = "none";
    scene.root = transferred({off, none}, scene.root);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    EXPECT_EQ(transferOf(compiled.root).name, "none");
    EXPECT_EQ(compiled.root->bounds, (Box3{Vec3(0), Vec3(8)}));
    std::vector<Vec3> p{{0.1, 1.0 / 3, 7.7}, {-50, 1e9, 3}, {8, 8, 8}};
    std::vector<Vec3> q(p.size());
    transferOf(compiled.root).by->map(p, q);
    EXPECT_EQ(p, q);
}

TEST(Compile, NamesOfTransfersAreTheirOwnOrTheirEntries) {
    Scene scene = boxScene();
    scene.transfers["a"] = shift({1, 0, 0});
    Transfer named = shift({2, 0, 0});
    named.name = "second";
    scene.transfers["b"] = named;
    scene.root = transferred({useOf("a"), useOf("b")}, scene.root);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    EXPECT_EQ(transferOf(compiled.root).name, "second");
    EXPECT_EQ(transferOf(transferOf(compiled.root).of).name, "a");
}

TEST(CompileAmount, OfAnAffineMapScalesItsDisplacement) {
    Scene scene = boxScene();
    AffineTransfer affine;
    affine.placement.translate = {4, 0, 0};
    affine.placement.rotate = {0, 0, 30};
    Transfer full;
    full.kind = affine;
    Transfer part = full;
    part.amount = 0.25;
    Scene both = scene;
    scene.root = transferred({part}, scene.root);
    both.root = transferred({full}, both.root);
    const auto scaled = transferOf(compile(scene, boxVolumes(), 0, nullptr).root).by;
    const auto whole = transferOf(compile(both, boxVolumes(), 0, nullptr).root).by;
    const std::vector<Vec3> p{{1, 2, 3}, {-7, 0, 5}, {8, 8, 8}};
    std::vector<Vec3> q(3), r(3);
    scaled->map(p, q);
    whole->map(p, r);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(q[i] - (p[i] + 0.25 * (r[i] - p[i]))), 1e-12);
    EXPECT_TRUE(scaled->affine().has_value());
}

TEST(CompileAmount, OfALatticeScalesItsDisplacementAndStillHasCells) {
    Scene scene = boxScene();
    Transfer pull = lattice();
    std::get<FfdTransfer>(pull.kind).moves[63] = {{2, -1, 1.5}, false};
    std::get<FfdTransfer>(pull.kind).moves[21] = {{0.5, 1, 0.5}, false};
    Scene whole = scene;
    whole.root = transferred({pull}, whole.root);
    pull.amount = 0.4;
    scene.root = transferred({pull}, scene.root);
    const auto scaled = transferOf(compile(scene, boxVolumes(), 0, nullptr).root).by;
    const auto full = transferOf(compile(whole, boxVolumes(), 0, nullptr).root).by;
    ASSERT_NE(scaled->cells(), nullptr);
    std::vector<Vec3> p;
    for (int n = 0; n < 1000; ++n) p.push_back(Vec3(n % 10, n / 10 % 10, n / 100) * 0.93 + Vec3(0.01));
    std::vector<Vec3> q(p.size()), r(p.size());
    scaled->map(p, q);
    full->map(p, r);
    std::size_t defined = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        ASSERT_EQ(isDefined(q[i]), isDefined(r[i]));
        if (!isDefined(r[i])) continue;
        ++defined;
        EXPECT_LT(glm::length(q[i] - (p[i] + 0.4 * (r[i] - p[i]))), 1e-9);
    }
    EXPECT_GT(defined, 500u);
}

TEST(CompileReuse, EqualScenesGiveTheVeryObjects) {
    Scene scene = boxScene();
    addLattice(scene, "ffd", {}, frameOf({Vec3(0), Vec3(8)}));
    const LoadedVolumes volumes = boxVolumes();
    const CompiledScene first = compile(scene, volumes, 0, nullptr);
    const CompiledScene second = compile(scene, volumes, 1, &first);
    EXPECT_EQ(first.root, second.root);
    const CompiledScene third = compile(scene, volumes, 1, &second);
    EXPECT_EQ(first.root, third.root) << "the cache is handed on";
}

TEST(CompileReuse, DraggingAPointRebuildsItsLatticeOnly) {
    Scene scene = boxScene();
    const Frame frame = frameOf({Vec3(0), Vec3(8)});
    addLattice(scene, "inner", {}, frame);
    addLattice(scene, "outer", {}, frame);
    const LoadedVolumes volumes = boxVolumes();
    const CompiledScene before = compile(scene, volumes, 0, nullptr);
    moveControlPoints(scene, "outer", {7}, {1, 0, 0});
    const CompiledScene after = compile(scene, volumes, 0, &before);
    EXPECT_NE(after.root, before.root);
    EXPECT_NE(transferOf(after.root).by, transferOf(before.root).by);
    EXPECT_EQ(transferOf(after.root).of, transferOf(before.root).of) << "the inner lattice and the volume";

    moveControlPoints(scene, "inner", {7}, {1, 0, 0});
    const CompiledScene last = compile(scene, volumes, 0, &after);
    EXPECT_EQ(transferOf(last.root).by, transferOf(after.root).by) << "the outer map has a frame of its own";
    EXPECT_EQ(transferOf(transferOf(last.root).of).of, transferOf(transferOf(after.root).of).of) << "the volume";
}

TEST(CompileReuse, ANewAppearanceKeepsTheLattice) {
    Scene scene = boxScene();
    addLattice(scene, "ffd", {}, frameOf({Vec3(0), Vec3(8)}));
    const LoadedVolumes volumes = boxVolumes();
    const CompiledScene before = compile(scene, volumes, 0, nullptr);
    Appearance appearance;
    appearance.opacity = PiecewiseLinear{{{0, 0}, {300, 1}}};
    setAppearance(scene, "box", appearance);
    const CompiledScene after = compile(scene, volumes, 0, &before);
    EXPECT_EQ(transferOf(after.root).by, transferOf(before.root).by);
    EXPECT_NE(transferOf(after.root).of, transferOf(before.root).of);
    const auto& volume = std::get<VolumeTerm>(transferOf(after.root).of->node);
    EXPECT_EQ(volume.appearance.opacity, *appearance.opacity);
}

TEST(CompileReuse, AnotherVolumeOfTheSameNameIsNotTakenForTheOld) {
    const Scene scene = boxScene();
    const CompiledScene before = compile(scene, boxVolumes(), 0, nullptr);
    const LoadedVolumes others = boxVolumes();
    const CompiledScene after = compile(scene, others, 0, &before);
    EXPECT_EQ(std::get<VolumeTerm>(after.root->node).volume, others.at("box"));
}

TEST(Compile, TheDeepestSceneThatAFileMayHoldCompilesAndIsSampled) {
    Scene scene = boxScene();
    const Placement step{{1, 0, 0}, Vec3(0), Vec3(1), std::nullopt};
    for (std::size_t i = 2; i < kDeepestNesting; ++i) scene.root = Object{PlaceObject{step, scene.root}};
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/deep.voledit"), scene);
    const CompiledScene compiled = compile(scene, boxVolumes(), 0, nullptr);
    const double shift = double(kDeepestNesting - 2);
    EXPECT_EQ(compiled.root->bounds, (Box3{{shift, 0, 0}, {shift + 8, 8, 8}}));
    const std::vector<Vec3> p{{shift + 3, 1, 0}};
    std::vector<ObjectSample> found(1);
    sample(*compiled.root, p, found, true);
    EXPECT_EQ(found[0].value, 12);
    scene.root = Object{PlaceObject{step, Object{PlaceObject{step, scene.root}}}};
    EXPECT_THROW(sceneFromJson(sceneToJson(scene), "/deep.voledit"), Error);
}

TEST(CompileErrors, NameTheAsset) {
    Scene scene = boxScene();
    EXPECT_THAT([&] { compile(scene, {}, 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("\"box\"")));
    VolumeObject object;
    object.asset = "box";
    object.channel = 3;
    scene.root = Object{object};
    EXPECT_THAT([&] { compile(scene, boxVolumes(), 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("no channel 3")));
}

TEST(CompileErrors, RefuseUseThatNamesNothingOrItself) {
    Scene scene = boxScene();
    scene.root = Object{ObjectUse{"gone"}};
    EXPECT_THAT([&] { compile(scene, boxVolumes(), 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("\"gone\"")));
    scene.objects["a"] = Object{ObjectUse{"b"}};
    scene.objects["b"] = Object{ObjectUse{"a"}};
    scene.root = Object{ObjectUse{"a"}};
    EXPECT_THAT([&] { compile(scene, boxVolumes(), 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("uses itself")));
    scene = boxScene();
    scene.transfers["t"] = useOf("t");
    scene.root = transferred({useOf("t")}, scene.root);
    EXPECT_THAT([&] { compile(scene, boxVolumes(), 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("uses itself")));
}

TEST(WithDefaultsWrittenOut, WritesFramesCameraAndOpacityDistance) {
    Scene scene = boxScene();
    scene.transfers["pull"] = lattice();
    scene.root = transferred({shift({5, 0, 0}), useOf("pull"), lattice()}, scene.root);
    const LoadedVolumes volumes = boxVolumes();
    const Scene written = withDefaultsWrittenOut(scene, volumes);
    const CompiledScene before = compile(scene, volumes, 0, nullptr);
    EXPECT_EQ(written.camera, before.camera);
    EXPECT_EQ(written.opacityDistance, 1);
    EXPECT_EQ(written.transfers.at("pull")->frame, frameOf({{5, 0, 0}, {13, 8, 8}}));
    const auto& by = std::get<TransferObject>(written.root->kind).by;
    EXPECT_EQ(by[0]->frame, std::nullopt) << "an affine map has no use for one";
    EXPECT_EQ(by[2]->frame, frameOf({{5, 0, 0}, {13, 8, 8}}));
    EXPECT_EQ(withDefaultsWrittenOut(written, volumes), written);
    EXPECT_EQ(compile(written, volumes, 0, &before).root, before.root) << "nothing moves";
}

TEST(WithDefaultsWrittenOut, ReachesNamedObjects) {
    Scene scene = boxScene();
    scene.objects["bent"] = transferred({lattice()}, scene.root);
    scene.objects["unused"] = transferred({lattice()}, Object{ObjectUse{"box"}});
    PlaceObject place;
    place.placement.translate = {100, 0, 0};
    place.of = Object{ObjectUse{"bent"}};
    scene.root = transferred({lattice()}, Object{place});
    const Scene written = withDefaultsWrittenOut(scene, boxVolumes());
    const auto& bent = std::get<TransferObject>(written.objects.at("bent")->kind);
    EXPECT_EQ(bent.by[0]->frame, frameOf({Vec3(0), Vec3(8)}));
    EXPECT_EQ(std::get<TransferObject>(written.root->kind).by[0]->frame, frameOf({{100, 0, 0}, {108, 8, 8}}));
}

TEST(LatticeOf, AddsDisplacementsToRestAndTakesPositionsAsTheyAre) {
    FfdTransfer ffd;
    ffd.moves[0] = {{1, 2, 3}, false};
    ffd.moves[63] = {{-1, -2, -3}, true};
    const Frame frame = frameOf({Vec3(0), Vec3(9)});
    const Lattice lattice = voledit::latticeOf(ffd, frame);
    EXPECT_EQ(lattice.control[0], Vec3(1, 2, 3));
    EXPECT_EQ(lattice.control[63], Vec3(-1, -2, -3));
    EXPECT_EQ(lattice.control[1], restControlPoints(LatticeBasis::Bezier, Index3(4), frame)[1]);
    ffd.moves[64] = {};
    EXPECT_THROW(voledit::latticeOf(ffd, frame), Error);
}

}  // namespace
}  // namespace voledit
