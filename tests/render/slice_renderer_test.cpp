#include "render/slice_renderer.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/stf/affine.h"
#include "core/stf/mapped_cells.h"
#include "tests/render/render_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{160, 120};

TermPtr plainTerm(int size = 32) {
    return makeVolumeTerm(wavesVolume(size), 0, softAppearance());
}
TermPtr bentTerm(int size = 32) {
    const TermPtr plain = plainTerm(size);
    return makeTransferTerm(bentLattice(plain->bounds), plain, Combine::Union, "bent");
}
double unitOf(int size) {
    return 2.0 / (size - 1);
}

/// What is left at the usual step lies along the outline, where rays that pass less than a slab of the volume may miss
/// every slice (measured: 45 to 48 dB, the inside alone above 50); ConvergesToRaysAsTheStepFalls shows it vanish.
void expectCloseToRays(const CompiledScene& scene, double decibels) {
    EXPECT_GE(psnr(slicesOf(scene, kSize), raysOf(scene, kSize)), decibels);
}

TEST(SliceRenderer, UndeformedVolumeMatchesRays) {
    expectCloseToRays(sceneOf(plainTerm(), unitOf(32), false), 45);
    expectCloseToRays(sceneOf(plainTerm(), unitOf(32), true), 44);
}

TEST(SliceRenderer, BentVolumeMatchesRays) {
    expectCloseToRays(sceneOf(bentTerm(), unitOf(32), false), 45);
    expectCloseToRays(sceneOf(bentTerm(), unitOf(32), true), 44);
}

TEST(SliceRenderer, AffineMapsAboveAndBelowALatticeMatchRays) {
    const auto turn = std::make_shared<AffineMap>(placementMatrix({0.3, -0.2, 0.1}, {0.4, 0.9, -0.3}, {1.2, 0.7, -1}));
    const TermPtr turned = makeTransferTerm(turn, plainTerm(), Combine::Union, "");
    expectCloseToRays(sceneOf(turned, unitOf(32)), 45);
    const TermPtr bent = makeTransferTerm(bentLattice(turned->bounds), turned, Combine::Union, "");
    expectCloseToRays(sceneOf(bent, unitOf(32)), 45);
    expectCloseToRays(sceneOf(makeTransferTerm(turn, bent, Combine::Union, ""), unitOf(32)), 45);
}

TEST(SliceRenderer, ConvergesToRaysAsTheStepFalls) {
    const CompiledScene scene = sceneOf(bentTerm(), unitOf(32));
    const Picture exact = raysOf(scene, kSize, 16);
    const double coarse = psnr(slicesOf(scene, kSize, {}, 1), exact);
    const double fine = psnr(slicesOf(scene, kSize, {}, 0.25), exact);
    EXPECT_GE(fine, coarse + 9) << coarse << " dB at the usual step, " << fine << " dB at a quarter of it";
}

TEST(SliceRenderer, UnmovedLatticeChangesNothing) {
    const TermPtr plain = plainTerm();
    const CompiledScene without = sceneOf(plain, unitOf(32));
    CompiledScene with = without;
    with.root = makeTransferTerm(restLattice(plain->bounds), plain, Combine::Union, "rest");
    EXPECT_GE(psnr(slicesOf(with, kSize), slicesOf(without, kSize)), 55);
}

TEST(SliceRenderer, SolidBlockUnderALatticeHasNoCracks) {
    const auto volume = sampled(Index3(16), [](const Vec3&) { return 500.0; });
    const TermPtr block = makeVolumeTerm(volume, 0, constantAppearance(0.9999, {0.25, 0.5, 0.75}));
    const CompiledScene scene =
        sceneOf(makeTransferTerm(bentLattice(block->bounds), block, Combine::Union, ""), unitOf(16), false);
    const Picture picture = slicesOf(scene, {640, 480}, {.mask = false});
    const Picture rays = raysOf(scene, {640, 480}, 1);
    int inside = 0;
    for (int y = 2; y < 478; ++y)
        for (int x = 2; x < 638; ++x) {
            // Only where the block is thick: at its outline rays and slices may differ by a slab.
            bool thick = true;
            for (int v = -2; v <= 2; ++v)
                for (int u = -2; u <= 2; ++u) thick = thick && rays.at(x + u, y + v).a > 0.9999F;
            if (!thick) continue;
            ++inside;
            const Vec4f p = picture.at(x, y);
            ASSERT_LT(glm::length(p - Vec4f(0.25F, 0.5F, 0.75F, 1)), 2e-3F) << x << "," << y;
        }
    EXPECT_GT(inside, 20000);
}

