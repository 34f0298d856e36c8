#include "core/rays/chain_cells.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/stf/composite_maps.h"
#include "tests/core/rays/ray_scenes.h"
#include "tests/core/stf/library_maps.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSmall{40, 30};

/// Waves in testBox().
TermPtr boxVolume() {
    const Box3 box = testBox();
    const Index3 size(27, 21, 41);
    const VolumeGrid grid{size, 1,
                          glm::translate(Mat4(1.0), box.min) *
                              Mat4(Mat3(Vec3(80.0 / 26, 0, 0), Vec3(0, 60.0 / 20, 0), Vec3(0, 0, 120.0 / 40)))};
    std::vector<std::uint8_t> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                values.push_back(
                    std::uint8_t(waves((transformPoint(grid.worldFromIndex, {i, j, k}) - box.center()) / 50.0)));
    return makeVolumeTerm(Volume::fromValues(grid, std::move(values)), 0, bands());
}

TermPtr under(TransferPtr by, TermPtr of, TransferRole role = TransferRole::Outermost) {
    return makeTransferTerm(std::move(by), std::move(of), Combine::Union, "", role);
}

CompiledScene boxScene(TermPtr term, double step = 2) {
    const Box3 bounds = term->bounds;
    CompiledScene scene = sceneOf(std::move(term), fittingCamera(bounds, 4.0 / 3), step);
    scene.camera.eye += 0.4 * (scene.camera.eye - bounds.center()).y * Vec3(-0.5, 0, 0.6);
    scene.opacityDistance = 8;
    return scene;
}

bool inPackets(const CompiledScene& scene) {
    return drawn(scene, kSmall).pixels != castRays(scene, kSmall).pixels;
}

TEST(ChainCells, EveryTransferOfTheLibraryIsDrawnAsTheReferenceDoes) {
    for (const LibraryCase& one : libraryCases()) {
        const CompiledScene scene = boxScene(under(library(one.name, one.arguments), boxVolume()));
        const double plain = psnr(drawn(scene, kSmall), reference(scene, kSmall));
        const double shaded = psnr(drawn(lit(scene), kSmall), reference(lit(scene), kSmall));
        EXPECT_GT(plain, 42) << one.name;
        EXPECT_GT(shaded, 38) << one.name;
        EXPECT_TRUE(inPackets(scene)) << one.name;
    }
}

TEST(ChainCells, SeveralDeepWithALatticeAmongThem) {
    const Frame frame = frameOf(testBox());
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    lattice.control[lattice.indexOf({3, 3, 3})] += Vec3(30, 10, 20);
    lattice.control[lattice.indexOf({1, 0, 2})] += Vec3(-10, -25, 8);
    const auto bend = [&](Outside outside) { return std::make_shared<LatticeMap>(lattice, Index3(10), outside); };
    const TransferPtr twist = library("twist", {{"axis", Axes{2}}, {"angle", Numbers{70}}});
    const TransferPtr open = library("open", {{"axis", Axes{0}}, {"hinge", Axes{2}}});
    const TransferPtr turn =
        std::make_shared<AffineMap>(placementMatrix(Vec3(3, 2, 1), Vec3(0.2, 0.1, -0.3), Vec3(1, 1.1, 0.9)));
    const std::vector<TermPtr> terms{
        under(bend(Outside::Hide),
              under(open, under(twist, boxVolume(), TransferRole::SameList), TransferRole::SameList)),
        under(twist, under(turn, under(bend(Outside::Hide), boxVolume()), TransferRole::Place)),
        under(turn, under(bend(Outside::Keep), boxVolume()), TransferRole::Place),
        under(std::make_shared<SumMap>(std::vector<TransferPtr>{twist, turn}), boxVolume(), TransferRole::Displace)};
    for (std::size_t n = 0; n < terms.size(); ++n) {
        const CompiledScene scene = boxScene(terms[n]);
        EXPECT_GT(psnr(drawn(scene, kSmall), reference(scene, kSmall)), 42) << n;
        EXPECT_GT(psnr(drawn(lit(scene), kSmall), reference(lit(scene), kSmall)), 38) << n;
        EXPECT_TRUE(inPackets(scene)) << n;
    }
}

