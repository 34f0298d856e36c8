// Rays that fragments walk, through volumes and baked maps, against rays of the reference.
#include "render/march_picture.h"

#include "core/stf/affine.h"
#include "core/stf/mapped_cells.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{160, 120};
constexpr double kUnit = 2.0 / 47;

TermPtr waves() {
    return makeVolumeTerm(wavesVolume(48), 0, softAppearance());
}
/// Whose values reach 0 well within its box.
TermPtr ball() {
    return makeVolumeTerm(ballVolume(48), 0, softAppearance());
}
TransferPtr twist(const Box3& box) {
    return library("twist", box, {{"axis", axis(2)}, {"angle", number(50)}});
}

Picture pictureOf(const CompiledScene& scene, bool moving = false) {
    offscreen();
    SliceRenderer renderer;
    renderer.begin(scene, kSize, 1, moving);
    renderer.advance(0);
    return renderer.readBack();
}

TEST(MarchPlan, OneVolumeUnderMapsWithOnePreImage) {
    const TermPtr plain = waves();
    const auto planned = [](const TermPtr& root) { return planMarch(sceneOf(root, kUnit)).has_value(); };
    EXPECT_TRUE(planned(plain));
    EXPECT_TRUE(planned(through(bentLattice(plain->bounds), plain)));
    EXPECT_TRUE(planned(through(twist(plain->bounds), plain)));
    EXPECT_TRUE(planned(through(twist(plain->bounds), through(bentLattice(plain->bounds), plain))));
    EXPECT_FALSE(planned(through(foldedLattice(plain->bounds), plain))) << "several pre-images";
    TransferFunction steep = softAppearance();
    steep.gradientOpacity.points = {{0, 0}, {1000, 1}};
    EXPECT_FALSE(planned(makeVolumeTerm(wavesVolume(16), 0, steep))) << "opacity by steepness";
    EXPECT_FALSE(planned(makeVolumeTerm(wavesVolume(16), 0, softAppearance(), Interpolation::Cubic)));
    CompiledScene dark = sceneOf(plain, kUnit);
    dark.render.shadows = 1;
    EXPECT_TRUE(planMarch(dark)) << "shadows are looked up";
}

TEST(MarchPicture, IsAsCloseToFineRaysAsSlicesAre) {
    for (const TermPtr& root :
         {waves(), through(bentLattice(waves()->bounds), waves()), through(twist(waves()->bounds), waves())})
        for (const bool shading : {false, true}) {
            const CompiledScene scene = sceneOf(root, kUnit, shading);
            const Picture exact = raysOf(scene, kSize, 8);
            EXPECT_GE(psnr(pictureOf(scene), exact), psnr(slicesOf(scene, kSize, {.march = false}), exact) - 1);
        }
}

/// Few values, which neighbours differ in, as voxels of type T.
template <class T>
std::shared_ptr<const Volume> fewValues() {
    VolumeGrid grid;
    grid.size = Index3(12);
    std::vector<T> values;
    for (int n = 0; n < 12 * 12 * 12; ++n) values.push_back(T(100 + (n + n / 12 * 2 + n / 144 * 3) % 8));
    return Volume::fromValues(grid, std::move(values));
}

TEST(MarchPicture, BytesAreFilteredAsFinelyAsFloats) {
    TransferFunction look;  // that shows differences below one of 255 levels
    look.color.points = {{100, {1, 0, 0}}, {102, {0, 1, 0}}, {104, {0, 0, 1}}, {107, {1, 1, 0}}};
    look.opacity.points = {{100, 0.02}, {107, 0.3}};
    for (const bool march : {true, false}) {
        const auto drawn = [&](const std::shared_ptr<const Volume>& volume) {
            return slicesOf(sceneOf(makeVolumeTerm(volume, 0, look), 1), kSize, {.march = march});
        };
        const Picture floats = drawn(fewValues<float>());
        EXPECT_GE(psnr(drawn(fewValues<std::uint8_t>()), floats), 60);
        EXPECT_GE(psnr(drawn(fewValues<std::int8_t>()), floats), 60);
        EXPECT_GE(psnr(drawn(fewValues<std::uint16_t>()), floats), 60);
    }
}

TEST(MarchPicture, ChainsAreBakedAsAWholeWhileMovingAndExactAtRest) {
    const TermPtr inner = through(bentLattice(ball()->bounds), ball());
    const auto turn = std::make_shared<AffineMap>(placementMatrix({0.1, -0.1, 0}, {0.2, 0.5, -0.1}, {1.1, 0.9, 1}));
    const TermPtr root = through(turn, through(twist(inner->bounds), inner));
    const CompiledScene scene = sceneOf(root, kUnit);
    EXPECT_GE(psnr(pictureOf(scene), raysOf(scene, kSize, 8)), 42);
    offscreen();
    SliceRenderer renderer;
    for (const bool moving : {true, false}) {
        renderer.begin(scene, kSize, 1, moving);
        renderer.advance(0);
        EXPECT_EQ(renderer.statistics().polygons == 0, moving) << "what moves is not cut";
    }
}

TEST(MarchPicture, WhatATearCutsIsExactAtRestAndNearlySoWhileMoving) {
    const TermPtr plain = waves();
    const TermPtr root =
        through(library("split", plain->bounds, {{"axis", axis(0)}, {"at", number(0.5)}, {"gap", number(0.3)}}), plain);
    const CompiledScene scene = sceneOf(root, kUnit);
    const Picture exact = raysOf(scene, kSize, 8);
    EXPECT_GE(psnr(pictureOf(scene), exact), psnr(slicesOf(scene, kSize, {.march = false}), exact) - 0.01);
    EXPECT_GE(psnr(pictureOf(scene, true), exact), 25);
}

TEST(MarchPicture, MovingAndRestingFollowEachOther) {
    const TermPtr root = through(bentLattice(waves()->bounds), waves());
    const CompiledScene scene = sceneOf(root, kUnit);
    const Picture rest = pictureOf(scene);
    offscreen();
    SliceRenderer renderer;
    for (const bool moving : {true, false, true, false}) {
        renderer.begin(scene, kSize, moving ? 2 : 1, moving);
        renderer.advance(0);
        EXPECT_GE(psnr(renderer.readBack(), rest), moving ? 30 : 200);
    }
}

}  // namespace
}  // namespace voledit
