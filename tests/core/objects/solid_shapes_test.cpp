#include "core/objects/solid_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/error.h"
#include "core/fields/simple_fields.h"

namespace voledit {
namespace {

double distanceAt(const SolidDistance& solid, const Vec3& p) {
    double d = 0;
    solid.distance->sample(std::span(&p, 1), std::span(&d, 1));
    return d;
}

Vec3 gradientAt(const SolidDistance& solid, const Vec3& p) {
    Vec3 g;
    solid.distance->gradient(std::span(&p, 1), std::span(&g, 1));
    return g;
}

Vec3 randomIn(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> unit(-size, size);
    const double x = unit(random), y = unit(random), z = unit(random);
    return {x, y, z};
}

/// A shape with points of its surface, dense, and whether a point is inside, both found without its formula.
struct Case {
    std::string name;
    SolidShape shape;
    std::vector<Vec3> surface;
    double density;  // no point of the surface is farther than this from one of `surface`
    std::function<bool(const Vec3&)> inside;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

/// A surface over [0, 1]², n × n points.
std::vector<Vec3> patch(int n, const std::function<Vec3(double, double)>& at) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) points.push_back(at(double(i) / n, double(j) / n));
    return points;
}

/// Two directions across `axis`.
std::pair<Vec3, Vec3> across(const Vec3& axis) {
    const Vec3 u = glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
    return {u, glm::cross(axis, u)};
}

std::vector<Vec3> operator+(std::vector<Vec3> a, const std::vector<Vec3>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

constexpr int kFine = 120;

Case sphereCase() {
    const SphereShape s{{0.3, -0.2, 0.1}, 0.8};
    return {"sphere", s,
            patch(kFine,
                  [&](double a, double b) {
                      const double theta = kPi * a, phi = 2 * kPi * b;
                      return s.center + s.radius * Vec3(std::sin(theta) * std::cos(phi),
                                                        std::sin(theta) * std::sin(phi), std::cos(theta));
                  }),
            0.05, [=](const Vec3& p) { return glm::distance(p, s.center) < s.radius; }};
}

Case boxCase() {
    const BoxShape s{{-0.7, -0.3, 0.1}, {0.4, 0.9, 0.6}};
    std::vector<Vec3> surface;
    for (int a = 0; a < 3; ++a)
        for (const bool high : {false, true})
            surface = surface + patch(kFine, [&](double i, double j) {
                          Vec3 u;
                          u[a] = high;
                          u[(a + 1) % 3] = i;
                          u[(a + 2) % 3] = j;
                          return s.min + u * (s.max - s.min);
                      });
    return {"box", s, surface, 0.02,
            [=](const Vec3& p) { return glm::all(glm::greaterThan(p, s.min)) && glm::all(glm::lessThan(p, s.max)); }};
}

Case cylinderCase() {
    const CylinderShape s{{-0.5, 0.2, -0.3}, {0.6, -0.1, 0.4}, 0.5};
    const double length = glm::distance(s.from, s.to);
    const Vec3 axis = (s.to - s.from) / length;
    const auto [u, v] = across(axis);
    const auto round = [u = u, v = v](double r, double b) {
        return r * (std::cos(2 * kPi * b) * u + std::sin(2 * kPi * b) * v);
    };
    return {"cylinder", s,
            patch(kFine, [&](double a, double b) { return s.from + a * length * axis + round(s.radius, b); }) +
                patch(kFine, [&](double a, double b) { return s.from + round(a * s.radius, b); }) +
                patch(kFine, [&](double a, double b) { return s.to + round(a * s.radius, b); }),
            0.03, [=](const Vec3& p) {
                const double t = glm::dot(p - s.from, axis);
                return t > 0 && t < length && glm::length(p - s.from - t * axis) < s.radius;
            }};
}

Case capsuleCase() {
    const CapsuleShape s{{-0.5, 0.2, -0.3}, {0.6, -0.1, 0.4}, 0.4};
    const double length = glm::distance(s.from, s.to);
    const Vec3 axis = (s.to - s.from) / length;
    const auto [u, v] = across(axis);
    const auto round = [u = u, v = v](double r, double b) {
        return r * (std::cos(2 * kPi * b) * u + std::sin(2 * kPi * b) * v);
    };
    const auto cap = [&](const Vec3& end, double side) {
        return patch(kFine, [&](double a, double b) {
            return end + side * s.radius * std::sin(kPi / 2 * a) * axis + round(s.radius * std::cos(kPi / 2 * a), b);
        });
    };
    return {"capsule", s,
            patch(kFine, [&](double a, double b) { return s.from + a * length * axis + round(s.radius, b); }) +
                cap(s.from, -1) + cap(s.to, 1),
            0.03, [=](const Vec3& p) {
                const double t = std::clamp(glm::dot(p - s.from, axis), 0.0, length);
                return glm::length(p - s.from - t * axis) < s.radius;
            }};
}

Case torusCase(const char* name, double major, double minor) {
    const TorusShape s{{0.1, 0.2, -0.1}, {1, 2, -2}, major, minor};
    const Vec3 axis = glm::normalize(s.axis);
    const auto [u, v] = across(axis);
    std::vector<Vec3> surface;
    for (const Vec3& x : patch(3 * kFine, [&](double a, double b) {
             // Only what a torus that overlaps itself shows: the part beyond the axis.
             return Vec3(major + minor * std::cos(2 * kPi * a), minor * std::sin(2 * kPi * a), b);
         }))
        if (x.x >= 0)
            surface.push_back(s.center + x.x * (std::cos(2 * kPi * x.z) * u + std::sin(2 * kPi * x.z) * v) +
                              x.y * axis);
    return {name, s, surface, 0.03, [=](const Vec3& p) {
                const double along = glm::dot(p - s.center, axis);
                const double ring = glm::length(p - s.center - along * axis) - major;
                return ring * ring + along * along < minor * minor;
            }};
}

class Shape : public testing::TestWithParam<Case> {};

TEST_P(Shape, HasTheSignedDistanceToItsSurface) {
    const Case& c = GetParam();
    const SolidDistance solid = distanceOf(c.shape, 0);
    std::mt19937 random(1);
    int inside = 0;
    for (int n = 0; n < 400; ++n) {
        const Vec3 p = randomIn(random, n % 2 ? 1.6 : 0.8);
        double nearest = kInfinity;
        for (const Vec3& s : c.surface) nearest = std::min(nearest, glm::distance(p, s));
        const double d = distanceAt(solid, p);
        inside += d < 0;
        EXPECT_EQ(d < 0, c.inside(p)) << "at distance " << d;
        // The surface's points are no nearer than the surface, and not much farther.
        EXPECT_LE(std::abs(d), nearest + 1e-12);
        EXPECT_GE(std::abs(d), nearest - c.density);
    }
    EXPECT_GT(inside, 10);
}

TEST_P(Shape, LiesInItsBoxAndTouchesEverySide) {
    const Case& c = GetParam();
    const SolidDistance solid = distanceOf(c.shape, 0);
    Box3 hull;
    for (const Vec3& s : c.surface) {
        EXPECT_NEAR(distanceAt(solid, s), 0, 1e-12);
        hull = join(hull, s);
    }
    for (int a = 0; a < 3; ++a) {
        EXPECT_GE(hull.min[a], solid.box.min[a] - 1e-12);
        EXPECT_LE(hull.max[a], solid.box.max[a] + 1e-12);
        EXPECT_NEAR(hull.min[a], solid.box.min[a], 0.02);
        EXPECT_NEAR(hull.max[a], solid.box.max[a], 0.02);
    }
}

TEST_P(Shape, HasAUnitGradientThatLeadsToTheSurface) {
    const SolidDistance solid = distanceOf(GetParam().shape, 0);
    std::mt19937 random(2);
    for (int n = 0; n < 500; ++n) {
        const Vec3 p = randomIn(random, 1.6), g = gradientAt(solid, p);
        EXPECT_NEAR(glm::length(g), 1, 1e-9);
        // A signed distance falls by what one goes against its gradient, down to the surface.
        EXPECT_NEAR(distanceAt(solid, p - distanceAt(solid, p) * g), 0, 1e-9);
    }
}

TEST_P(Shape, HasBoundsOverBoxes) {
    const SolidDistance solid = distanceOf(GetParam().shape, 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    int decided = 0;
    for (int n = 0; n < 300; ++n) {
        const Vec3 low = randomIn(random, 1.4), size = 0.2 * Vec3(unit(random), unit(random), unit(random));
        const Box3 box{low, low + size};
        const Interval range = solid.distance->range(box);
        for (int m = 0; m < 20; ++m)
            EXPECT_TRUE(range.contains(distanceAt(solid, low + size * Vec3(unit(random), unit(random), unit(random)))));
        decided += distanceAt(solid, box.center()) > 0.3 && range.low > 0;
    }
    EXPECT_GT(decided, 30) << "boxes well outside must be told to be empty";
}

INSTANTIATE_TEST_SUITE_P(Shapes, Shape,
                         testing::Values(sphereCase(), boxCase(), cylinderCase(), capsuleCase(),
                                         torusCase("ring torus", 0.8, 0.3), torusCase("horn torus", 0.5, 0.5),
                                         torusCase("spindle torus", 0.4, 0.7)),
                         [](const auto& shape) {
                             std::string name = shape.param.name;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

TEST(SolidShapes, OneFormulaServesAllShapesOfAKind) {
    const auto formulaOf = [](const SolidShape& shape) {
        return dynamic_cast<const ExpressionField&>(*distanceOf(shape, 0).distance).formula();
    };
    EXPECT_EQ(formulaOf(SphereShape{{0, 0, 0}, 1}), formulaOf(SphereShape{{1, 2, 3}, 4}));
    EXPECT_EQ(formulaOf(BoxShape{}), formulaOf(BoxShape{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(formulaOf(CylinderShape{}), formulaOf(CylinderShape{{1, 2, 3}, {4, 5, 6}, 7}));
    EXPECT_EQ(formulaOf(CapsuleShape{}), formulaOf(CapsuleShape{{1, 2, 3}, {4, 5, 6}, 7}));
    EXPECT_EQ(formulaOf(TorusShape{}), formulaOf(TorusShape{{1, 2, 3}, {1, 1, 0}, 1, 2}));
}

TEST(SolidShapes, AnExpressionIsTakenAsItStands) {
    const SolidDistance solid =
        distanceOf(DistanceShape{{"max(abs(x), abs(y)) - 0.5 - t", "", 1, 1}, {Vec3(-2), Vec3(2)}}, 0.25);
    EXPECT_DOUBLE_EQ(distanceAt(solid, {1, 0.2, 9}), 0.25);
    EXPECT_EQ(solid.box, (Box3{Vec3(-2), Vec3(2)}));
}

TEST(SolidShapes, SizesThatMakeNoShapeAreErrors) {
    const std::vector<SolidShape> bad{SphereShape{{0, 0, 0}, 0},
                                      SphereShape{{0, 0, 0}, kNaN},
                                      SphereShape{{kNaN, 0, 0}, 1},
                                      BoxShape{{0, 0, 0}, {1, 0, 1}},
                                      BoxShape{{0, 0, 0}, {1, kInfinity, 1}},
                                      CylinderShape{{1, 1, 1}, {1, 1, 1}, 1},
                                      CylinderShape{{0, 0, 0}, {1, 1, 1}, -1},
                                      CapsuleShape{{1, 1, 1}, {1, 1, 1}, 1},
                                      TorusShape{{0, 0, 0}, {0, 0, 0}, 1, 0.5},
                                      TorusShape{{0, 0, 0}, {0, 0, 1}, 1, 0},
                                      TextShape{"", 1, 1},
                                      TextShape{"a", 0, 1},
                                      TextShape{"a", 1, kNaN},
                                      DistanceShape{{"x +", "", 1, 1}, {Vec3(-1), Vec3(1)}},
                                      DistanceShape{{"q", "", 1, 1}, {Vec3(-1), Vec3(1)}},
                                      DistanceShape{{"x", "", 1, 1}, {Vec3(1), Vec3(-1)}}};
    for (std::size_t n = 0; n < bad.size(); ++n) EXPECT_THROW(distanceOf(bad[n], 0), Error) << n;
}

}  // namespace
}  // namespace voledit