TEST(SliceRenderer, EveryPixelOfAThinBlockIsDrawnOnce) {
    // Thin absorption is additive: a crack shows darker, a shared edge drawn twice brighter.
    const auto volume = sampled(Index3(40), [](const Vec3&) { return 500.0; });
    const TermPtr block = makeVolumeTerm(volume, 0, constantAppearance(0.05, {1, 1, 1}));
    for (const bool lattice : {false, true}) {
        CompiledScene scene =
            sceneOf(lattice ? makeTransferTerm(restLattice(block->bounds), block, Combine::Union, "") : block,
                    unitOf(40), false);
        // Along y only, so that every ray meets the same number of slices but near the outline.
        scene.camera.eye = scene.camera.target - Vec3(0, 40, 0);
        scene.camera.fovY = 2;
        const Picture picture = slicesOf(scene, {400, 300});
        const float middle = picture.at(200, 150).a;
        EXPECT_NEAR(middle, 1 - std::pow(0.95, 39), 0.002);
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 400; ++x) {
                const double world = 40 * std::tan(kPi / 180);  // half height at the block's middle
                const double across = std::abs((x + 0.5) / 150 - 400.0 / 300) * world;
                const double up = std::abs((y + 0.5) / 150 - 1) * world;
                if (std::max(across, up) < 0.95) {
                    ASSERT_NEAR(picture.at(x, y).a, middle, 0.001) << x << "," << y;
                }
                if (std::max(across, up) > 1.05) {
                    ASSERT_EQ(picture.at(x, y).a, 0) << x << "," << y;
                }
            }
    }
}

TEST(SliceRenderer, ObliqueRaysAreAsOpaqueAsTheirLength) {
    // A wide angle: through a slab of thickness d a ray at angle θ passes d / cos θ.
    const auto volume = sampled(Index3(33), [](const Vec3&) { return 1.0; });
    const TermPtr block = makeVolumeTerm(volume, 0, constantAppearance(0.02, {1, 1, 1}));
    CompiledScene scene = sceneOf(block, 1.0 / 16, false);
    scene.camera = {{0, -1.5, 0}, {0, 0, 0}, {0, 0, 1}, 60};
    const Picture picture = slicesOf(scene, {200, 200});
    const double perUnit = -std::log(1 - 0.02) * 16;
    for (const int x : {100, 120, 140}) {
        const double tangent = ((x + 0.5) / 100 - 1) * std::tan(kPi / 6);
        // From y = −1 to 1 while |x| ≤ 1.
        const double enters = 0.5, leaves = std::min(2.5, 1 / std::abs(tangent));
        const double length = (leaves - enters) * std::sqrt(1 + tangent * tangent);
        EXPECT_NEAR(picture.at(x, 100).a, 1 - std::exp(-perUnit * length), 0.01) << x;
    }
}

TEST(SliceRenderer, EyeInsideTheVolumeMatchesRays) {
    for (const TermPtr& term : {plainTerm(), bentTerm()}) {
        CompiledScene scene = sceneOf(term, unitOf(32));
        scene.camera.eye = {0.1, -0.2, 0.05};
        scene.camera.target = {0.5, 0.6, 0.2};
        scene.camera.fovY = 60;
        expectCloseToRays(scene, 40);
    }
}

TEST(SliceRenderer, CullingChangesNothing) {
    const TermPtr ball = makeVolumeTerm(ballVolume(96), 0, softAppearance());
    const TermPtr bent = makeTransferTerm(bentLattice(ball->bounds), ball, Combine::Union, "");
    for (const TermPtr& term : {ball, bent}) {
        const CompiledScene scene = sceneOf(term, unitOf(96));
        offscreen();
        SliceRenderer culled, whole({.cull = false});
        const Picture a = renderSlices(culled, scene, kSize), b = renderSlices(whole, scene, kSize);
        EXPECT_GT(culled.statistics().culledCells, whole.statistics().cells / 4);
        EXPECT_EQ(whole.statistics().culledCells, 0u);
        EXPECT_EQ(a.pixels, b.pixels);
    }
}

TEST(SliceRenderer, MaskingOpaquePixelsIsNotSeen) {
    const TermPtr ball = makeVolumeTerm(ballVolume(48), 0, constantAppearance(0.8, {1, 0.5, 0.25}));
    const CompiledScene scene = sceneOf(ball, unitOf(48) / 8);
    const Picture masked = slicesOf(scene, kSize), whole = slicesOf(scene, kSize, {.mask = false});
    for (std::size_t n = 0; n < masked.pixels.size(); ++n)
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(masked.pixels[n][c], whole.pixels[n][c], 0.5 / 255);
}

