#include "app/editor/tools/lattice_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

using test::indexOf;

Placement turned() {
    Placement placement;
    placement.translate = {10, -20, 5};
    placement.rotate = {30, 45, -60};
    placement.scale = {2, 0.5, 1};
    return placement;
}

Transfer affine(const Placement& placement, double amount = 1) {
    Transfer transfer;
    transfer.kind = AffineTransfer{placement};
    transfer.amount = amount;
    return transfer;
}

std::optional<LatticeView> viewOf(const Scene& scene, const std::string& name = "lattice") {
    Workspace workspace;
    test::openIn(workspace, scene);
    return latticeView(scene, &workspace.compiled, name);
}

TEST(LatticeView, WithoutOuterMapsPointsStandWhereTheyAre) {
    Scene scene = test::smallScene(true);
    moveControlPoints(scene, "lattice", {indexOf({3, 3, 3})}, {7, 8, 9});
    const auto view = viewOf(scene);
    ASSERT_TRUE(view);
    EXPECT_TRUE(view->exact);
    EXPECT_EQ(view->shown(0), Vec3(-40));
    EXPECT_EQ(view->shown(indexOf({3, 3, 3})), Vec3(47, 48, 49));
    EXPECT_NE(view->map, nullptr);
}

TEST(LatticeView, OuterPlacesAndAffineTransfersMoveThePoints) {
    Scene scene = test::smallScene(true);
    std::get<TransferObject>(scene.root.edit().kind).by.emplace_back(affine(turned()));
    Placement shifted;
    shifted.translate = {100, 0, 0};
    scene.root = Object{PlaceObject{shifted, scene.root}};
    const auto view = viewOf(scene);
    ASSERT_TRUE(view);
    const Vec3 expected = transformPoint(worldFromRest(turned()), Vec3(40, -40, 40)) + Vec3(100, 0, 0);
    EXPECT_LE(glm::distance(view->shown(indexOf({3, 0, 3})), expected), 1e-9);
}

TEST(LatticeView, InnerPlacesDoNotMoveThePoints) {
    Scene scene = test::smallScene(false);
    scene.root = Object{PlaceObject{turned(), scene.root}};
    addLattice(scene, "lattice", FfdTransfer{}, frameOf(Box3{Vec3(-40), Vec3(40)}));
    EXPECT_EQ(viewOf(scene)->shown(0), Vec3(-40));
}

TEST(LatticeView, AnOuterAffineTransferCountsAtItsAmount) {
    Placement shifted;
    shifted.translate = {100, 0, 0};
    Scene scene = test::smallScene(true);
    std::get<TransferObject>(scene.root.edit().kind).by.emplace_back(affine(shifted, 0.25));
    EXPECT_LE(glm::distance(viewOf(scene)->shown(0), Vec3(-15, -40, -40)), 1e-9);
    std::get<TransferObject>(scene.root.edit().kind).by.back().edit().enabled = false;
    EXPECT_EQ(viewOf(scene)->shown(0), Vec3(-40));
}

TEST(LatticeView, TheOutermostComesFirstAndBendingItMakesTheInnerInexact) {
    Scene scene = test::smallScene(true);
    const std::string outer = addLattice(scene, "lattice", FfdTransfer{}, frameOf(Box3{Vec3(-50), Vec3(50)}));
    EXPECT_EQ(viewOf(scene, "")->name, outer);
    EXPECT_TRUE(viewOf(scene)->exact);
    moveControlPoints(scene, outer, {0}, {1, 0, 0});
    EXPECT_FALSE(viewOf(scene)->exact);
    EXPECT_TRUE(viewOf(scene, outer)->exact);
}

TEST(LatticeView, AFrameLeftOutIsTheOperandsBox) {
    Scene scene = test::smallScene(true);
    scene.transfers.at("lattice").edit().frame.reset();
    const auto view = viewOf(scene);
    ASSERT_TRUE(view);
    EXPECT_LE(glm::distance(view->shown(indexOf({3, 3, 3})), Vec3(40)), 1e-9);
    EXPECT_FALSE(latticeView(scene, nullptr, "lattice"));
}

TEST(LatticeView, ASwitchedOffLatticeIsStillShown) {
    Scene scene = test::smallScene(true);
    setTransferEnabled(scene, "lattice", false);
    const auto view = viewOf(scene);
    ASSERT_TRUE(view);
    EXPECT_FALSE(view->enabled);
}

TEST(LatticeView, GridIndexIsTheInverseOfIndexOf) {
    Lattice lattice;
    lattice.points = {3, 5, 4};
    for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(lattice.indexOf(gridIndexOf(lattice, i)), i);
}

}  // namespace
}  // namespace voledit
