#include "core/rays/ray_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/core/rays/ray_scenes.h"

namespace voledit {
namespace {

using namespace test;

TEST(RayRenderer, DrawsEveryVoxelTypeAsTheReferenceDoes) {
    constexpr int n = 33;
    const Mat4 grid = unitGrid(n);
    const std::vector<std::pair<std::shared_ptr<const Volume>, TransferFunction>> volumes{
        {typed<std::uint8_t>(Index3(n), grid), bands()},
        {typed<std::int8_t>(Index3(n), grid, 1, -100), moved(bands(), 1, -100)},
        {typed<std::uint16_t>(Index3(n), grid, 300), moved(bands(), 300, 0)},
        {typed<std::int16_t>(Index3(n), grid, 300, -30000), moved(bands(), 300, -30000)},
        {typed<std::int32_t>(Index3(n), grid, 300, -30000), moved(bands(), 300, -30000)},
        {typed<std::uint32_t>(Index3(n), grid, 300), moved(bands(), 300, 0)},
        {typed<float>(Index3(n), grid, 1e-3, 5), moved(bands(), 1e-3, 5)},
        {typed<double>(Index3(n), grid), bands()}};
    for (const auto& [volume, look] : volumes) {
        CompiledScene scene = sceneOf(makeVolumeTerm(volume, 0, look), kOblique, 2.0 / (n - 1));
        scene.opacityDistance = 0.15;
        // The reference's own middle steps err as much at this step.
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 46) << nameOf(volume->type());
        EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 40) << nameOf(volume->type());
    }
}

TEST(RayRenderer, FineStepsConvergeToTheReference) {
    constexpr int n = 25;
    const TermPtr term = makeVolumeTerm(typed<std::uint8_t>(Index3(n), unitGrid(n)), 0, bands());
    CompiledScene scene = sceneOf(term, kOblique, 2.0 / (n - 1) / 16);
    scene.opacityDistance = 0.15;
    EXPECT_GT(psnr(drawn(scene), castRays(scene, kSize)), 58);
    EXPECT_GT(psnr(drawn(lit(scene)), castRays(lit(scene), kSize)), 54);
}

TEST(RayRenderer, GridsMayBeTurnedShearedAndMirrored) {
    const Mat4 sheared(Vec4(0.07, 0.02, 0, 0), Vec4(-0.03, 0.06, 0.02, 0), Vec4(0, 0.01, -0.08, 0),
                       Vec4(-0.6, -0.9, 0.8, 1));
    const TermPtr volume = makeVolumeTerm(typed<std::int16_t>({24, 25, 22}, sheared), 0, bands());
    const TermPtr placed = makeTransferTerm(
        std::make_shared<AffineMap>(placementMatrix(Vec3(0.2, 0, 0.1), Vec3(20, 40, 10), Vec3(1.2, 0.9, 1))), volume,
        Combine::Union, "", TransferRole::Place);
    for (const TermPtr& term : {volume, placed}) {
        CompiledScene scene = sceneOf(term, kOblique, 0.04);
        scene.opacityDistance = 0.15;
        scene.render.light = Vec3(1, -1, 2);
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 46);
        EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 42);
    }
}

TEST(RayRenderer, AHomogeneousBlockIsExactForEveryStep) {
    const Vec3 color(0.9, 0.6, 0.1);
    for (const Camera& camera : {kOblique, Camera{Vec3(0), Vec3(0, 1, 0.2), Vec3(0, 0, 1), 70}})
        for (const double step : {0.013, 0.5, 1.7, 9.0}) {
            VolumeGrid grid{Index3(5), 1, unitGrid(5)};
            const auto volume = Volume::fromValues(grid, std::vector<std::uint8_t>(125, 9));
            CompiledScene scene = sceneOf(makeVolumeTerm(volume, 0, constantLook(0.4, color)), camera, step);
            scene.opacityDistance = 0.7;
            const Picture picture = drawn(scene), exact = castRays(scene, kSize);
            for (std::size_t n = 0; n < picture.pixels.size(); ++n)
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(picture.pixels[n][c], exact.pixels[n][c], 1e-4) << step;
        }
}

