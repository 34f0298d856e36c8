#include "core/eval/ray_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/eval/cut_faces.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

using namespace test;

const Camera kFront{Vec3(0, -6, 0), Vec3(0), Vec3(0, 0, 1), 30};
const Camera kOblique{Vec3(3, -5, 2.5), Vec3(0.1, 0, -0.1), Vec3(0.1, 0, 1), 32};

/// Length of the ray within [−1, 1]³.
double lengthInBox(const Vec3& origin, const Vec3& direction) {
    double near = 0, far = kInfinity;
    for (int a = 0; a < 3; ++a) {
        const double s = (-1 - origin[a]) / direction[a], t = (1 - origin[a]) / direction[a];
        near = std::max(near, std::min(s, t));
        far = std::min(far, std::max(s, t));
    }
    return std::max(0.0, far - near);
}

TEST(RayCaster, AHomogeneousBlockIsExactForEveryStep) {
    const Vec3 color(0.9, 0.6, 0.1);
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(0.4, color));
    for (const double step : {0.013, 0.5, 1.7, 9.0}) {
        CompiledScene scene = sceneOf(block, kOblique, step);
        scene.opacityDistance = 0.7;
        const Index2 size(40, 30);
        const Picture picture = castRays(scene, size);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const double length = lengthInBox(scene.camera.eye, rayThrough(scene.camera, size, x, y));
                const double through = std::pow(0.6, length / 0.7);
                const Vec3 expected = (1 - through) * color + through * scene.render.background;
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(x, y)[c], expected[c], 1e-6);
                EXPECT_NEAR(picture.at(x, y).a, 1 - through, 1e-6);
            }
    }
}

TEST(RayCaster, FullOpacityIsBounded) {
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(1, Vec3(1)));
    CompiledScene scene = sceneOf(block, kFront, 0.1);
    scene.opacityDistance = 8;
    EXPECT_NEAR(castRays(scene, {1, 1}).at(0, 0).a, 1 - std::pow(1e-4, 2 / 8.0), 1e-6);
}

TEST(RayCaster, AnEyeWithinSeesOnlyWhatLiesAhead) {
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(0.5, Vec3(1)));
    const CompiledScene scene = sceneOf(block, {Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1), 30}, 0.1);
    EXPECT_NEAR(castRays(scene, {1, 1}).at(0, 0).a, 0.5, 1e-6);
}

TEST(RayCaster, MissesShowTheBackground) {
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(0.5, Vec3(1)));
    for (const Camera& camera : {Camera{Vec3(0, -6, 0), Vec3(0, -12, 0), Vec3(0, 0, 1), 30},
                                 Camera{Vec3(0, -6, 0), Vec3(6, -6, 0), Vec3(0, 0, 1), 30}}) {
        RayStatistics statistics;
        const Picture picture = castRays(sceneOf(block, camera, 0.1), {5, 5}, &statistics);
        for (const Vec4f& pixel : picture.pixels) EXPECT_EQ(pixel, Vec4f(0, 0, 0.5, 0));
        EXPECT_EQ(statistics.samples, 0u);
    }
}

TEST(RayCaster, AnObjectNowhereShowsTheBackground) {
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(0.5, Vec3(1)));
    const auto nowhere = std::make_shared<CellMap>(MappedCells::Data{}, Outside::Hide);  // no cells: an empty image
    const auto term = makeTransferTerm(nowhere, block, Combine::Union, "");
    for (const Vec4f& pixel : castRays(sceneOf(term, kFront, 0.1), {4, 4}).pixels)
        EXPECT_EQ(pixel, Vec4f(0, 0, 0.5, 0));
}

/// Opacity s = (y + 1) / 2 · 0.8 along the view: the optical depth through it is an integral in closed form.
TermPtr rampBlock() {
    TransferFunction f = constantLook(0, Vec3(1, 0.5, 0.25));
    f.opacity.points = {{0, 0}, {1, 0.8}};
    return makeVolumeTerm(sampledVolume(9, [](const Vec3& p) { return (p.y + 1) / 2; }), 0, f);
}

double rampThrough(double from, double to) {
    // −∫ ln(1 − 0.8 s) · 2 ds, with u = 1 − 0.8 s
    const auto primitive = [](double s) {
        const double u = 1 - 0.8 * s;
        return u * std::log(u) - u;
    };
    return std::exp(2 / 0.8 * -(primitive(to) - primitive(from)));
}

TEST(RayCaster, TheMidpointRuleConvergesQuadraticallyToTheIntegral) {
    const double expected = 1 - rampThrough(0, 1);
    double before = 0;
    for (const double step : {0.4, 0.2, 0.1, 0.05}) {
        CompiledScene scene = sceneOf(rampBlock(), kFront, step);
        const double error = std::abs(castRays(scene, {1, 1}).at(0, 0).a - expected);
        EXPECT_LT(error, 0.05 * step * step + 1e-7);
        EXPECT_TRUE(step > 0.3 || step < 0.08 || before / error > 3.3) << step;
        before = error;
    }
}

