#include "core/eval/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/eval/ray_caster.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

using namespace test;

constexpr double kSpacing = 2 / 96.0;

/// A scene whose unit step is `kSpacing`, with all of its shadows and occlusion; lit from the eye, or from afar.
CompiledScene shadowed(const TermPtr& term, std::optional<Vec3> light = std::nullopt) {
    CompiledScene scene = sceneOf(term, {Vec3(0, -6, 0), Vec3(0), Vec3(0, 0, 1), 30}, 0.5);
    scene.unitStep = kSpacing;
    scene.opacityDistance = kSpacing;
    scene.render.shading = true;
    scene.render.shadows = 1;
    scene.render.occlusion = 1;
    scene.render.light = light;
    return scene;
}

/// All that is below the plane through the origin with `normal`, over two spacings from clear to opaque, as scans have
/// surfaces.
TermPtr halfSpace(const Vec3& normal) {
    const auto text = [](double v) { return "(" + std::to_string(v) + ")"; };
    const std::string distance = text(normal.x) + "*x+" + text(normal.y) + "*y+" + text(normal.z) + "*z";
    return fields("0.9*clamp(0.5-(" + distance + ")/" + std::to_string(2 * kSpacing) + ",0,1)", Vec3(1));
}

/// What comes through of light by the definition, in steps of a tenth of a spacing.
double throughTerm(const CompiledScene& scene, const Vec3& from, const Vec3& toward) {
    const double step = kSpacing / 10;
    std::vector<Vec3> p;
    for (double s = step / 2; s < 4; s += step) p.push_back(from + s * toward);
    double left = 1;
    for (const ObjectSample& s : sampled(scene.root, p))
        left *= std::pow(1 - std::min(s.opacity, 0.9999), step / scene.opacityDistance);
    return left;
}

TEST(Surroundings, AFlatSurfaceLosesNothingWhicheverWayItFaces) {
    for (const Vec3f& direction : opennessDirections()) {
        const Vec3 normal = glm::normalize(Vec3(direction) + Vec3(0.11, -0.07, 0.05));
        const TermPtr term = halfSpace(normal);
        const Surroundings fromEye(shadowed(term));
        const Vec3 along = glm::normalize(glm::cross(normal, Vec3(0.3, 0.5, 0.8)));
        for (const double height : {0.3, 0.7, 1.0}) {
            // Lit from as flat as 17°.
            const Vec3 toward = height * normal + std::sqrt(1 - height * height) * along;
            const Surroundings fromAfar(shadowed(term, toward));
            for (int n = 0; n < 20; ++n) {
                // At the depth that is seen, anywhere along the surface.
                const Vec3 p = 0.031 * n * along - 0.03 * n * glm::cross(along, normal) + 0.4 * kSpacing * normal;
                for (const Surroundings* around : {&fromEye, &fromAfar}) {
                    const LightShare share = around->at(p, toward);
                    EXPECT_GT(share.first, 0.98) << height;
                    EXPECT_GT(share.ambient, 0.98);
                }
            }
        }
    }
}

TEST(Surroundings, ShadowsAreThoseOfRaysThroughTheTermItself) {
    // A ball and a slab that lets half the light through, over a floor.
    const TermPtr things = makeCvgTerm(
        CvgOperator::Union, {solid(SphereShape{Vec3(-0.4, 0, 0), 0.3}, Vec3(1), "0.9"),
                             solid(BoxShape{Vec3(0.2, -0.5, 0), Vec3(0.8, 0.5, 4 * kSpacing)}, Vec3(1), "0.16"),
                             solid(BoxShape{Vec3(-1, -1, -1), Vec3(1, 1, -0.8)}, Vec3(1), "0.9")});
    const Vec3 toward = glm::normalize(Vec3(0.2, 0.1, 1));
    for (const bool afar : {false, true}) {
        const CompiledScene scene = shadowed(things, afar ? std::optional(toward) : std::nullopt);
        const Surroundings around(scene);
        double worst = 0, sum = 0;
        int count = 0;
        for (double x = -0.9; x < 0.9; x += 0.013)
            for (double y = -0.9; y < 0.9; y += 0.17) {
                const Vec3 p(x, y, -0.8 + 1e-3);
                const Vec3 seen = p + 2.5 * kSpacing * Vec3(0, 0, 1);
                const double exact = throughTerm(scene, seen, toward);
                const double error = std::abs(around.at(p, toward).first - exact);
                // A shadow's edge may lie half a spacing aside; light from afar is known from spacing to spacing.
                bool edge = false;
                for (const Vec3& aside : afar ? std::vector{Vec3(2, 0, 0), Vec3(0, 2, 0)} : std::vector{Vec3(1, 0, 0)})
                    edge = edge || std::abs(throughTerm(scene, seen + kSpacing * aside, toward) -
                                            throughTerm(scene, seen - kSpacing * aside, toward)) > 0.02;
                if (!edge) worst = std::max(worst, error);
                sum += error;
                ++count;
            }
        EXPECT_LT(worst, 0.06) << afar;
        EXPECT_LT(sum / count, 0.02) << afar;
    }
}

TEST(Surroundings, ACornerIsDarkerThanAWallAndAnEdgeIsNot) {
    const TermPtr corner = fields("0.9*clamp(0.5-min(x,z)/" + std::to_string(2 * kSpacing) + ",0,1)", Vec3(1));
    const CompiledScene scene = shadowed(corner);
    const Surroundings around(scene);
    const Vec3 up(0, 0, 1);
    double before = 0;
    for (const double x : {0.06, 0.1, 0.15, 0.2, 0.5}) {  // the first are three cells from the wall
        const double open = around.at({x, 0.1, 0}, up).ambient;
        EXPECT_GT(open, before) << x;  // ever lighter away from the wall
        before = open;
    }
    // Close to the wall half of the directions meet it, and count the less the farther that is.
    const double close = around.at({0.06, 0.1, 0}, up).ambient;
    EXPECT_GT(close, 0.5);
    EXPECT_LT(close, 0.8);
    EXPECT_GT(before, 0.98);
    const TermPtr edge = fields("0.9*clamp(0.5-max(x,z)/" + std::to_string(2 * kSpacing) + ",0,1)", Vec3(1));
    EXPECT_GT(Surroundings(shadowed(edge)).at({0, 0.1, 0}, up).ambient, 0.98);
}

TEST(Surroundings, AreNotPreparedWhereNobodyAsks) {
    CompiledScene scene = shadowed(halfSpace({0, 0, 1}));
    EXPECT_FALSE(Surroundings(scene).none());
    scene.render.shading = false;
    EXPECT_TRUE(Surroundings(scene).none());
    scene.render.shading = true;
    scene.render.shadows = scene.render.occlusion = 0;
    EXPECT_TRUE(Surroundings(scene).none());
}

TEST(Surroundings, APictureOfAFlatFloorIsAsLightWithShadowsAsWithout) {
    CompiledScene scene = shadowed(halfSpace(glm::normalize(Vec3(0.2, -0.8, 0.5))));
    scene.render.light = Vec3(-1, -1, 1);
    const Index2 size(24, 18);
    const Picture with = castRays(scene, size);
    scene.render.shadows = scene.render.occlusion = 0;
    const Picture without = castRays(scene, size);
    // The middle sees the surface, not the block's sides.
    for (int y = 6; y < 12; ++y)
        for (int x = 8; x < 16; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(with.at(x, y)[c], without.at(x, y)[c], 0.02);
}

}  // namespace
}  // namespace voledit
