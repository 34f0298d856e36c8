#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/stf/mesh_field.h"
#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

TEST(SolidTerm, IsItsOpacityInsideAndFadesOutside) {
    const SphereShape ball{{0.2, 0, -0.1}, 0.6};
    const auto hard = solid(ball, {1, 0.5, 0}, "0.7"), soft = solid(ball, {1, 0.5, 0}, "0.7", 0.3);
    const auto p = randomPoints(3000, 1.2);
    const auto ofHard = sampled(hard, p, true), ofSoft = sampled(soft, p, true);
    int faded = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double d = glm::distance(p[i], ball.center) - ball.radius;
        EXPECT_EQ(ofHard[i].opacity, d <= 0 ? 0.7 : 0);
        EXPECT_NEAR(ofSoft[i].opacity, 0.7 * std::clamp(1 - d / 0.3, 0.0, 1.0), 1e-12);
        faded += d > 0 && ofSoft[i].opacity > 0;
        EXPECT_TRUE(std::isnan(ofSoft[i].value));
        if (ofSoft[i].opacity == 0) continue;
        EXPECT_EQ(ofSoft[i].color, Vec3(1, 0.5, 0));
        EXPECT_LT(glm::distance(ofSoft[i].normalGradient, -glm::normalize(p[i] - ball.center)), 1e-9);
    }
    EXPECT_GT(faded, 100);
    EXPECT_EQ(hard->bounds, (Box3{ball.center - 0.6, ball.center + 0.6}));
    EXPECT_LT(glm::distance(soft->bounds.max, ball.center + 0.9), 1e-15);
}

TEST(SolidTerm, OpacityIsAFormulaOverPlaceRadiusAndDistance) {
    const BoxShape box{{-0.5, -0.5, -0.5}, {0.9, 0.7, 0.5}};
    const auto term = solid(box, Vec3(1), "0.1 + 0.2*x + 0.1*y*z + 0.3*r - d", 0.2);
    const Vec3 center = 0.5 * (box.min + box.max);
    const SolidDistance d = distanceOf(box, 0);
    const auto p = randomPoints(2000, 1.2);
    std::vector<double> distance(p.size());
    d.distance->sample(p, distance);
    const auto s = sampled(term, p);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double inner =
            0.1 + 0.2 * p[i].x + 0.1 * p[i].y * p[i].z + 0.3 * glm::distance(p[i], center) - distance[i];
        const double fade = std::clamp(1 - distance[i] / 0.2, 0.0, 1.0);
        EXPECT_NEAR(s[i].opacity, std::clamp(inner, 0.0, 1.0) * fade, 1e-12);
    }
}

TEST(SolidTerm, AnUndefinedOpacityIsEmpty) {
    const auto term = solid(SphereShape{{0, 0, 0}, 1}, Vec3(1), "x / (y - y)");
    for (const ObjectSample& s : sampled(term, randomPoints(200, 0.5), true)) EXPECT_EQ(s.opacity, 0);
    const auto nan = solid(SphereShape{{0, 0, 0}, 1}, Vec3(1), "sqrt(-1 - x*x)");
    for (const ObjectSample& s : sampled(nan, randomPoints(200, 0.5), true)) EXPECT_EQ(s.opacity, 0);
    EXPECT_EQ(sampled(term, {kUndefined})[0].opacity, 0);
}

TEST(SolidTerm, AnExpressionEndsAtItsBounds) {
    const auto half = [](double falloff) {
        return solid(DistanceShape{{"z", "", 1, 1}, {Vec3(-1), Vec3(1)}}, Vec3(1), "1", falloff);
    };
    EXPECT_EQ(sampled(half(0), {Vec3(0, 0, -0.9)})[0].opacity, 1);
    EXPECT_EQ(sampled(half(0), {Vec3(0, 0, -1.1)})[0].opacity, 0);
    EXPECT_EQ(sampled(half(0), {Vec3(1.01, 0, -0.5)})[0].opacity, 0);
    EXPECT_NEAR(sampled(half(0.5), {Vec3(1.2, 0, -0.5)})[0].opacity, 0.6, 1e-12) << "fades from its bounds on";
    EXPECT_NEAR(sampled(half(0.5), {Vec3(1.3, 1.4, -0.5)})[0].opacity, 0, 1e-12);
    EXPECT_NEAR(sampled(half(0.5), {Vec3(0.5, 0, 0.2)})[0].opacity, 0.6, 1e-12);
}