TEST(RayRenderer, IsTheSameForEveryNumberOfThreadsAndPortion) {
    const TermPtr term = makeVolumeTerm(typed<std::uint16_t>(Index3(40), unitGrid(40), 300), 0, moved(bands(), 300, 0));
    CompiledScene scene = lit(sceneOf(term, kOblique, 0.05));
    scene.opacityDistance = 0.15;
    expectSameForThreads(scene);
}

TEST(RayRenderer, AnEyeWithinSeesOnlyWhatLiesAhead) {
    const TermPtr term = makeVolumeTerm(typed<std::uint8_t>(Index3(33), unitGrid(33)), 0, bands());
    CompiledScene scene = sceneOf(term, {Vec3(0.1, -0.2, 0.3), Vec3(0.5, 1, 0), Vec3(0, 0, 1), 60}, 0.06);
    scene.opacityDistance = 0.15;
    EXPECT_GT(psnr(drawn(scene), reference(scene)), 46);
}

TEST(RayRenderer, ThinVolumes) {
    for (const Index3 size : {Index3(1, 30, 20), Index3(20, 1, 20), Index3(20, 20, 1), Index3(2, 30, 20),
                              Index3(20, 3, 2), Index3(2, 2, 2), Index3(3, 1, 1), Index3(1, 1, 1)}) {
        const Mat4 grid = placementMatrix(Vec3(-0.05 * Vec3(size - 1)), Vec3(0), Vec3(0.1));
        CompiledScene scene = lit(sceneOf(makeVolumeTerm(typed<std::uint8_t>(size, grid), 0, bands()), kOblique, 0.05));
        scene.opacityDistance = 0.15;
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 40) << size.x << " " << size.y << " " << size.z;
    }
}

TEST(RayRenderer, VoxelsThatAreNotNumbersAreEmpty) {
    constexpr int n = 33;
    VolumeGrid grid{Index3(n), 1, unitGrid(n)};
    std::vector<float> values;
    for (std::size_t i = 0; i < grid.sampleCount(); ++i) {
        const Vec3 p = transformPoint(grid.worldFromIndex, Vec3(Index3(i % n, i / n % n, i / (n * n))));
        values.push_back(glm::length(p - Vec3(0.3, -0.4, 0.2)) < 0.5 ? std::nanf("") : static_cast<float>(waves(p)));
    }
    CompiledScene scene = lit(sceneOf(makeVolumeTerm(Volume::fromValues(grid, values), 0, bands()), kOblique, 0.03));
    scene.opacityDistance = 0.15;
    const Picture picture = drawn(scene);
    EXPECT_GT(psnr(picture, reference(scene)), 36);
    for (const Vec4f& pixel : picture.pixels) ASSERT_TRUE(std::isfinite(pixel.r + pixel.g + pixel.b + pixel.a));
}

TEST(RayRenderer, StepsOfTheTransferFunctionStandWhereTheyAre) {
    TransferFunction look = bands();
    look.opacity.points = {{99, 0}, {99, 0.95}, {140, 0.95}, {140, 0.3}};
    const TermPtr term = makeVolumeTerm(typed<float>(Index3(33), unitGrid(33)), 0, look);
    CompiledScene scene = sceneOf(term, kOblique, 0.0625);
    scene.opacityDistance = 0.1;
    EXPECT_GT(psnr(drawn(scene), reference(scene)), 40);
}

