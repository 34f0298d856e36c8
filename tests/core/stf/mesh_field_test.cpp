#include "core/stf/mesh_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/error.h"
#include "tests/support/meshes.h"

namespace voledit {
namespace {

using Random = std::mt19937_64;
using Function = double (*)(const Vec3&);

double linear(const Vec3& p) {
    return 3 + 2 * p.x - 5 * p.y + 0.5 * p.z;
}
const Vec3 kLinearGradient{2, -5, 0.5};

double quadratic(const Vec3& p) {
    return p.x * p.x - 2 * p.y * p.z + p.z * p.z + p.x * p.y;
}
Vec3 quadraticGradient(const Vec3& p) {
    return {2 * p.x + p.y, -2 * p.z + p.x, -2 * p.y + 2 * p.z};
}

MeshField fieldOf(MeshData data, Function f) {
    data.values.clear();
    for (const Vec3& p : data.points) data.values.push_back(float(f(p)));
    return {std::make_shared<const Mesh>(std::move(data)), 0};
}

std::vector<Vec3> randomPoints(int count, const Box3& box) {
    Random random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> points;
    for (int n = 0; n < count; ++n)
        points.push_back(box.min + Vec3(unit(random), unit(random), unit(random)) * box.size());
    return points;
}

/// Differences from `f` and its gradient over the points that the field holds.
struct Errors {
    double value = 0, gradient = 0;  // the largest
    double meanGradient = 0;
    int inside = 0;
};
template <class F, class G>
Errors errorsOf(const MeshField& field, const std::vector<Vec3>& points, const F& f, const G& g) {
    std::vector<double> value(points.size());
    std::vector<Vec3> gradient(points.size());
    field.sample(points, value);
    field.gradient(points, gradient);
    Errors errors;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (value[i] != value[i]) continue;
        ++errors.inside;
        errors.value = std::max(errors.value, std::abs(value[i] - f(points[i])));
        const double difference = glm::length(gradient[i] - g(points[i]));
        errors.gradient = std::max(errors.gradient, difference);
        errors.meanGradient += difference;
    }
    errors.meanGradient /= std::max(errors.inside, 1);
    return errors;
}

TEST(MeshField, LinearFieldsAreExactInValueAndGradient) {
    for (MeshData data : {test::tetrahedralBall(6), test::warpedGrid({7, 6, 5})}) {
        const MeshField field = fieldOf(std::move(data), linear);
        const auto points = randomPoints(4000, field.domain());
        const Errors errors = errorsOf(field, points, linear, [](const Vec3&) { return kLinearGradient; });
        EXPECT_GT(errors.inside, 1500);
        // Vertex values are floats: 24 bits.
        EXPECT_LT(errors.value, 1e-6);
        EXPECT_LT(errors.gradient, 1e-5);
    }
}

TEST(MeshField, QuadraticFieldsConvergeInSecondOrder) {
    const Function f = quadratic;
    const auto points = randomPoints(20000, {Vec3(-0.45), Vec3(0.45)});
    const auto order = [&](const auto& makeMesh) {
        std::array<Errors, 3> errors;
        for (int level = 0; level < 3; ++level)
            errors[std::size_t(level)] = errorsOf(fieldOf(makeMesh(6 << level), f), points, f, quadraticGradient);
        EXPECT_EQ(errors[0].inside, int(points.size()));
        // Gradients of irregular tetrahedra are of first order, and so are their means.
        EXPECT_GT(std::log2(errors[0].meanGradient / errors[2].meanGradient) / 2, 0.9);
        return std::log2(errors[0].value / errors[2].value) / 2;
    };
    EXPECT_NEAR(order([](int n) { return test::tetrahedralBall(n); }), 2, 0.15);
    EXPECT_NEAR(order([](int n) { return test::warpedGrid(Index3(n)); }), 2, 0.15);
}

TEST(MeshField, OrientationOfTetrahedraDoesNotMatter) {
    MeshData data = test::tetrahedralBall(5);
    for (std::size_t t = 0; t < data.tetrahedra.size(); t += 2) std::swap(data.tetrahedra[t][1], data.tetrahedra[t][2]);
    const MeshField turned = fieldOf(std::move(data), quadratic), field = fieldOf(test::tetrahedralBall(5), quadratic);
    EXPECT_FALSE(turned.mesh()->cells().mayOverlap());
    const auto points = randomPoints(3000, field.domain());
    std::vector<double> a(points.size()), b(points.size());
    field.sample(points, a);
    turned.sample(points, b);
    std::vector<Vec3> g(points.size()), h(points.size());
    field.gradient(points, g);
    turned.gradient(points, h);
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(a[i] == a[i], b[i] == b[i]);
        if (a[i] != a[i]) continue;
        EXPECT_NEAR(a[i], b[i], 1e-13);
        EXPECT_LT(glm::length(g[i] - h[i]), 1e-12);
    }
}

TEST(MeshField, PointsOnVerticesEdgesAndFacesAreFound) {
    const MeshField field = fieldOf(test::tetrahedralBall(5), linear);
    const MappedCells& cells = field.mesh()->cells();
    std::vector<Vec3> points;
    for (const auto& t : cells.tetrahedra()) {
        const auto x = [&](std::size_t v) { return cells.deformed()[t[v]]; };
        points.insert(points.end(),
                      {x(0), 0.5 * (x(1) + x(2)), (x(0) + x(1) + x(3)) / 3.0, (x(1) + x(2) + x(3)) / 3.0});
    }
    std::vector<double> value(points.size());
    field.sample(points, value);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(value[i], linear(points[i]), 1e-6) << i;
}

