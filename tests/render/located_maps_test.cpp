#include "render/located_maps.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/base/error.h"
#include "core/stf/affine.h"
#include "core/stf/cell_map.h"
#include "tests/render/render_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{160, 120};
constexpr double kUnit = 2.0 / 31;

TermPtr waves() {
    return makeVolumeTerm(wavesVolume(32), 0, softAppearance());
}
TermPtr through(TransferPtr map, const TermPtr& of) {
    return makeTransferTerm(std::move(map), of, Combine::Union, "");
}
TransferPtr turn() {
    return std::make_shared<AffineMap>(placementMatrix({0.3, -0.2, 0.1}, {0.4, 0.9, -0.3}, {1.2, 0.7, -1}));
}
/// A bent lattice about the middle of the volume only.
std::shared_ptr<const LatticeMap> innerLattice(Outside outside) {
    Lattice lattice = bentLattice({Vec3(-0.6), Vec3(0.7)})->lattice();
    return std::make_shared<LatticeMap>(lattice, Index3(8), outside);
}
/// Seen as the plain volume is: the bounds of terms are boxes of boxes, and what is within them would be small.
CompiledScene closeUp(TermPtr root, bool shading = true) {
    CompiledScene scene = sceneOf(waves(), kUnit, shading);
    scene.root = std::move(root);
    return scene;
}

double closeness(const CompiledScene& scene, double stepScale = 1) {
    const Picture rays = raysOf(scene, kSize);
    const auto covered =
        std::count_if(rays.pixels.begin(), rays.pixels.end(), [](const Vec4f& p) { return p.a > 0.1F; });
    EXPECT_GT(covered, kSize.x * kSize.y / 6) << "there is too little to compare";
    return psnr(slicesOf(scene, kSize, {}, stepScale), rays);
}

/// What located.glsl does, by the same arrays.
bool locate(const LocatedMaps& maps, Vec3f p, Vec3f& next) {
    for (const LocatedMaps::Map& map : maps.maps) {
        const Index3 size(map.grid[0], map.grid[1], map.grid[2]);
        const Index3 cell = glm::clamp(Index3(glm::floor(p)), Index3(0), size - 1);
        const auto start = std::size_t(map.grid[3] + cell.x + size.x * (cell.y + size.y * cell.z));
        bool found = false;
        for (std::size_t n = maps.cells[start]; n < maps.cells[start + 1] && !found; ++n) {
            const auto& t = maps.tetrahedra[maps.cells[n]];
            Vec4f w(0);
            for (int v = 0; v < 3; ++v) w[v + 1] = glm::dot(Vec3f(t.weight[std::size_t(v)]), p - Vec3f(t.origin));
            w[0] = 1 - w[1] - w[2] - w[3];
            found = w[0] >= -t.origin.w && w[1] >= -t.weight[0].w && w[2] >= -t.weight[1].w && w[3] >= -t.weight[2].w;
            if (!found) continue;
            next = Vec3f(0);
            for (int v = 0; v < 4; ++v) next += w[v] * maps.vertices[maps.corners[maps.cells[n]][std::size_t(v)]].next;
        }
        if (!found && map.keeps[0] == 0) return false;
        p = found ? next : Vec3f(map.nextFromThis * Vec4f(p, 1));
    }
    next = p;
    return true;
}

TEST(LocatedMaps, GiveTheIndexOfEveryPointAsTheMapsDo) {
    const TermPtr plain = waves();
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const TransferPtr inner = innerLattice(outside), affine = turn(), middle = bentLattice({Vec3(-2), Vec3(2)});
        const TermPtr root =
            through(restLattice({Vec3(-3), Vec3(3)}), through(middle, through(affine, through(inner, plain))));
        const SlicePlan plan = *planChain(root);
        ASSERT_EQ(plan.located.size(), 2u);
        const LocatedMaps maps = makeLocatedMaps(plan);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> coordinate(-2.2, 2.2);
        int within = 0;
        for (int n = 0; n < 20000; ++n) {
            const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
            Vec3 q = p;
            for (const TransferPtr& map : {middle, affine, inner}) map->map(std::span(&q, 1), std::span(&q, 1));
            Vec3f index;
            const bool found = locate(maps, Vec3f(transformPoint(maps.entryFromSource, p)), index);
            ASSERT_EQ(found, isDefined(q)) << p.x << " " << p.y << " " << p.z;
            if (!found) continue;
            ++within;
            const Vec3 expected = transformPoint(plan.indexFromSource, q);
            ASSERT_LT(glm::length(Vec3(index) - expected), 1e-3) << p.x << " " << p.y << " " << p.z;
        }
        EXPECT_GT(within, outside == Outside::Keep ? 5000 : 200);
    }
}

