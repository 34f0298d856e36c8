#include "core/scene/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace voledit {
namespace {

const Camera kCamera{Vec3(3, -5, 2.5), Vec3(0.1, 0, -0.1), Vec3(0.1, 0, 1), 32};
const Vec3 kColor(0.8, 0.4, 0.2);

RenderSettings settingsOf(LightRig rig) {
    RenderSettings settings{.ambient = 0.25, .diffuse = 0.5, .specular = 0.125, .shininess = 4, .light = {}};
    settings.rig = rig;
    return settings;
}

TEST(Lighting, OneLightIsAsItWas) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    for (int n = 0; n < 50; ++n) {
        RenderSettings settings = settingsOf(LightRig::Headlight);
        const Vec3 gradient = vector(), toEye = glm::normalize(vector());
        EXPECT_LT(glm::distance(litColor(settings, lightsOf(settings, kCamera), kColor, gradient, toEye),
                                shade(settings, kColor, gradient, toEye, toEye)),
                  1e-12);
        settings.light = vector();
        EXPECT_LT(glm::distance(litColor(settings, lightsOf(settings, kCamera), kColor, gradient, toEye),
                                shade(settings, kColor, gradient, toEye, glm::normalize(*settings.light))),
                  1e-12);
    }
}

TEST(Lighting, RigsMoveWithTheCamera) {
    Camera other{Vec3(-4, 1, 7), Vec3(1, 1, 1), Vec3(0, 1, 0.3), 50};
    for (const LightRig rig : {LightRig::KeyFillRim, LightRig::Soft, LightRig::Dramatic}) {
        const RenderSettings settings = settingsOf(rig);
        const Lights here = lightsOf(settings, kCamera), there = lightsOf(settings, other);
        const CameraBasis a = basisOf(kCamera), b = basisOf(other);
        ASSERT_EQ(here.kind, Lights::Kind::Rig);
        for (std::size_t l = 0; l < here.count; ++l) {
            const Vec3 &x = here.light[l].toward, &y = there.light[l].toward;
            EXPECT_NEAR(glm::length(x), 1, 1e-12);
            EXPECT_NEAR(glm::dot(x, a.right), glm::dot(y, b.right), 1e-12);
            EXPECT_NEAR(glm::dot(x, a.up), glm::dot(y, b.up), 1e-12);
            EXPECT_NEAR(glm::dot(x, a.forward), glm::dot(y, b.forward), 1e-12);
        }
    }
}

TEST(Lighting, ARigLightsTheSideThatTheEyeSees) {
    const RenderSettings settings = settingsOf(LightRig::Dramatic);
    const Lights lights = lightsOf(settings, kCamera);
    const Vec3 toEye = -basisOf(kCamera).forward, gradient(0.2, -0.9, 0.4);
    // Whichever way the gradient points, and in the formula's own words.
    const Vec3 found = litColor(settings, lights, kColor, gradient, toEye);
    EXPECT_EQ(found, litColor(settings, lights, kColor, -gradient, toEye));
    const Vec3 normal = glm::normalize(gradient) * (glm::dot(gradient, toEye) < 0 ? -1.0 : 1.0);
    double diffuse = 0, highlight = 0;
    for (std::size_t l = 0; l < lights.count; ++l) {
        const double facing = glm::dot(normal, lights.light[l].toward);
        if (facing <= 0) continue;
        diffuse += lights.light[l].intensity * facing;
        highlight += lights.light[l].intensity *
                     std::pow(std::max(glm::dot(normal, glm::normalize(lights.light[l].toward + toEye)), 0.0), 4);
    }
    const Vec3 expected = kColor * (0.25 * lights.ambient + 0.5 * diffuse) + Vec3(0.125 * highlight);
    EXPECT_LT(glm::distance(found, expected), 1e-12);
}

TEST(Lighting, SharesTakeTheFirstLightAndTheAmbient) {
    const RenderSettings settings = settingsOf(LightRig::Headlight);
    const Lights lights = lightsOf(settings, kCamera);
    const Vec3 up(0, 0, 1);
    const Vec3 found = litColor(settings, lights, kColor, up, up, {.first = 0.5, .ambient = 0.25});
    EXPECT_LT(glm::distance(found, kColor * (0.25 * 0.25 + 0.5 * 0.5) + Vec3(0.5 * 0.125)), 1e-12);
    EXPECT_EQ(litColor(settings, lights, kColor, Vec3(0), up, {.first = 0, .ambient = 0}), kColor);  // unlit
}

}  // namespace
}  // namespace voledit