TEST(MeshField, VerticesGiveTheirValues) {
    const MeshField field = fieldOf(test::warpedGrid({4, 4, 4}), quadratic);
    const auto points = field.mesh()->cells().deformed();
    std::vector<double> value(points.size());
    field.sample(points, value);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(value[i], double(field.mesh()->values()[i]), 1e-12) << i;
}

TEST(MeshField, OutsideIsUndefinedWithoutGradient) {
    const MeshField field = fieldOf(test::tetrahedralBall(4), linear);
    const Box3 box = field.domain();
    const std::vector<Vec3> points{box.max + 0.01, box.corner(0) + 0.01 * box.size(), Vec3(1e30), kUndefined,
                                   Vec3(kInfinity, 0, 0)};
    std::vector<double> value(points.size(), 1);
    std::vector<Vec3> gradient(points.size(), Vec3(1));
    field.sample(points, value);
    field.gradient(points, gradient);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NE(value[i], value[i]) << i;
        EXPECT_EQ(gradient[i], Vec3(0)) << i;
    }
}

TEST(MeshField, RangeHoldsTheValuesOfABoxAndIsNotMuchWider) {
    for (MeshData data : {test::tetrahedralBall(10), test::warpedGrid(Index3(10))}) {
        const MeshField field = fieldOf(std::move(data), quadratic);
        Random random(3);
        std::uniform_real_distribution<double> unit(-0.6, 0.6), side(0.01, 0.4);
        for (int n = 0; n < 200; ++n) {
            const Vec3 corner(unit(random), unit(random), unit(random));
            const Box3 box{corner, corner + side(random)};
            const Interval range = field.range(box);
            const auto points = randomPoints(300, box);
            std::vector<double> value(points.size());
            field.sample(points, value);
            Interval found{kInfinity, -kInfinity};
            for (const double v : value)
                if (v == v) found = join(found, {v, v});
            if (found.low > found.high) continue;
            EXPECT_LE(range.low, found.low);
            EXPECT_GE(range.high, found.high);
            // Cells that only reach into the box add at most their own size's worth: |∇f| < 4.
            EXPECT_GT(range.low, found.low - 4 * 0.5);
            EXPECT_LT(range.high, found.high + 4 * 0.5);
        }
        const Interval whole = field.range({Vec3(-kInfinity), Vec3(kInfinity)});
        EXPECT_NEAR(whole.low, field.mesh()->range(0).low, 1e-12);
        EXPECT_NEAR(whole.high, field.mesh()->range(0).high, 1e-12);
        const Interval nothing = field.range({Vec3(50), Vec3(51)});
        EXPECT_GT(nothing.low, nothing.high);
    }
}

TEST(MeshField, ChannelsAreInterleaved) {
    MeshData data = test::tetrahedralBall(3);
    data.channels = 2;
    data.values.clear();
    for (const Vec3& p : data.points) data.values.insert(data.values.end(), {float(p.x), float(linear(p))});
    const auto mesh = std::make_shared<const Mesh>(std::move(data));
    const std::vector<Vec3> p{{0.1, 0.2, -0.1}};
    std::vector<double> value(1);
    MeshField(mesh, 0).sample(p, value);
    EXPECT_NEAR(value[0], 0.1, 1e-7);
    MeshField(mesh, 1).sample(p, value);
    EXPECT_NEAR(value[0], linear(p[0]), 1e-6);
    EXPECT_THROW(MeshField(mesh, 2), Error);
}

TEST(MeshField, ValuesThatAreNoneLeaveAGapAndNothingElse) {
    for (const float none : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        MeshData data = test::warpedGrid({6, 6, 6});
        data.values.clear();
        for (const Vec3& p : data.points) data.values.push_back(float(linear(p)));
        data.values[171] = none;  // the middle
        const MeshField field(std::make_shared<const Mesh>(std::move(data)), 0);
        const auto points = randomPoints(3000, {Vec3(-0.4), Vec3(0.4)});
        const Errors errors = errorsOf(field, points, linear, [](const Vec3&) { return kLinearGradient; });
        EXPECT_LT(errors.inside, 3000);
        EXPECT_GT(errors.inside, 2200);  // 24 tetrahedra of 4 cells' volume are a fifth
        EXPECT_LT(errors.value, 1e-6);
        EXPECT_LT(errors.gradient, 1e-5);
        EXPECT_LT(field.range({Vec3(-1), Vec3(1)}).high, 10.6);
    }
}

TEST(Mesh, RefusesWhatDoesNotFit) {
    MeshData data = test::tetrahedralBall(3);
    data.values.pop_back();
    EXPECT_THROW(Mesh(std::move(data)), Error);
    data = test::tetrahedralBall(3);
    data.tetrahedra[4][2] = std::uint32_t(data.points.size());
    EXPECT_THROW(Mesh(std::move(data)), Error);
    data = test::tetrahedralBall(3);
    data.points[4].y = kInfinity;
    EXPECT_THROW(Mesh(std::move(data)), Error);
}

}  // namespace
}  // namespace voledit