TEST(LocatedMaps, JacobiansAreTheDerivativeOfIndicesByGridCoordinates) {
    const TermPtr root =
        through(restLattice({Vec3(-3), Vec3(3)}), through(turn(), through(bentLattice({Vec3(-1), Vec3(1)}), waves())));
    const SlicePlan plan = *planChain(root);
    const LocatedMaps maps = makeLocatedMaps(plan);
    const MappedCells& cells = *plan.located[0].transfer->by->cells();
    // An affine map's columns through the grid: nextFromThis holds both scales.
    const Mat3 scale = Mat3(Mat4(maps.maps[0].nextFromThis));
    const Mat3 index(plan.indexFromSource);
    for (std::size_t v = 0; v < maps.vertices.size(); ++v) {
        const Mat3 expected = index * cells.jacobians()[v] * glm::inverse(index) * scale;
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(glm::length(Vec3(maps.vertices[v].jacobian[c]) - expected[c]),
                      1e-4 * glm::length(expected[c]) + 1e-5);
    }
}

TEST(LocatedSlices, LatticeOfALatticeMatchesRays) {
    const TermPtr inner = through(turn(), through(bentLattice(waves()->bounds), waves()));
    const TermPtr root = through(bentLattice({Vec3(-1.2), Vec3(1.4)}), inner);
    EXPECT_GE(closeness(closeUp(root, false)), 45);
    EXPECT_GE(closeness(closeUp(root, true)), 44);
}

TEST(LocatedSlices, LongChainsMatchRays) {
    TermPtr root = waves();
    const auto slight = std::make_shared<AffineMap>(placementMatrix({0.05, 0, -0.1}, {0.1, 0.4, 0}, {1.1, 1, 1.05}));
    for (int n = 0; n < 4; ++n) root = through(slight, through(bentLattice({Vec3(-1.3), Vec3(1.3)}), root));
    EXPECT_GE(closeness(closeUp(root)), 42);
    for (std::size_t n = 0; n < SlicePlan::kMostLocated; ++n) root = through(restLattice(root->bounds), root);
    EXPECT_FALSE(planChain(root)) << "longer ones take a generated program";
}

TEST(LocatedSlices, ConvergeToRaysAsTheStepFalls) {
    const TermPtr inner = through(bentLattice(waves()->bounds), waves());
    const CompiledScene scene = closeUp(through(bentLattice(inner->bounds), inner));
    const Picture exact = raysOf(scene, kSize, 16);
    const double coarse = psnr(slicesOf(scene, kSize, {}, 1), exact),
                 fine = psnr(slicesOf(scene, kSize, {}, 0.25), exact);
    EXPECT_GE(fine, coarse + 6) << coarse << " dB at the usual step, " << fine << " dB at a quarter of it";
}

TEST(LocatedSlices, UnmovedInnerLatticeChangesNothing) {
    const TermPtr plain = waves();
    const TransferPtr outer = bentLattice(plain->bounds);
    // Unlit, and both by slices: cut faces are lit under one map of cells, not under two.
    const CompiledScene without = closeUp(through(outer, plain), false);
    CompiledScene with = without;
    with.root = through(outer, through(restLattice(plain->bounds), plain));
    EXPECT_GE(psnr(slicesOf(with, kSize), slicesOf(without, kSize, {.march = false})), 50);
}

TEST(LocatedSlices, HideAndKeepMatchRays) {
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const TermPtr inner = through(innerLattice(outside), waves());
        const CompiledScene scene = closeUp(through(bentLattice({Vec3(-1), Vec3(1)}), inner));
        EXPECT_GE(closeness(scene), 40) << int(outside);
        EXPECT_GE(closeness(scene, 0.25), 44) << int(outside);
    }
}