TEST(RayCaster, PerspectivePutsAPointWhereItProjects) {
    // A small opaque ball about c, nothing else.
    const Vec3 c(0.5, -0.3, 0.6);
    TransferFunction f = constantLook(0, Vec3(1));
    f.opacity.points = {{0, 0}, {0, 1}};
    const auto ball = makeVolumeTerm(sampledVolume(81, [&](const Vec3& p) { return 0.08 - glm::length(p - c); }), 0, f);
    const Index2 size(120, 90);
    CompiledScene scene = sceneOf(ball, kOblique, 0.02);
    scene.opacityDistance = 0.01;
    const Picture picture = castRays(scene, size);
    Vec2 sum(0);
    double count = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (picture.at(x, y).a > 0.5f) {
                sum += Vec2(x + 0.5, y + 0.5);
                ++count;
            }
    const Vec3 expected = project(kOblique, size, c);
    EXPECT_NEAR(sum.x / count, expected.x, 0.3);
    EXPECT_NEAR(sum.y / count, expected.y, 0.3);
    const double radius = 0.08 / expected.z / std::tan(kOblique.fovY / 360 * kPi) * size.y / 2;
    EXPECT_NEAR(std::sqrt(count / kPi), radius, 0.3);
}

TEST(RayCaster, ShadesByTheGradientInTheHeadlight) {
    CompiledScene scene = sceneOf(rampBlock(), kFront, 0.05);
    const Picture unlit = castRays(scene, {1, 1});
    scene.render.shading = true;
    scene.render.ambient = 0.2;
    scene.render.diffuse = 0.5;
    scene.render.specular = 0.125;
    const Picture lit = castRays(scene, {1, 1});
    const double alpha = unlit.at(0, 0).a, behind = (1 - alpha) * 0.5;
    // The gradient runs along the ray: N·L = N·H = 1.
    EXPECT_NEAR(lit.at(0, 0).r, unlit.at(0, 0).r * 0.7 + 0.125 * alpha, 1e-6);
    EXPECT_NEAR(lit.at(0, 0).b - behind, (unlit.at(0, 0).b - behind) * 0.7 + 0.125 * alpha, 1e-6);
    scene.render.light = Vec3(2, 0, 0);  // across: only ambient, and the highlight of the half vector at 45°
    EXPECT_NEAR(castRays(scene, {1, 1}).at(0, 0).r, unlit.at(0, 0).r * 0.2 + 0.125 * alpha * std::pow(0.5, 10), 1e-6);
}

/// A ball in a mist, with empty space about: something to see from anywhere.
TermPtr ballInMist() {
    TransferFunction f = constantLook(0, Vec3(0));
    f.opacity.points = {{-0.3, 0}, {-0.1, 0.05}, {0, 0.1}, {0, 0.9}};
    f.color.points = {{-0.3, Vec3(0, 1, 0)}, {0.4, Vec3(1, 0, 0)}};
    return makeVolumeTerm(sampledVolume(40, [](const Vec3& p) { return 0.6 - glm::length(p); }), 0, f);
}

TEST(RayCaster, IsTheSameForEveryNumberOfThreadsAndInParts) {
    CompiledScene scene =
        sceneOf(makeTransferTerm(bentLattice(0.2, 8), ballInMist(), Combine::Union, ""), kOblique, 0.05);
    scene.render.shading = true;
    scene.opacityDistance = 0.1;
    const Index2 size(64, 48);
    setThreadCount(1);
    RayStatistics one, several, parts;
    const Picture expected = castRays(scene, size, &one);
    setThreadCount(3);
    EXPECT_EQ(castRays(scene, size, &several).pixels, expected.pixels);
    setThreadCount(0);
    Picture picture(size);
    castPixels(scene, picture, {0, 0}, {size.x, 17}, &parts);
    castPixels(scene, picture, {0, 17}, {13, 48}, &parts);
    castPixels(scene, picture, {13, 17}, size, &parts);
    EXPECT_EQ(picture.pixels, expected.pixels);
    EXPECT_EQ(one.samples, several.samples);
    EXPECT_EQ(one.samples, parts.samples);
    EXPECT_GT(one.samples, 0u);
}

