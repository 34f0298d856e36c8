#include "core/rays/cell_tiles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/stf/mapped_cells.h"
#include "tests/core/rays/ray_scenes.h"

namespace voledit {
namespace {

using namespace test;

constexpr int kSamples = 33;

TermPtr waveVolume() {
    return makeVolumeTerm(typed<std::uint8_t>(Index3(kSamples), unitGrid(kSamples)), 0, bands());
}

TermPtr under(TransferPtr by, TermPtr of, TransferRole role = TransferRole::Outermost) {
    return makeTransferTerm(std::move(by), std::move(of), Combine::Union, "", role);
}

TransferPtr placement(const Vec3& translate, const Vec3& turn, const Vec3& scale) {
    return std::make_shared<AffineMap>(placementMatrix(translate, turn, scale));
}

CompiledScene thin(CompiledScene scene) {
    scene.opacityDistance = 0.15;
    return scene;
}

/// A box of cells carried by `forward`.
template <class Forward>
TransferPtr carried(const Box3& box, Index3 count, const Forward& forward) {
    MappedCells::Data data = gridCells(frameOf(box), count);
    for (Vec3& p : data.deformed) p = forward(p);
    return std::make_shared<CellMap>(std::move(data), Outside::Hide);
}

bool inPackets(const CompiledScene& scene) {
    return drawn(scene).pixels != castRays(scene, kSize).pixels;
}

TEST(CellTiles, DrawWhatTheReferenceDoes) {
    for (const int cells : {1, 3, 8, 16})
        for (const double amount : {0.0, 0.15, 0.3}) {
            const auto lattice = bentLattice(amount, cells);
            ASSERT_FALSE(lattice->cells()->mayOverlap());
            const CompiledScene scene = thin(sceneOf(under(lattice, waveVolume()), kOblique, 2.0 / (kSamples - 1)));
            EXPECT_TRUE(inPackets(scene));
            EXPECT_GT(psnr(drawn(scene), reference(scene)), 46) << cells << " " << amount;
            EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 40) << cells << " " << amount;
        }
}

TEST(CellTiles, FineStepsConvergeToTheReference) {
    const CompiledScene scene = thin(sceneOf(under(bentLattice(0.25, 5), waveVolume()), kOblique, 2.0 / 32 / 16));
    EXPECT_GT(psnr(drawn(scene), castRays(scene, kSize)), 58);
    EXPECT_GT(psnr(drawn(lit(scene)), castRays(lit(scene), kSize)), 54);
}

TEST(CellTiles, AnUnmovedLatticeIsTheUndeformedPicture) {
    for (const Camera& camera : {kFront, kOblique, Camera{Vec3(0.1, -0.2, 0.3), Vec3(0.5, 1, 0), Vec3(0, 0, 1), 60}}) {
        const CompiledScene still = lit(thin(sceneOf(waveVolume(), camera, 0.01)));
        CompiledScene moved = still;
        moved.root = under(bentLattice(0, 6), waveVolume());
        EXPECT_GT(psnr(drawn(moved), drawn(still)), 56);
    }
}

TEST(CellTiles, ShowNoCracksBetweenCellsWhateverTheStep) {
    // kFront's middle rays run within faces of the unmoved lattice and along its edges.
    VolumeGrid grid{Index3(5), 1, unitGrid(5)};
    const auto volume = Volume::fromValues(grid, std::vector<std::uint8_t>(125, 9));
    const TermPtr block = makeVolumeTerm(volume, 0, constantLook(0.4, Vec3(0.9, 0.6, 0.1)));
    for (const Camera& camera : {kFront, kOblique, Camera{Vec3(0), Vec3(0, 1, 0.2), Vec3(0, 0, 1), 70}})
        for (const double amount : {0.0, 0.2}) {
            CompiledScene scene = sceneOf(under(bentLattice(amount, 4), block), camera, 2e-3);
            scene.opacityDistance = 0.7;
            const Picture exact = castRays(scene, kSize);
            for (const double step : {0.013, 0.5, 9.0}) {
                scene.render.step = step;
                const Picture picture = drawn(scene);
                for (std::size_t n = 0; n < picture.pixels.size(); ++n)
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(picture.pixels[n][c], exact.pixels[n][c], 2e-3)
                            << n << " " << amount << " " << step;
            }
        }
}

TEST(CellTiles, AffineMapsMayStandAboveAndBelow) {
    const TransferPtr above = placement(Vec3(0.2, 0, 0.1), Vec3(0.3, 0.7, 0.2), Vec3(1.2, 0.9, 1));
    const TransferPtr below = placement(Vec3(-0.1, 0.1, 0), Vec3(0.1, -0.3, 1), Vec3(0.8, 1, -0.9));
    const TermPtr term = under(above, under(bentLattice(0.2, 7), under(below, waveVolume()), TransferRole::SameList),
                               TransferRole::Place);
    CompiledScene scene = thin(sceneOf(term, kOblique, 0.05));
    scene.render.light = Vec3(1, -1, 2);
    EXPECT_TRUE(inPackets(scene));
    EXPECT_GT(psnr(drawn(scene), reference(scene)), 46);
    EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 42);
}