TEST(LocatedSlices, FoldedAndKeepingOutermostMapsMatchRays) {
    const TermPtr inner = through(bentLattice(waves()->bounds), waves());
    for (const TransferPtr& outer :
         {TransferPtr(foldedLattice(inner->bounds)), TransferPtr(innerLattice(Outside::Keep))}) {
        const CompiledScene scene = closeUp(through(outer, inner));
        EXPECT_GE(closeness(scene, 0.25), 42);
    }
}

TEST(LocatedSlices, AmountsOfAMapMatchRays) {
    const TermPtr plain = waves();
    const auto half = scaledCells(*bentLattice(plain->bounds), 0.5);
    EXPECT_GE(closeness(closeUp(through(half, plain))), 44) << "outermost";
    const TermPtr inner = through(half, plain);
    EXPECT_GE(closeness(closeUp(through(bentLattice(inner->bounds), inner))), 42) << "below another";
}

TEST(LocatedSlices, GradientOpacityAndVoxelsThatAreNoNumbersMatchRays) {
    TransferFunction appearance = softAppearance();
    appearance.gradientOpacity.points = {{0, 0}, {1000, 0.2}, {3000, 1}};
    const auto volume = sampled(Index3(32), [](const Vec3& p) {
        return p.x > 0.4 && p.y > 0 ? kNaN : 500 + 500 * std::sin(5 * p.x + 1) * std::sin(4 * p.y + 2);
    });
    const TermPtr inner = through(bentLattice(waves()->bounds), makeVolumeTerm(volume, 0, appearance));
    const CompiledScene scene = closeUp(through(bentLattice(inner->bounds), inner));
    for (const Vec4f& p : slicesOf(scene, kSize).pixels) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z + p.a));
    EXPECT_GE(closeness(scene), 36);
}

TEST(LocatedSlices, CullingChangesNothing) {
    const TermPtr ball = makeVolumeTerm(ballVolume(96), 0, softAppearance());
    const TermPtr inner = through(bentLattice(ball->bounds), ball);
    const CompiledScene scene = sceneOf(through(bentLattice(inner->bounds), inner), 2.0 / 95);
    offscreen();
    SliceRenderer culled, whole({.cull = false});
    const Picture a = renderSlices(culled, scene, kSize), b = renderSlices(whole, scene, kSize);
    EXPECT_GT(culled.statistics().culledCells, whole.statistics().cells / 5);
    EXPECT_EQ(a.pixels, b.pixels);
}

TEST(LocatedSlices, WhatChangedIsDrawnAnew) {
    offscreen();
    SliceRenderer one;
    const auto bothWays = [&](const CompiledScene& scene) {
        EXPECT_EQ(renderSlices(one, scene, kSize).pixels, slicesOf(scene, kSize).pixels);
    };
    const TermPtr plain = waves();
    const TransferPtr outer = bentLattice(plain->bounds);
    const TermPtr bent = through(bentLattice(plain->bounds), plain);
    CompiledScene scene = closeUp(through(outer, bent));
    bothWays(scene);
    scene.root = through(outer, through(innerLattice(Outside::Hide), plain));
    bothWays(scene);
    scene.root = through(outer, through(turn(), bent));
    bothWays(scene);
    scene.root = through(outer, plain);
    bothWays(scene);
}

TEST(LocatedSlices, OsmesaAndEglDrawTheSamePictureToTheBit) {
    const TermPtr inner = through(bentLattice(waves()->bounds), waves());
    const CompiledScene scene = closeUp(through(bentLattice(inner->bounds), inner));
    const Picture egl = slicesOf(scene, kSize);
    Picture osmesa;
    withContext(GlBackend::Osmesa, [&] {
        SliceRenderer renderer;
        osmesa = renderSlices(renderer, scene, kSize);
    });
    EXPECT_EQ(egl.pixels, osmesa.pixels);
}

TEST(LocatedSlices, AFoldedMapBelowAnotherMatchesRays) {
    const TermPtr inner = makeTransferTerm(foldedLattice(waves()->bounds), waves(), Combine::Union, "crumple");
    const TermPtr root = through(bentLattice(inner->bounds), inner);
    EXPECT_FALSE(planChain(root));
    EXPECT_GE(closeness(closeUp(root)), 40);
}

}  // namespace
}  // namespace voledit
