#include "render/slice_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/fields/simple_fields.h"
#include "core/stf/affine.h"
#include "render/slice_plan.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{160, 120};
const Box3 kUnitBox{Vec3(-1), Vec3(1)};

/// dB of the default step against rays of a sixteenth.
double closeness(const CompiledScene& scene, double stepScale = 1) {
    return psnr(slicesOf(scene, kSize, {}, stepScale), raysOf(scene, kSize, 16));
}

/// A scene without volumes: the step is that of the contract.
CompiledScene sceneWith(const TermPtr& root, double opacityDistance, bool shading = true) {
    CompiledScene scene = sceneOf(root, 1, shading);
    const Vec3 size = root->bounds.size();
    scene.unitStep = std::max({size.x, size.y, size.z}) / 256;
    scene.render.step = 0.5;
    scene.opacityDistance = opacityDistance;
    return scene;
}

TermPtr ball() {
    return solid(SphereShape{Vec3(0), 1}, {0.9, 0.5, 0.2}, 0, "select(r < 0.5, 1, 0.05)");
}
TermPtr block() {
    return solid(BoxShape{Vec3(-0.9, -0.6, -0.9), Vec3(0.9, 0.6, 0.9)}, {0.3, 0.6, 0.9}, 0, "0.95");
}

TermPtr waves() {
    return makeVolumeTerm(wavesVolume(32), 0, softAppearance());
}
CompiledScene volumeScene(const TermPtr& root) {
    return sceneOf(root, 2.0 / 31);
}

TEST(TermSlices, SolidsMatchRays) {
    EXPECT_GE(closeness(sceneWith(ball(), 0.05)), 40);
    EXPECT_GE(closeness(sceneWith(block(), 0.02)), 40);
    EXPECT_GE(closeness(sceneWith(through(library("twist", kUnitBox), block()), 0.02)), 40);
    EXPECT_GE(closeness(sceneWith(through(library("split", kUnitBox), ball()), 0.05)), 40);
    EXPECT_GE(closeness(sceneWith(makeCvgTerm(CvgOperator::Difference, {block(), ball()}), 0.02)), 40);
}

TEST(TermSlices, VolumesMatchRays) {
    const TermPtr plain = waves();
    const auto bent = bentLattice(plain->bounds);
    EXPECT_GE(closeness(volumeScene(through(library("twist", plain->bounds), plain))), 40);
    EXPECT_GE(closeness(volumeScene(through(library("open", plain->bounds), plain))), 40);
    EXPECT_GE(closeness(volumeScene(makeCvgTerm(CvgOperator::Union, {plain, ball()}))), 40);
    EXPECT_GE(closeness(volumeScene(through(library("twist", plain->bounds), through(bent, plain)))), 40);
}

TEST(TermSlices, OverlappingLatticesUnderADifferenceMatchRays) {
    const auto bent = bentLattice(kUnitBox);
    const TermPtr root = makeCvgTerm(CvgOperator::Difference, {through(bent, waves()), through(bent, ball())});
    EXPECT_GE(closeness(volumeScene(root)), 40);
}

TEST(TermSlices, ALatticeOverATermIsCutIntoItsCells) {
    // Outermost, its polygons carry the source coordinates; below an affine map too.
    const TermPtr operand = through(library("split", kUnitBox), makeCvgTerm(CvgOperator::Merge, {waves(), waves()}));
    const auto turn = std::make_shared<AffineMap>(placementMatrix({0.3, -0.2, 0.1}, {0.4, 0.9, -0.3}, {1.2, 0.7, -1}));
    const TermPtr bent = through(bentLattice(operand->bounds, Index3(16)), operand);
    EXPECT_TRUE(planTerm(bent).forward);
    EXPECT_TRUE(planTerm(through(turn, bent)).forward);
    EXPECT_GE(closeness(volumeScene(bent)), 40);
    EXPECT_GE(closeness(volumeScene(through(turn, bent))), 40);
    // Not where there are solids, nor where points have several pre-images, or one outside the cells.
    EXPECT_FALSE(planTerm(through(bentLattice(kUnitBox), block())).forward);
    EXPECT_FALSE(planTerm(through(foldedLattice(operand->bounds), operand)).forward);
}

