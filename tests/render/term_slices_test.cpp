#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "core/fields/simple_fields.h"
#include "render/slice_renderer.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{160, 120};
const Box3 kUnitBox{Vec3(-1), Vec3(1)};

double milliseconds(const std::function<void()>& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// dB of the default step against rays of a sixteenth.
double closeness(const CompiledScene& scene, Index2 size = kSize) {
    offscreen();
    SliceRenderer renderer;
    Picture first, slices;
    const double cold = milliseconds([&] { first = renderSlices(renderer, scene, size); });
    const double warm = milliseconds([&] { slices = renderSlices(renderer, scene, size); });
    const Picture rays = raysOf(scene, size, 16);
    if (const char* folder = std::getenv("VOLEDIT_TEST_PICTURES")) {
        const std::string name =
            std::string(folder) + "/" + testing::UnitTest::GetInstance()->current_test_info()->name();
        (void)name;
    }
    const double db = psnr(slices, rays);
    printf("    %.1f dB, first %.0f ms, then %.0f ms, %zu cells of %zu\n", db, cold, warm, renderer.statistics().cells,
           renderer.statistics().cells + renderer.statistics().culledCells);
    return db;
}

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

TEST(TermSlices, SolidsMatchRays) {
    EXPECT_GE(closeness(sceneWith(ball(), 0.05)), 40);
    EXPECT_GE(closeness(sceneWith(block(), 0.02)), 40);
    EXPECT_GE(closeness(sceneWith(through(library("twist", kUnitBox), block()), 0.02)), 40);
    EXPECT_GE(closeness(sceneWith(through(library("split", kUnitBox), ball()), 0.05)), 40);
    EXPECT_GE(closeness(sceneWith(makeCvgTerm(CvgOperator::Difference, {block(), ball()}), 0.02)), 40);
}

TEST(TermSlices, VolumesMatchRays) {
    const TermPtr plain = makeVolumeTerm(wavesVolume(32), 0, softAppearance());
    const auto scene = [&](const TermPtr& root) {
        CompiledScene made = sceneOf(root, 2.0 / 31);
        return made;
    };
    EXPECT_GE(closeness(scene(through(library("twist", plain->bounds), plain))), 40);
    EXPECT_GE(closeness(scene(through(library("open", plain->bounds), plain))), 40);
    EXPECT_GE(closeness(scene(makeCvgTerm(CvgOperator::Union, {plain, ball()}))), 40);
    const auto bent = bentLattice(plain->bounds);
    EXPECT_GE(closeness(scene(through(library("twist", plain->bounds), through(bent, plain)))), 40);
    EXPECT_GE(closeness(scene(makeCvgTerm(CvgOperator::Difference, {through(bent, plain), through(bent, ball())}))),
              40);
}

}  // namespace
}  // namespace voledit