TEST(SliceRenderer, InPiecesIsTheSameAsAtOnce) {
    const CompiledScene scene = sceneOf(bentTerm(), unitOf(32) / 4);
    offscreen();
    SliceRenderer renderer;
    const Picture whole = renderSlices(renderer, scene, kSize);
    renderer.begin(scene, kSize);
    EXPECT_LT(renderer.progress(), 1);
    int calls = 1;
    double before = 0;
    while (!renderer.advance(0.01)) {
        ++calls;
        EXPECT_GT(renderer.progress(), before);
        before = renderer.progress();
    }
    EXPECT_GT(calls, 5);
    EXPECT_EQ(renderer.progress(), 1);
    EXPECT_EQ(renderer.readBack().pixels, whole.pixels);
}

TEST(SliceRenderer, WhatChangedIsDrawnAnew) {
    offscreen();
    SliceRenderer one;
    const auto fresh = [](const CompiledScene& scene) { return slicesOf(scene, kSize); };
    CompiledScene scene = sceneOf(plainTerm(), unitOf(32));
    EXPECT_EQ(renderSlices(one, scene, kSize).pixels, fresh(scene).pixels);
    const Picture first = fresh(scene);
    // Another lattice, appearance, volume, channel-free step and size, one after the other.
    scene.root = bentTerm();
    EXPECT_NE(fresh(scene).pixels, first.pixels);
    EXPECT_EQ(renderSlices(one, scene, kSize).pixels, fresh(scene).pixels);
    scene.root = makeVolumeTerm(std::get<VolumeTerm>(plainTerm()->node).volume, 0, constantAppearance(0.3, {1, 0, 0}));
    EXPECT_EQ(renderSlices(one, scene, kSize).pixels, fresh(scene).pixels);
    scene.root = makeVolumeTerm(ballVolume(20), 0, softAppearance());
    EXPECT_EQ(renderSlices(one, scene, kSize).pixels, fresh(scene).pixels);
    scene.render.step = 0.2;
    EXPECT_EQ(renderSlices(one, scene, kSize).pixels, fresh(scene).pixels);
    EXPECT_EQ(renderSlices(one, scene, {90, 70}).size, Index2(90, 70));
}

TEST(SliceRenderer, VolumesTooLargeForOpenGlAreDrawnReduced) {
    const CompiledScene scene = sceneOf(makeVolumeTerm(ballVolume(96), 0, softAppearance()), unitOf(96));
    offscreen();
    SliceRenderer limited({.largestTexture = 50}), whole;
    const Picture reduced = renderSlices(limited, scene, kSize);
    ASSERT_EQ(limited.notices().size(), 1u);
    EXPECT_NE(limited.notices()[0].find("48x48x48"), std::string::npos) << limited.notices()[0];
    const Picture full = renderSlices(whole, scene, kSize);
    EXPECT_TRUE(whole.notices().empty());
    EXPECT_NE(reduced.pixels, full.pixels);
    EXPECT_GE(psnr(reduced, full), 30);
    CompiledScene small = scene;
    small.root = makeVolumeTerm(ballVolume(40), 0, softAppearance());
    EXPECT_EQ(renderSlices(limited, small, kSize).pixels, renderSlices(whole, small, kSize).pixels);
    EXPECT_TRUE(limited.notices().empty());
}

TEST(SliceRenderer, EveryVoxelTypeGivesTheSamePicture) {
    const auto waves = wavesVolume(20);
    const Picture real = slicesOf(sceneOf(makeVolumeTerm(waves, 0, softAppearance()), unitOf(20)), kSize);
    const auto check = [&](auto t, double scale, double offset) {
        using T = decltype(t);
        std::vector<T> values;
        for (int n = 0; n < 8000; ++n)
            values.push_back(T(std::lround(waves->at({n % 20, n / 20 % 20, n / 400}) * scale + offset)));
        TransferFunction appearance = softAppearance();
        for (auto& point : appearance.color.points) point.value = point.value * scale + offset;
        for (auto& point : appearance.opacity.points) point.x = point.x * scale + offset;
        const auto volume = Volume::fromValues(waves->grid(), std::move(values));
        const CompiledScene scene = sceneOf(makeVolumeTerm(volume, 0, appearance), unitOf(20));
        EXPECT_GE(psnr(slicesOf(scene, kSize), real), sizeof(T) == 1 ? 38 : 55) << int(volume->type());
        EXPECT_GE(psnr(slicesOf(scene, kSize), raysOf(scene, kSize)), 42) << int(volume->type());
    };
    check(std::uint8_t{}, 0.25, 0);
    check(std::int8_t{}, 0.25, -125);
    check(std::uint16_t{}, 60, 100);
    check(std::int16_t{}, 60, -30000);
    check(std::int32_t{}, 1000, -500000);
    check(std::uint32_t{}, 1000, 3e9);
    check(double{}, 1, 0);
}

