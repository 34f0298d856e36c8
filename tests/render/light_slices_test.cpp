// Lights, shadows and occlusion by slices against rays.

#include "core/base/picture.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{96, 72};

/// A ball over a table, in one volume.
TermPtr ballOnTable() {
    const auto volume = sampled(Index3(48), [](const Vec3& p) {
        const double ball = 0.4 - glm::length(p - Vec3(0, 0, 0.15));
        const double table = std::min(-0.35 - p.z, 0.8 - std::max(std::abs(p.x), std::abs(p.y)));
        return 500 + 8000 * std::max(ball, table);
    });
    return makeVolumeTerm(volume, 0, softAppearance());
}

struct Kind {
    const char* name;
    TermPtr term;
};

/// One of each way in which slices are drawn: bricks, cells, located maps, folds, programs with and without cells.
std::vector<Kind> kinds() {
    const TermPtr plain = ballOnTable();
    const Box3 box = plain->bounds;
    return {{"bricks", plain},
            {"cells", through(bentLattice(box), plain)},
            {"located", through(bentLattice(box), through(bentLattice(box), plain))},
            {"folds", through(foldedLattice(box), plain)},
            {"formulas", through(library("twist", box, {{"angle", number(0.6)}}), plain)},
            {"union",
             makeCvgTerm(CvgOperator::Union,
                         {plain, solid(BoxShape{Vec3(0.5, -0.9, -0.9), Vec3(0.7, -0.2, 0.5)}, Vec3(0.3, 0.5, 0.9))})}};
}

// 46 dB is what slices reach against rays on scans at the usual step (render/README.md); the marches are the same but
// for single precision, so light must not be what limits them.
TEST(LightOfSlices, IsThatOfRays) {
    for (const Kind& kind : kinds()) {
        CompiledScene scene = sceneOf(kind.term, 2 / 47.0);
        scene.render.rig = LightRig::KeyFillRim;
        EXPECT_GT(psnr(slicesOf(scene, kSize), raysOf(scene, kSize, 4)), 46) << kind.name << ", rig";
        scene.render.shadows = 1;
        scene.render.occlusion = 1;
        EXPECT_GT(psnr(slicesOf(scene, kSize), raysOf(scene, kSize, 4)), 46) << kind.name << ", surroundings";
    }
}

TEST(LightOfSlices, ShadowsFallOnTheTableAndNowhereElse) {
    CompiledScene scene = sceneOf(ballOnTable(), 2 / 47.0);
    scene.render.light = Vec3(0, 0, 1);
    const Picture bright = slicesOf(scene, kSize);
    scene.render.shadows = 1;
    const Picture shadowed = slicesOf(scene, kSize);
    const auto ratioAt = [&](const Vec3& p) {
        const Vec3 pixel = project(scene.camera, kSize, p);
        return shadowed.at(int(pixel.x), int(pixel.y)).g / bright.at(int(pixel.x), int(pixel.y)).g;
    };
    EXPECT_LT(ratioAt({0.2, -0.2, -0.35}), 0.6);  // beneath the ball, where it is seen
    // The open table and the ball's top: the light passes what is soft on its way to what is seen, no more.
    EXPECT_GT(ratioAt({0.65, -0.65, -0.35}), 0.92);
    EXPECT_GT(ratioAt({0.05, -0.1, 0.53}), 0.92);
}

TEST(LightOfSlices, TexturesFollowTheScene) {
    offscreen();
    SliceRenderer renderer;
    CompiledScene scene = sceneOf(ballOnTable(), 2 / 47.0);
    scene.render.shadows = scene.render.occlusion = 1;
    scene.render.rig = LightRig::Dramatic;
    const Picture first = renderSlices(renderer, scene, kSize);
    CompiledScene other = scene;
    other.root = through(bentLattice(scene.root->bounds), scene.root);
    renderSlices(renderer, other, kSize);
    EXPECT_EQ(renderSlices(renderer, scene, kSize).pixels, first.pixels);
    CompiledScene none = scene;
    none.render.shadows = none.render.occlusion = 0;
    EXPECT_NE(renderSlices(renderer, none, kSize).pixels, first.pixels);
}

}  // namespace
}  // namespace voledit
