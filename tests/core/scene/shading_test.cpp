#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/scene/camera.h"

namespace voledit {
namespace {

const RenderSettings kSettings{.ambient = 0.25, .diffuse = 0.5, .specular = 0.125, .shininess = 4, .light = {}};
const Vec3 kColor(0.8, 0.4, 0.2), kEye(0, 0, 1);

void expectColor(const Vec3& found, const Vec3& expected) {
    EXPECT_LT(glm::length(found - expected), 1e-14);
}

TEST(Shading, ASurfaceFacingEyeAndLightHasAllTerms) {
    expectColor(shade(kSettings, kColor, Vec3(0, 0, 3), kEye, kEye), kColor * 0.75 + 0.125);
}

TEST(Shading, IsTwoSided) {
    const Vec3 light = glm::normalize(Vec3(1, 2, 2));
    for (const Vec3& g : {Vec3(1, 0, 2), Vec3(0, -1, 1)})
        expectColor(shade(kSettings, kColor, g, kEye, light), shade(kSettings, kColor, -g, kEye, light));
}

TEST(Shading, FollowsTheFormula) {
    const Vec3 light(1, 0, 0), normal = glm::normalize(Vec3(1, 1, 1));
    const Vec3 half = glm::normalize(Vec3(1, 0, 1));
    const double diffuse = 1 / std::sqrt(3.0), highlight = std::pow(glm::dot(normal, half), 4);
    expectColor(shade(kSettings, kColor, Vec3(7), kEye, light), kColor * (0.25 + 0.5 * diffuse) + 0.125 * highlight);
}

TEST(Shading, WithoutGradientOrSwitchedOffIsUnlit) {
    EXPECT_EQ(shade(kSettings, kColor, Vec3(0), kEye, kEye), kColor);
    RenderSettings off = kSettings;
    off.shading = false;
    EXPECT_EQ(shade(off, kColor, Vec3(0, 0, 1), kEye, kEye), kColor);
}

TEST(Shading, SteepnessDoesNotMatterHoweverGreatOrSmall) {
    const Vec3 light = glm::normalize(Vec3(1, 2, 2)), gradient(1, -2, 0.5);
    const Vec3 expected = shade(kSettings, kColor, gradient, kEye, light);
    for (const double scale : {1e-300, 1e-20, 1e20, 1e200, 1e307})
        expectColor(shade(kSettings, kColor, scale * gradient, kEye, light), expected);
}

TEST(Shading, AGradientThatIsNoneIsUnlit) {
    for (const double none : {kNaN, kInfinity, -kInfinity})
        for (int a = 0; a < 3; ++a) {
            Vec3 gradient(1, 2, 3);
            gradient[a] = none;
            EXPECT_EQ(shade(kSettings, kColor, gradient, kEye, kEye), kColor);
        }
}

TEST(Shading, LightFromBehindMakesNoHighlight) {
    expectColor(shade(kSettings, kColor, Vec3(0, 0, 1), kEye, -kEye), kColor * 0.75);
}

}  // namespace
}  // namespace voledit