TEST(FieldsTerm, IsItsFieldsWithinItsBox) {
    const auto term = makeFieldsTerm({expression("0.5 + x"),
                                      {expression("y"), expression("0.25"), expression("3*z")},
                                      {Vec3(-0.8), Vec3(0.8)},
                                      {{"density", expression("x + 10*y")}}});
    const auto p = randomPoints(2000, 1);
    const auto s = sampled(term, p, true, "density");
    for (std::size_t i = 0; i < p.size(); ++i) {
        const bool inside = (Box3{Vec3(-0.8), Vec3(0.8)}).contains(p[i]);
        const double opacity = inside ? std::clamp(0.5 + p[i].x, 0.0, 1.0) : 0;
        EXPECT_EQ(s[i].opacity, opacity);
        EXPECT_EQ(std::isnan(s[i].value), !inside);
        if (inside) {
            EXPECT_EQ(s[i].value, p[i].x + 10 * p[i].y);
        }
        if (opacity == 0) continue;
        EXPECT_EQ(s[i].color, Vec3(std::clamp(p[i].y, 0.0, 1.0), 0.25, std::clamp(3 * p[i].z, 0.0, 1.0)));
        EXPECT_EQ(s[i].normalGradient, Vec3(1, 0, 0));
    }
    EXPECT_EQ(term->bounds, (Box3{Vec3(-0.8), Vec3(0.8)}));
    EXPECT_TRUE(std::isnan(sampled(term, {Vec3(0)})[0].value)) << "no scalar";
}

TEST(FieldsTerm, WhatIsUndefinedIsEmpty) {
    const auto opacity = fields("0.5 + sqrt(x)", Vec3(1));
    EXPECT_EQ(sampled(opacity, {Vec3(-0.1, 0, 0)}, true)[0].opacity, 0);
    EXPECT_EQ(sampled(opacity, {Vec3(0.04, 0, 0)}, true)[0].opacity, 0.7);
    const auto color = makeFieldsTerm(
        {expression("1"), {expression("sqrt(x)"), expression("1"), expression("1")}, {Vec3(-1), Vec3(1)}, {}});
    EXPECT_EQ(sampled(color, {Vec3(-0.1, 0, 0)}, true)[0].opacity, 0);
    EXPECT_EQ(sampled(color, {Vec3(0.25, 0, 0)}, true)[0].color.r, 0.5);
    EXPECT_EQ(sampled(color, {kUndefined}, true)[0].opacity, 0);
}

TEST(VolumeTerm, InterpolatesAsItIsTold) {
    const auto volume = sampledVolume(9, [](const Vec3& p) { return std::sin(3 * p.x) + p.y * p.z; });
    const auto p = randomPoints(500, 1);
    for (const Interpolation by : {Interpolation::Linear, Interpolation::Nearest, Interpolation::Cubic}) {
        TransferFunction look = constantLook(1, Vec3(1));
        const auto s = sampled(makeVolumeTerm(volume, 0, look, by), p, true);
        std::vector<double> value(p.size());
        std::vector<Vec3> gradient(p.size());
        volume->sample(p, value, 0, by);
        volume->gradient(p, gradient, 0, by);
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_EQ(s[i].value, value[i]);
            EXPECT_EQ(s[i].normalGradient, gradient[i]);
        }
    }
}

TEST(MeshTerm, IsClassifiedAsAVolumeIs) {
    MeshData data;
    for (int n = 0; n < 8; ++n) {
        data.points.push_back(Vec3(n & 1, n >> 1 & 1, n >> 2 & 1));
        data.values.push_back(float(2 * (n & 1) + 3 * (n >> 2 & 1)));
    }
    data.hexahedra.push_back({0, 1, 2, 3, 4, 5, 6, 7});
    TransferFunction look;
    look.opacity.points = {{0, 0}, {5, 1}};
    look.color.points = {{0, Vec3(0)}, {5, Vec3(1, 0, 0)}};
    const auto term = makeMeshTerm(std::make_shared<MeshField>(std::make_shared<Mesh>(data), 0), look);
    for (const Vec3& p : randomPoints(500, 1.2)) {
        const auto s = sampled(term, {p}, true)[0];
        if (!(Box3{Vec3(0), Vec3(1)}).contains(p)) {
            EXPECT_EQ(s.opacity, 0);
            EXPECT_TRUE(std::isnan(s.value));
            continue;
        }
        const double value = 2 * p.x + 3 * p.z;
        EXPECT_NEAR(s.value, value, 1e-6);
        EXPECT_NEAR(s.opacity, value / 5, 1e-6);
        EXPECT_NEAR(s.color.r, value / 5, 1e-6);
        EXPECT_LT(glm::distance(s.normalGradient, Vec3(2, 0, 3)), 1e-6);
    }
}

}  // namespace
}  // namespace voledit