/// One pixel by the definition: every sample of the ray, one at a time.
Vec4f plainPixel(const CompiledScene& scene, Index2 size, int x, int y) {
    const Vec3 direction = rayThrough(scene.camera, size, x, y);
    const Box3& box = scene.root->bounds;
    double near = 0, far = kInfinity;
    for (int a = 0; a < 3; ++a) {
        const double s = (box.min[a] - scene.camera.eye[a]) / direction[a];
        const double t = (box.max[a] - scene.camera.eye[a]) / direction[a];
        near = std::max(near, std::min(s, t));
        far = std::min(far, std::max(s, t));
    }
    const CutFinder cuts(scene);
    std::optional<CutFace> cut;
    bool seen = false;
    Vec3 color(0);
    double depth = 0;
    for (double from = near; from < far; from += scene.stepLength()) {
        const double to = std::min(from + scene.stepLength(), far);
        const double at = 0.5 * (from + to);
        const Vec3 p = scene.camera.eye + at * direction;
        ObjectSample s;
        sample(*scene.root, std::span(&p, 1), std::span(&s, 1), true);
        if (s.opacity > 0 && !seen) cut = cuts.before(scene.camera.eye, direction, at);
        seen = s.opacity > 0;
        if (seen && cut) s.normalGradient = cuts.blended(*cut, p, at, s.normalGradient);
        const double extinction = -std::log(1 - std::min(s.opacity, 0.9999)) / scene.opacityDistance * (to - from);
        color += std::exp(-depth) * (1 - std::exp(-extinction)) *
                 shade(scene.render, s.color, s.normalGradient, -direction, -direction);
        depth += extinction;
    }
    return Vec4f(color + std::exp(-depth) * scene.render.background, 1 - std::exp(-depth));
}

TEST(RayCaster, SkippingEmptySpaceAndBlocksChangeNoPixel) {
    const auto placed = [](const TermPtr& of) {
        return makeTransferTerm(
            std::make_shared<AffineMap>(placementMatrix({0.3, 0.2, 0.1}, {0.4, 0.3, -1}, {1, 1.5, 0.7})), of,
            Combine::Union, "", TransferRole::Place);
    };
    const auto lattice = [](double amount, const TermPtr& of) {
        return makeTransferTerm(bentLattice(amount, 8), of, Combine::Union, "");
    };
    for (const TermPtr& root : {ballInMist(), placed(ballInMist()), lattice(0.3, ballInMist()),
                                lattice(-2, ballInMist()), placed(lattice(0.3, placed(ballInMist())))}) {
        CompiledScene scene = sceneOf(root, kOblique, 0.03);
        scene.render.shading = true;
        scene.opacityDistance = 0.2;
        const Index2 size(32, 24);
        const Picture picture = castRays(scene, size);
        float most = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const Vec4f expected = plainPixel(scene, size, x, y);
                // The end of a ray that is nearly opaque is left out.
                for (int c = 0; c < 4; ++c) EXPECT_NEAR(picture.at(x, y)[c], expected[c], 2e-5) << x << " " << y;
                most = std::max(most, expected.a);
            }
        EXPECT_GT(most, 0.9f);
    }
}

TEST(RayCaster, AnUnmovedLatticeChangesNothing) {
    CompiledScene scene = sceneOf(ballInMist(), kOblique, 0.05);
    scene.render.shading = true;
    scene.opacityDistance = 0.1;
    const Picture bare = castRays(scene, {96, 72});
    scene.root = makeTransferTerm(bentLattice(0, 16), ballInMist(), Combine::Union, "");
    EXPECT_GT(psnr(castRays(scene, {96, 72}), bare), 80);
}

TEST(RayCaster, ASolidBlockUnderALatticeShowsNoGap) {
    const auto block = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(0.4, Vec3(1)));
    const auto map = bentLattice(0.2, 7);
    ASSERT_FALSE(map->cells()->mayOverlap());
    // From within the block every ray is inside up to the surface, so all of them gather what the first metre gives.
    const CompiledScene scene = sceneOf(makeTransferTerm(map, block, Combine::Union, ""),
                                        {Vec3(0.05, -0.1, 0.02), Vec3(1, 2, 0.5), Vec3(0, 0, 1), 120}, 0.01);
    const Index2 size(160, 120);
    const Picture picture = castRays(scene, size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Vec3 direction = rayThrough(scene.camera, size, x, y);
            // Where the ray leaves the deformed block, found by stepping finely over `locate`.
            CellLocation at{};
            double length = 0;
            while (map->cells()->locate(scene.camera.eye + (length + 0.005) * direction, at)) length += 0.01;
            EXPECT_NEAR(picture.at(x, y).a, 1 - std::pow(0.6, length), 0.012) << x << " " << y;
        }
}

TEST(RayCaster, CanBeCancelledAndTellsHowFarItIs) {
    const CompiledScene scene = sceneOf(ballInMist(), kFront, 0.1);
    Progress progress;
    castRays(scene, {8, 8}, nullptr, &progress);
    EXPECT_EQ(progress.fraction(), 1);
    progress.cancel();
    EXPECT_THROW(castRays(scene, {8, 8}, nullptr, &progress), Cancelled);
}

}  // namespace
}  // namespace voledit
