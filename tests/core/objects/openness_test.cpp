#include "core/objects/openness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

constexpr float kLift = 1.5F;  // as eval/surroundings has it

/// The openness of a point, by definition.
float opennessOf(const OpacityGrid& grid, const Vec3f& at, const Vec3f& outward, float radius) {
    const auto stretches = opennessStretches(radius);
    const float clear = glm::length(outward);
    float open = 0, weights = 0;
    for (const Vec3f& direction : opennessDirections()) {
        const float weight = glm::dot(direction, outward) - kFlattestOpenness * clear + (1 - clear);
        if (!(weight > 0)) continue;
        float left = 1, taken = 0;
        for (const OpennessStretch& stretch : stretches) {
            const float alpha = grid.alpha(at + stretch.middle * direction, stretch.level);
            const float next = left * std::pow(1 - alpha, stretch.length);
            taken += (left - next) * stretch.counts;
            left = next;
        }
        open += weight * (1 - taken);
        weights += weight;
    }
    return weights > 0 ? open / weights : 1;
}

TEST(Openness, NodesHoldItByDefinition) {
    const OpacityGrid grid(*solid(SphereShape{Vec3(0.1, 0, -0.2), 0.6}, Vec3(1), "0.2 + 0.2 * sin(9 * x) * cos(8 * y)"),
                           0.03, 0.1);
    const float radius = 14;
    const Openness openness(grid, radius);
    EXPECT_EQ(openness.size(), grid.level(1).size);
    const Index3 size = openness.size();
    int known = 0;
    for (int n = 0; n < size.x * size.y * size.z; ++n) {
        const Index3 node(n % size.x, n / size.x % size.y, n / size.x / size.y);
        const float weight = float(openness.nodes()[2 * std::size_t(n) + 1]);
        if (weight < 4000) continue;
        const Vec3f at = 2.0F * Vec3f(node) + 1.0F;
        if (grid.alpha(at, 1) > 0) continue;  // stands for what is before it
        EXPECT_NEAR(float(openness.nodes()[2 * std::size_t(n)]) / weight,
                    std::min(1.02F * opennessOf(grid, at, opennessSide(grid, at), radius), 1.0F), 1e-3);
        ++known;
    }
    EXPECT_GT(known, 1000);
}

TEST(Openness, BetweenNodesItIsNearlyThatOfSurfaces) {
    const double h = 2 / 96.0;
    // Walls with soft faces, as scans have them: a cup of thin walls, a ball before it, waves below.
    const std::string soft = "/" + std::to_string(2 * h) + ",0,1)";
    const TermPtr term = fields("0.9*clamp(0.5-min(min(abs(sqrt(x^2+y^2+(z-0.2)^2)-0.55)-" + std::to_string(h) +
                                    ",sqrt((x-0.1)^2+(y+0.8)^2+(z-0.1)^2)-0.15),z+0.6+0.06*sin(12*x)*cos(9*y))" + soft,
                                Vec3(1));
    const OpacityGrid grid(*term, h, h);
    const float radius = float(0.1 * glm::length(Vec3(2)) / h);
    const Openness openness(grid, radius);
    double sum = 0, far = 0;
    int count = 0;
    const Vec3f size(grid.size());
    for (int n = 0; n < 60000; ++n) {
        const Vec3f at = Vec3f(float(n * 29 % 997), float(n * 53 % 991), float(n * 71 % 983)) * size / 1000.0F;
        const float alpha = grid.alpha(at);
        if (!(alpha > 0.1F && alpha < 0.6F)) continue;
        const Vec3f side = outwardOf(grid, at), lifted = at + kLift * side;
        const double error = std::abs(openness.at(lifted) - opennessOf(grid, lifted, side, radius));
        far += error > 0.1;
        sum += error;
        ++count;
    }
    ASSERT_GT(count, 2000);
    EXPECT_LT(sum / count, 0.02);
    EXPECT_LT(far / count, 0.05);
}

TEST(Openness, WallsOfACellDoNotLeak) {
    // Within a closed box it is dark, and outside not, however near the wall.
    const double h = 2 / 64.0;
    for (const double thick : {1.0, 1.5, 2.0}) {
        const auto text = [](double v) { return std::to_string(v); };
        const TermPtr box = fields("0.999*clamp(0.5-(abs(max(max(abs(x),abs(y)),abs(z))-0.4)-" + text(thick * h / 2) +
                                       ")/" + text(h) + ",0,1)",
                                   Vec3(1));
        const OpacityGrid grid(*box, h, h / 4);
        const Openness openness(grid, 24);
        for (double x = -0.25; x < 0.25; x += 0.013)
            for (double y = -0.25; y < 0.25; y += 0.017)
                for (const double side : {-0.5, 0.5}) {
                    const Vec3f p = grid.gridFromWorld({x, y, 0.4 + side * thick * h});
                    const Vec3f outward = outwardOf(grid, p), lifted = p + kLift * outward;
                    EXPECT_NEAR(openness.at(lifted), opennessOf(grid, lifted, outward, 24), 0.15) << side << thick;
                    EXPECT_LT(openness.at(lifted), side < 0 ? 0.9 : 1.01);
                }
    }
}

}  // namespace
}  // namespace voledit