TEST(TermSlices, TextUnderALatticeMatchesRays) {
    const TermPtr text = solid(TextShape{"Vol", 1, 0.4}, {0.9, 0.8, 0.3}, 0, "1");
    EXPECT_GE(closeness(sceneWith(through(bentLattice(text->bounds, Index3(16)), text), 0.01)), 40);
}

TEST(TermSlices, ConvergeToRaysAsTheStepFalls) {
    const CompiledScene scene = volumeScene(through(library("twist", kUnitBox), waves()));
    double before = 0;
    for (const double step : {2.0, 1.0, 0.5, 0.25}) {
        const double now = closeness(scene, step);
        EXPECT_GT(now, before) << step;
        before = now;
    }
    EXPECT_GE(before, 43);
}

TEST(TermSlices, CullingChangesNothingThatIsSeen) {
    const TermPtr root = through(library("split", kUnitBox), solid(SphereShape{Vec3(0), 0.6}, {1, 0, 0}, 0.05));
    const CompiledScene scene = sceneWith(makeCvgTerm(CvgOperator::Union, {root, ball()}), 0.05);
    offscreen();
    SliceRenderer culled, whole({.cull = false});
    const Picture a = renderSlices(culled, scene, kSize), b = renderSlices(whole, scene, kSize);
    EXPECT_GT(culled.statistics().culledCells, 100u);
    EXPECT_EQ(whole.statistics().culledCells, 0u);
    EXPECT_EQ(a.pixels, b.pixels);
}

TEST(TermSlices, DraggingNumbersCompilesNothing) {
    offscreen();
    SliceRenderer renderer;
    const auto draw = [&](double angle, double radius, double at, const Vec3& corner) {
        const TermPtr shape = solid(SphereShape{Vec3(at, 0, 0), radius}, Vec3(at), 0.01 * angle, "0.7");
        PiecewiseLinear table;
        table.points = {{at, 0}, {at + 1, radius}};
        const TermPtr both =
            makeCvgTerm(CvgOperator::Blend, {shape, makeRecolorTerm({"scalar", std::nullopt, table, waves()})},
                        std::make_shared<ConstantField>(at));
        Lattice lattice = bentLattice(kUnitBox)->lattice();
        lattice.control.front() += corner;
        const TermPtr moved = through(std::make_shared<LatticeMap>(lattice, Index3(6), Outside::Hide), both);
        const TermPtr root = through(library("twist", kUnitBox, {{"angle", number(angle)}}), moved);
        return renderSlices(renderer, sceneWith(root, 0.1), kSize);
    };
    const Picture first = draw(30, 0.5, 0.2, Vec3(0));
    draw(30, 0.5, 0.2, Vec3(0));  // masking is compiled behind the first slices
    const std::size_t compiled = renderer.statistics().programsCompiled;
    for (int n = 1; n < 4; ++n)
        EXPECT_NE(draw(30 + 20 * n, 0.5 + 0.1 * n, 0.2 + 0.1 * n, Vec3(0.05 * n)).pixels, first.pixels);
    EXPECT_EQ(renderer.statistics().programsCompiled, compiled);
}

TEST(TermSlices, NoNumberIsUndefined) {
    const TermPtr odd = makeFieldsTerm(
        {expression("sqrt(x) / (y - y)"), {expression("0/0"), expression("z"), expression("1/y")}, kUnitBox, {}});
    const CompiledScene scene = sceneWith(makeCvgTerm(CvgOperator::Union, {odd, block()}), 0.05);
    for (const Vec4f& p : slicesOf(scene, kSize).pixels) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z + p.a));
}

TEST(TermSlices, BothOpenGlsGiveTheSameBytes) {
    const CompiledScene scene =
        sceneWith(through(library("bend", kUnitBox), makeCvgTerm(CvgOperator::Cap, {ball(), block()})), 0.05);
    const Picture egl = slicesOf(scene, kSize);
    Picture osmesa;
    withContext(GlBackend::Osmesa, [&] {
        SliceRenderer renderer;
        osmesa = renderSlices(renderer, scene, kSize);
    });
    EXPECT_EQ(egl.pixels, osmesa.pixels);
}

}  // namespace
}  // namespace voledit