TEST(ChainCells, AreTheSameForEveryNumberOfThreads) {
    const TransferPtr open = library("open", {{"axis", Axes{0}}, {"hinge", Axes{2}}});
    const TransferPtr twist = library("twist", {{"axis", Axes{2}}, {"angle", Numbers{200}}});
    const CompiledScene scene = lit(boxScene(under(twist, under(open, boxVolume()))));
    expectSameForThreads(scene);
}

TEST(ChainCells, AreRoughOnlyWhileSomethingMoves) {
    const CompiledScene scene =
        boxScene(under(library("twist", {{"axis", Axes{2}}, {"angle", Numbers{200}}}), boxVolume()));
    const Picture fine = drawn(scene, kSmall);
    RayRenderer renderer;
    const auto again = [&](double stepScale, bool moving) {
        renderer.begin(scene, kSmall, {stepScale, moving});
        renderer.advance(0);
        return renderer.picture();
    };
    EXPECT_GT(psnr(again(1, true), fine), 25);
    again(2.5, true);
    EXPECT_EQ(again(1, false).pixels, fine.pixels);
    EXPECT_EQ(again(1, true).pixels, fine.pixels);  // what is known already is not forgotten
    EXPECT_GT(psnr(again(1.5, true), fine), 30);
    EXPECT_EQ(again(1, false).pixels, fine.pixels);
}

/// The mean of the pixels' alpha.
double coverage(const Picture& picture) {
    double sum = 0;
    for (const Vec4f& pixel : picture.pixels) sum += pixel.a;
    return sum / double(picture.pixels.size());
}

TEST(ChainCells, LeaveOutNothingOfABlockCutInTwo) {
    const TermPtr volume = boxVolume();
    const TermPtr block =
        makeVolumeTerm(std::get<VolumeTerm>(volume->node).volume, 0, constantLook(0.3, Vec3(0.9, 0.6, 0.1)));
    for (const double gap : {0.004, 0.05, 0.3}) {
        const TransferPtr split = library("split", {{"axis", Axes{0}}, {"gap", Numbers{gap}}});
        const CompiledScene scene = boxScene(under(split, block));
        const Picture picture = drawn(scene), exact = reference(scene);
        EXPECT_GT(psnr(picture, exact), 45) << gap;
        EXPECT_NEAR(coverage(picture), coverage(exact), 1e-3) << gap;
    }
}

TEST(ChainCells, InterpolateToATenthOfAVoxel) {
    const TermPtr volume = boxVolume();
    const TermPtr term =
        under(library("bend", {{"axis", Axes{2}}, {"toward", Axes{0}}, {"angle", Numbers{200}}}), volume);
    CellWay way;
    way.term = term;
    way.by = {std::get<TransferTerm>(term->node).by};
    way.indexFromRest = std::get<VolumeTerm>(volume->node).volume->indexFromWorld();
    const auto look = volumeLook(volume, 1, nullptr);
    const PacketCells cells = chainCells(way, *look, {});
    ASSERT_GT(cells.firstRagged, 100U);
    for (std::uint32_t n = 0; n < cells.firstRagged; ++n) {
        Vec3 middle(0);
        for (const std::uint32_t v : cells.corners[n]) middle += 0.25 * cells.position[v];
        std::vector<Vec3> exact{middle};
        way.toIndex(exact, exact);
        const Vec3 p = middle - cells.origin;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto& index = cells.cells[n].index;
            const double x = index[0][a] * p.x + index[1][a] * p.y + index[2][a] * p.z + double(index[3][a]);
            ASSERT_NEAR(x, exact[0][int(a)], 0.1);
        }
    }
}

}  // namespace
}  // namespace voledit