TEST(CellTiles, CellsMayReachBeyondTheVolumeOrFallShortOfIt) {
    for (const double reach : {0.6, 1.4}) {
        const auto bend = [](const Vec3& p) { return p + Vec3(0, 0.2 * std::sin(2 * p.x), 0.1 * p.x * p.x); };
        const TransferPtr map = carried({Vec3(-reach), Vec3(reach)}, {9, 5, 6}, bend);
        const CompiledScene scene = thin(sceneOf(under(map, waveVolume()), kOblique, 0.05));
        EXPECT_TRUE(inPackets(scene));
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 46) << reach;
    }
}

TEST(CellTiles, ARayMayEnterSeveralTimes) {
    // A bar bent almost to a ring.
    const auto ring = [](const Vec3& p) {
        const double angle = 2.7 * p.x, radius = 1 + 0.35 * p.z;
        return Vec3(radius * std::sin(angle), 0.3 * p.y, radius * std::cos(angle));
    };
    const TransferPtr map = carried({Vec3(-1), Vec3(1)}, {24, 3, 3}, ring);
    for (const Camera& camera : {Camera{Vec3(5, 0.4, 0.5), Vec3(0), Vec3(0, 0, 1), 32}, kOblique}) {
        const CompiledScene scene = thin(sceneOf(under(map, waveVolume()), camera, 0.02));
        EXPECT_TRUE(inPackets(scene));
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 44);
        EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 40);
    }
}

TEST(CellTiles, AreTheSameForEveryNumberOfThreadsAndPortion) {
    const CompiledScene scene = lit(thin(sceneOf(under(bentLattice(0.3, 16), waveVolume()), kOblique, 0.05)));
    expectSameForThreads(scene);
}

TEST(CellTiles, AnEditDrawsWhatAFreshStartDoes) {
    const TermPtr volume = waveVolume();
    RayRenderer renderer;
    for (const double amount : {0.1, 0.25, 0.0}) {
        const CompiledScene scene = lit(thin(sceneOf(under(bentLattice(amount, 6), volume), kOblique, 0.05)));
        renderer.begin(scene, kSize);
        renderer.advance(0);
        EXPECT_EQ(renderer.picture().pixels, drawn(scene).pixels);
    }
}

TEST(CellTiles, WhatOverlapsAndWhatIsKeptOutsideIsDrawnAsTheReferenceDoes) {
    const auto fold = [](const Vec3& p) { return Vec3(p.x, p.y, p.z + 1.5 * p.x * p.x - 2 * std::abs(p.x)); };
    const auto halves = [](const Vec3& p) { return Vec3(std::abs(p.x), p.y, p.z); };
    for (const TransferPtr& map :
         {carried({Vec3(-1), Vec3(1)}, Index3(4), halves), TransferPtr(bentLattice(0.2, 4, Outside::Keep)),
          carried({Vec3(-1), Vec3(1)}, Index3(4), fold)}) {
        const CompiledScene scene = lit(thin(sceneOf(under(map, waveVolume()), kOblique, 0.05)));
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 34);
    }
}

}  // namespace
}  // namespace voledit
