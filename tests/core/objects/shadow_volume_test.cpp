#include "core/objects/shadow_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

/// What is left at a point of the grid, by steps of a twentieth of a cell.
float marched(const OpacityGrid& grid, const Vec3f& at, const Vec3f& toward) {
    constexpr float kStep = 0.05F;
    const float farthest = glm::length(Vec3f(grid.size()));
    double left = 1;
    for (float s = kStep / 2; s < farthest; s += kStep) {
        const Vec3f x = at + s * toward;
        bool inside = true;
        for (int a = 0; a < 3; ++a) inside = inside && x[a] > 0 && x[a] < float(grid.size()[a]);
        if (inside) left *= std::pow(1 - double(grid.alpha(x)), kStep);
    }
    return float(left);
}

/// Soft balls of several densities, so that there are no edges narrower than cells.
TermPtr balls() {
    const auto ball = [](const char* x, const char* y, const char* z, double radius, double most) {
        return std::to_string(most) + "*clamp((" + std::to_string(radius) + "-sqrt((x-" + x + ")^2+(y-" + y +
               ")^2+(z-" + z + ")^2))/0.25,0,1)";
    };
    return fields("max(" + ball("0.4", "0.1", "0.2", 0.5, 0.5) + ",max(" + ball("(-0.5)", "(-0.4)", "0.3", 0.4, 0.2) +
                      "," + ball("(-0.1)", "0.5", "(-0.5)", 0.45, 0.8) + "))",
                  Vec3(1));
}

TEST(ShadowVolume, IsWhatMarchesFindFromEveryDirection) {
    const OpacityGrid grid(*balls(), 2 / 40.0, 0.1);
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(-1, 0.9, 0.3),
                                  Vec3(0.3, -0.9, 1), Vec3(-0.2, -0.3, -1), Vec3(0.5, 1, -0.99), Vec3(-1, 0, 1)}) {
        const Vec3f toward(glm::normalize(direction));
        const ShadowVolume shadows(grid, toward);
        double sum = 0;
        int count = 0;
        const Index3 size = grid.size();
        for (int n = 0; n < 4000; ++n) {
            // Up to a cell and a half beyond.
            const Vec3f at =
                Vec3f(float(n * 29 % 997), float(n * 53 % 991), float(n * 71 % 983)) * (Vec3f(size) + 3.0F) / 1000.0F -
                1.5F;
            const float error = std::abs(shadows.at(at) - marched(grid, at, toward));
            EXPECT_LT(error, 0.07) << at.x << " " << at.y << " " << at.z << " of " << size.x << ", towards " << toward.x
                                   << " " << toward.y << " " << toward.z;
            sum += error;
            ++count;
        }
        EXPECT_LT(sum / count, 0.004);
    }
}

TEST(ShadowVolume, AThinWallLetsNothingThroughBesideIt) {
    // A wall of a cell and a half, lit from as flat as 20°: three cells behind it all is dark, before it all is light.
    const double h = 2 / 48.0;
    const OpacityGrid grid(*solid(BoxShape{Vec3(-0.9, -0.9, 0), Vec3(0.9, 0.9, 1.5 * h)}, Vec3(1), "0.9999"), h, h / 4);
    for (const double height : {0.35, 0.6, 1.0}) {
        const double aside = std::sqrt(1 - height * height);
        const ShadowVolume shadows(grid, Vec3f(0.8 * aside, 0.6 * aside, height));
        for (double x = -0.3; x < 0.3; x += 0.017)
            for (double y = -0.3; y < 0.3; y += 0.019) {
                EXPECT_LT(shadows.at(grid.gridFromWorld({x, y, -3 * h})), 0.01);
                EXPECT_GT(shadows.at(grid.gridFromWorld({x, y, 4.5 * h})), 0.99);
            }
    }
}

}  // namespace
}  // namespace voledit