TEST(RayRenderer, NothingToSeeIsTheBackground) {
    const Vec4f background(0, 0, 0.5F, 0);
    const auto volume = typed<std::uint8_t>(Index3(20), unitGrid(20));
    const TermPtr term = makeVolumeTerm(volume, 0, constantLook(0, Vec3(1)));
    for (const Vec4f& pixel : drawn(sceneOf(term, kFront, 0.1)).pixels) ASSERT_EQ(pixel, background);
    Camera away = kFront;
    away.target = Vec3(0, -12, 0);
    const TermPtr seen = makeVolumeTerm(volume, 0, constantLook(1, Vec3(1)));
    for (const Vec4f& pixel : drawn(sceneOf(seen, away, 0.1)).pixels) ASSERT_EQ(pixel, background);
}

TEST(RayRenderer, RigsShadowsAndOcclusionAreTheReferences) {
    const TermPtr volume = makeVolumeTerm(typed<std::uint8_t>(Index3(33), unitGrid(33)), 0, bands());
    const TermPtr bent = makeTransferTerm(bentLattice(0.25, 6), volume, Combine::Union, "");
    for (const TermPtr& term : {volume, bent})
        for (const LightRig rig : {LightRig::Headlight, LightRig::KeyFillRim, LightRig::Soft, LightRig::Dramatic})
            for (const double amount : {0.0, 0.8}) {
                CompiledScene scene = lit(sceneOf(term, kOblique, 2.0 / 32));
                scene.opacityDistance = 0.15;
                scene.render.rig = rig;
                scene.render.shadows = scene.render.occlusion = amount;
                const Picture picture = drawn(scene);
                // Surroundings are known as finely as steps are long, so that the reference's must be as long.
                CompiledScene same = scene;
                if (amount == 0) same.render.step /= 16;
                EXPECT_GT(psnr(picture, castRays(same, kSize)), amount == 0 ? 40 : 34) << int(rig) << " " << amount;
            }
}

TEST(RayRenderer, OpacityBySteepness) {
    TransferFunction steep = bands();
    steep.gradientOpacity.points = {{50, 0}, {120, 0.3}, {200, 1}};
    const Mat4 stretched = placementMatrix(Vec3(-1), Vec3(0), Vec3(1.2, 1, 0.8) * (2.0 / 32));
    const TermPtr volume = makeVolumeTerm(typed<std::uint8_t>(Index3(33), stretched), 0, steep);
    const TermPtr bent = makeTransferTerm(bentLattice(0.25, 6), volume, Combine::Union, "");
    for (const TermPtr& term : {volume, bent}) {
        CompiledScene scene = sceneOf(term, kOblique, 0.05);
        scene.opacityDistance = 0.15;
        EXPECT_NE(drawn(scene).pixels, castRays(scene, kSize).pixels);  // in packets
        EXPECT_GT(psnr(drawn(scene), reference(scene)), 44);
        EXPECT_GT(psnr(drawn(lit(scene)), reference(lit(scene))), 40);
    }
}

TEST(RayRenderer, OtherTermsGoTheReferencesWay) {
    const TermPtr volume = makeVolumeTerm(typed<std::uint8_t>(Index3(20), unitGrid(20)), 0, bands());
    const TermPtr ball = solid(SphereShape{Vec3(0.2, -0.3, 0.1), 0.7}, Vec3(1, 0.4, 0.2), "0.6");
    const std::vector<TermPtr> terms{
        ball, makeCvgTerm(CvgOperator::Difference, {volume, ball}), fields("0.5 * (x > 0)", Vec3(0.2, 0.5, 1)),
        makeVolumeTerm(typed<std::uint8_t>(Index3(20), unitGrid(20)), 0, bands(), Interpolation::Cubic),
        makeVolumeTerm(typed<std::uint8_t>(Index3(20), unitGrid(20)), 0, bands(), Interpolation::Nearest)};
    for (const TermPtr& term : terms) {
        CompiledScene scene = lit(sceneOf(term, kOblique, 0.05));
        EXPECT_EQ(drawn(scene).pixels, castRays(scene, kSize).pixels);
    }
}

}  // namespace
}  // namespace voledit
