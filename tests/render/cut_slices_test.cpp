// Cut faces by slices against rays.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/base/picture.h"
#include "core/rays/ray_renderer.h"
#include "core/stf/affine.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{64, 48};

/// Opaque noise: its gradients point anywhere.
TermPtr noise() {
    const auto volume = sampled(
        Index3(40), [](const Vec3& p) { return 500 + 400 * std::sin(913 * p.x + 677 * p.y * p.y + 541 * p.z); });
    return makeVolumeTerm(volume, 0, constantAppearance(0.9999, Vec3(1)));
}

/// The normal that the pixel in which `p` is seen is lit by, but for signs: three lights along the axes, diffuse alone.
Vec3 normalSeen(CompiledScene scene, const Vec3& p, bool slices) {
    scene.render.ambient = scene.render.specular = 0;
    scene.render.diffuse = 1;
    const Vec3 pixel = project(scene.camera, kSize, p);
    Vec3 normal(0);
    for (int a = 0; a < 3; ++a) {
        Vec3 light(0);
        light[a] = 1;
        scene.render.light = light;
        const Picture picture = slices ? slicesOf(scene, kSize) : raysOf(scene, kSize, 1);
        normal[a] = picture.at(int(pixel.x), int(pixel.y)).g;
    }
    return glm::normalize(normal);
}

double degreesBetween(const Vec3& a, const Vec3& b) {
    return glm::degrees(std::acos(std::min(glm::dot(a, glm::abs(b)), 1.0)));
}

/// The same rays as raysOf, in packets.
Picture packetsOf(CompiledScene scene, Index2 size, double finer) {
    scene.render.step /= finer;
    RayRenderer renderer;
    renderer.begin(scene, size);
    renderer.advance(0);
    return renderer.picture();
}

TEST(CutFacesOfSlices, HaveTheNormalOfTheCut) {
    const Box3 box{Vec3(-1), Vec3(1)};
    const TermPtr split = through(library("split", box, {{"axis", axis(0)}, {"gap", number(0.4)}}), noise());
    CompiledScene scene = sceneOf(split, 2 / 39.0);
    scene.camera.eye = Vec3(4, -4.5, 1.5);
    for (const bool slices : {false, true}) {
        // The split's own face, at x = −0.4, seen through the gap; the box's faces; those that a solid leaves.
        EXPECT_LT(degreesBetween(normalSeen(scene, {-0.4, -0.85, 0.2}, slices), {1, 0, 0}), 1) << slices;
        EXPECT_LT(degreesBetween(normalSeen(scene, {-0.8, -1, 0.3}, slices), {0, 1, 0}), 1) << slices;
        CompiledScene whole = scene;
        whole.root = noise();
        EXPECT_LT(degreesBetween(normalSeen(whole, {0.3, -1, 0.2}, slices), {0, 1, 0}), 1) << slices;
        // A knife that is turned by 30° leaves what is beyond half a unit from the middle.
        const Vec3 normal(-0.5, std::sqrt(0.75), 0);
        const auto turn =
            std::make_shared<AffineMap>(placementMatrix(Vec3(0), Vec3(0, 0, glm::radians(30.0)), Vec3(1)));
        const TermPtr knife = through(turn, solid(BoxShape{Vec3(-9), Vec3(9, -0.5, 9)}, Vec3(1), 0, "1"));
        CompiledScene trimmed = scene;
        trimmed.root = makeCvgTerm(CvgOperator::Difference, {noise(), knife});
        EXPECT_LT(degreesBetween(normalSeen(trimmed, -0.5 * normal + Vec3(0, 0, 0.2), slices), normal), 1) << slices;
    }
}

TEST(CutFacesOfSlices, AreThoseOfRays) {
    const Box3 box{Vec3(-1), Vec3(1)};
    const std::vector<std::pair<const char*, TermPtr>> terms{
        {"box", noise()},
        {"lattice", through(bentLattice(box), noise())},
        {"split", through(library("split", box, {{"gap", number(0.4)}}), noise())},
        {"open", through(library("open", box), noise())},
        {"dissect", through(library("dissect", box), noise())}};
    for (const auto& [name, term] : terms) {
        CompiledScene scene = sceneOf(term, 2 / 39.0);
        // Outlines, where rays pass less than a slab, are not what is compared.
        scene.render.background = Vec3(0.6);
        // Noise that is lit by its own gradients differs by more than 20 dB.
        EXPECT_GT(psnr(slicesOf(scene, kSize), raysOf(scene, kSize, 2)), 30) << name;
    }
}

/// A lattice over a frame, bent.
TransferPtr bentOver(const Frame& frame, Outside outside = Outside::Hide) {
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) lattice.control[lattice.indexOf({3, j, k})] += Vec3(0.2, 0.05 * k * k, 0.1 * j);
    return std::make_shared<LatticeMap>(lattice, Index3(12), outside);
}

void expectAsRays(const char* name, const TermPtr& term) {
    CompiledScene scene = sceneOf(term, 2 / 39.0);
    scene.render.background = Vec3(0.6);
    const Picture rays = raysOf(scene, kSize, 2);
    for (const bool march : {true, false})
        EXPECT_GT(psnr(slicesOf(scene, kSize, {.march = march}), rays), 30) << name << " " << march;
    // Packets are lit as the reference.
    EXPECT_GT(psnr(rays, packetsOf(scene, kSize, 2)), 36) << name;
}

// A lattice's frame is smaller than the volume: its bent boundary is what is seen.
TEST(CutFacesOfSlices, OfAFrameWithinTheVolumeAreThoseOfRays) {
    expectAsRays("half", through(bentOver(frameOf({Vec3(-2), Vec3(0.3, 2, 2)})), noise()));
    expectAsRays("inner", through(bentOver(frameOf({Vec3(-0.6), Vec3(0.5, 0.7, 0.8)})), noise()));
    Frame turned{Vec3(-0.2, -0.9, -0.7), {Vec3(1, 0.4, 0.1), Vec3(-0.6, 1, 0), Vec3(0, 0.2, 1.3)}};
    expectAsRays("turned", through(bentOver(turned), noise()));
}

TEST(CutFacesOfSlices, UnderChainsOfLatticesAreThoseOfRays) {
    const Box3 box{Vec3(-1), Vec3(1)};
    const TransferPtr half = bentOver(frameOf({Vec3(-2), Vec3(0.3, 2, 2)}));
    const TransferPtr wide = bentOver(frameOf({Vec3(-1.5), Vec3(1.5)}));
    const TransferPtr split = library("split", box, {{"axis", axis(1)}, {"gap", number(0.4)}});
    expectAsRays("faces", through(wide, through(wide, noise())));
    expectAsRays("half below", through(wide, through(half, noise())));
    expectAsRays("half above", through(half, through(wide, noise())));
    expectAsRays("split above", through(split, through(wide, noise())));
    expectAsRays("split below", through(wide, through(split, noise())));
    expectAsRays("split between", through(half, through(split, through(wide, noise()))));
}

}  // namespace
}  // namespace voledit