TEST(SliceRenderer, GradientOpacityMatchesRays) {
    TransferFunction appearance = softAppearance();
    appearance.gradientOpacity.points = {{0, 0}, {1000, 0.2}, {3000, 1}};
    const TermPtr plain = makeVolumeTerm(wavesVolume(32), 0, appearance);
    expectCloseToRays(sceneOf(plain, unitOf(32)), 42);
    expectCloseToRays(sceneOf(makeTransferTerm(bentLattice(plain->bounds), plain, Combine::Union, ""), unitOf(32)), 42);
}

TEST(SliceRenderer, StepsInTheOpacityTableMatchRays) {
    TransferFunction appearance = softAppearance();
    appearance.opacity.points = {{400, 0}, {400, 0.3}, {700, 0.3}, {700, 0.05}};
    expectCloseToRays(sceneOf(makeVolumeTerm(wavesVolume(32), 0, appearance), unitOf(32)), 40);
}

TEST(SliceRenderer, VoxelsThatAreNoNumbersAreClear) {
    const auto volume = sampled(Index3(24), [](const Vec3& p) { return p.x > 0.3 ? kNaN : 800.0; });
    const CompiledScene scene = sceneOf(makeVolumeTerm(volume, 0, softAppearance()), unitOf(24));
    const Picture picture = slicesOf(scene, kSize);
    for (const Vec4f& p : picture.pixels) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z + p.a));
    expectCloseToRays(scene, 35);
}

TEST(SliceRenderer, LightAndBackgroundMatchRays) {
    CompiledScene scene = sceneOf(bentTerm(), unitOf(32));
    scene.render.background = {0.2, 0.4, 0.7};
    scene.render.light = Vec3(1, 2, 3);
    scene.render.specular = 0.6;
    expectCloseToRays(scene, 44);
}

struct FoldCase {
    Combine combine;
    Outside outside;
    bool folds;
};

class FoldedSlices : public testing::TestWithParam<FoldCase> {};

TEST_P(FoldedSlices, MatchRays) {
    const FoldCase c = GetParam();
    TransferFunction appearance = softAppearance();
    appearance.opacity.points = {{300, 0}, {900, 0.35}};
    const TermPtr plain = makeVolumeTerm(wavesVolume(24), 0, appearance);
    Lattice lattice = (c.folds ? foldedLattice(plain->bounds) : bentLattice(plain->bounds))->lattice();
    if (c.outside == Outside::Keep) {
        // A lattice about the middle of the volume only.
        lattice.frame = frameOf({Vec3(-0.6), Vec3(0.7)});
        for (Vec3& p : lattice.control) p = 0.6 * p;
    }
    const auto map = std::make_shared<LatticeMap>(lattice, Index3(8), c.outside);
    ASSERT_EQ(map->cells()->mayOverlap(), c.folds);
    for (const bool shading : {false, true}) {
        const CompiledScene scene = sceneOf(makeTransferTerm(map, plain, c.combine, ""), unitOf(24), shading);
        // Pre-images combine at single points, so steps are finer than usual.
        const Picture slices = slicesOf(scene, kSize, {}, 0.25);
        EXPECT_GE(psnr(slices, raysOf(scene, kSize, 4)), 42) << "shading " << shading;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, FoldedSlices,
    testing::Values(FoldCase{Combine::Union, Outside::Hide, true}, FoldCase{Combine::Merge, Outside::Hide, true},
                    FoldCase{Combine::Intersection, Outside::Hide, true}, FoldCase{Combine::First, Outside::Hide, true},
                    FoldCase{Combine::Union, Outside::Keep, false}, FoldCase{Combine::Union, Outside::Keep, true},
                    FoldCase{Combine::Merge, Outside::Keep, true}, FoldCase{Combine::First, Outside::Keep, true}));

TEST(SliceRenderer, NothingInViewIsAnEmptyPicture) {
    CompiledScene scene = sceneOf(plainTerm(), unitOf(32));
    scene.render.background = {0.5, 0.25, 0};
    scene.camera.target = scene.camera.eye + (scene.camera.eye - scene.camera.target);
    for (const Vec4f& p : slicesOf(scene, kSize).pixels) ASSERT_EQ(p, Vec4f(0.5F, 0.25F, 0, 0));
}

}  // namespace
}  // namespace voledit
