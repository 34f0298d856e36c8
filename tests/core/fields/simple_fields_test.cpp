#include "core/fields/simple_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace voledit {
namespace {

std::vector<Vec3> randomPoints(std::size_t count, double size, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-size, size);
    std::vector<Vec3> p(count);
    for (Vec3& at : p)
        for (int a = 0; a < 3; ++a) at[a] = unit(random);
    return p;
}

std::vector<double> valuesOf(const ScalarField& field, const std::vector<Vec3>& p) {
    std::vector<double> value(p.size());
    field.sample(p, value);
    return value;
}

std::vector<Vec3> gradientsOf(const ScalarField& field, const std::vector<Vec3>& p) {
    std::vector<Vec3> gradient(p.size());
    field.gradient(p, gradient);
    return gradient;
}

ExpressionField expression(const std::string& text, double time = 0) {
    return ExpressionField({text, "", 1, 1}, time);
}

std::shared_ptr<const Volume> volume(int n = 12) {
    VolumeGrid grid{{n, n - 1, n - 2}, 2, Mat4(1.0)};
    grid.worldFromIndex[0] = Vec4(0.2, 0.03, 0, 0);
    grid.worldFromIndex[1] = Vec4(-0.05, 0.25, 0.02, 0);
    grid.worldFromIndex[2] = Vec4(0, 0.04, 0.3, 0);
    grid.worldFromIndex[3] = Vec4(-1, -1, -1, 1);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 100);
    std::vector<float> values(grid.valueCount());
    for (float& v : values) v = unit(random);
    values[123] = NAN;
    return Volume::fromValues(grid, std::move(values));
}

TEST(ConstantField, IsOneValueWhereThereIsAPlace) {
    const ConstantField field(2.5);
    EXPECT_EQ(valuesOf(field, {Vec3(1), Vec3(kInfinity)}), (std::vector<double>{2.5, 2.5}));
    EXPECT_TRUE(std::isnan(valuesOf(field, {kUndefined})[0]));
    EXPECT_EQ(gradientsOf(field, {Vec3(1)})[0], Vec3(0));
    EXPECT_EQ(field.range({Vec3(0), Vec3(1)}), (Interval{2.5, 2.5}));
}

TEST(ExpressionField, EvaluatesItsFormulaAtTheTimeItIsGiven) {
    const auto p = randomPoints(1000, 2);
    const auto value = valuesOf(expression("sin(x)*y + z^2 + 10*t", 0.5), p);
    for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_NEAR(value[i], std::sin(p[i].x) * p[i].y + p[i].z * p[i].z + 5, 1e-14);
}

TEST(ExpressionField, DifferentiatesExactly) {
    const auto p = randomPoints(600, 2);
    const auto gradient = gradientsOf(expression("sin(x)*y + exp(z)/(1 + y*y) + t", 0.5), p);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto [x, y, z] = std::array{p[i].x, p[i].y, p[i].z};
        const double q = 1 + y * y;
        const Vec3 expected(std::cos(x) * y, std::sin(x) - std::exp(z) * 2 * y / (q * q), std::exp(z) / q);
        EXPECT_LT(glm::distance(gradient[i], expected), 1e-12);
    }
}

TEST(ExpressionField, IsUndefinedWhereItsPointOrItsFormulaIs) {
    const auto constant = expression("3"), root = expression("sqrt(x)");
    EXPECT_TRUE(std::isnan(valuesOf(constant, {Vec3(0, kNaN, 0)})[0]));
    EXPECT_TRUE(std::isnan(valuesOf(root, {Vec3(-1, 0, 0)})[0]));
    EXPECT_EQ(gradientsOf(root, {Vec3(-1, 0, 0)})[0], Vec3(0));
    EXPECT_EQ(gradientsOf(expression("length(x, y, z)"), {Vec3(0)})[0], Vec3(0)) << "no direction, though a value";
    EXPECT_EQ(gradientsOf(root, {kUndefined})[0], Vec3(0));
    EXPECT_THROW(expression("x +"), FormulaError);
    EXPECT_THROW(expression("u"), FormulaError);
}

TEST(ExpressionField, TimeDoesNotChangeItsGraph) {
    EXPECT_EQ(expression("x + t", 0).formula(), expression("x + t", 3).formula());
}

TEST(ExpressionField, RangeHoldsItsValues) {
    const auto field = expression("x*y - abs(z)");
    const Interval range = field.range({{-1, 2, -3}, {2, 3, 1}});
    EXPECT_LE(range.low, -6);
    EXPECT_GE(range.high, 6);
    EXPECT_TRUE(std::isfinite(range.low) && std::isfinite(range.high));
}

TEST(VolumeField, IsItsVolumesChannel) {
    const auto of = volume();
    const auto p = randomPoints(800, 1.5);
    for (const Interpolation by : {Interpolation::Linear, Interpolation::Nearest, Interpolation::Cubic}) {
        const VolumeField field(of, 1, by);
        std::vector<double> value(p.size());
        std::vector<Vec3> gradient(p.size());
        of->sample(p, value, 1, by);
        of->gradient(p, gradient, 1, by);
        const auto found = valuesOf(field, p);
        for (std::size_t i = 0; i < p.size(); ++i)
            EXPECT_TRUE(found[i] == value[i] || (std::isnan(found[i]) && std::isnan(value[i])));
        const auto slopes = gradientsOf(field, p);
        for (std::size_t i = 0; i < p.size(); ++i) EXPECT_TRUE(slopes[i] == gradient[i] || !isDefined(gradient[i]));
    }
    EXPECT_EQ(VolumeField(of, 0).domain(), boundsOf(of->grid().worldFrame()));
}

TEST(VolumeField, RangeHoldsItsValuesForEveryInterpolation) {
    const auto of = volume();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Interpolation by : {Interpolation::Linear, Interpolation::Nearest, Interpolation::Cubic}) {
        const VolumeField field(of, 1, by);
        int inside = 0;
        for (const Vec3& corner : randomPoints(300, 1.5, 4)) {
            const Vec3 size = 0.4 * Vec3(unit(random), unit(random), unit(random));
            const Interval range = field.range({corner, corner + size});
            for (int n = 0; n < 20; ++n) {
                const double value =
                    valuesOf(field, {corner + size * Vec3(unit(random), unit(random), unit(random))})[0];
                if (std::isnan(value)) continue;
                ++inside;
                EXPECT_LE(range.low, value + 1e-9);
                EXPECT_GE(range.high, value - 1e-9);
            }
        }
        EXPECT_GT(inside, 1000);
        const Interval outside = field.range({Vec3(5), Vec3(6)});
        EXPECT_GT(outside.low, outside.high);
    }
}

TEST(MapField, IsATableOfAnotherField) {
    const PiecewiseLinear table{{{-1, 5}, {0, 1}, {1, 2}, {1, 4}, {2, 4}}};
    const auto of = std::make_shared<ExpressionField>(FormulaText{"x + sqrt(y)", "", 1, 1}, 0.0);
    const MapField field(table, of);
    const std::vector<Vec3> p{Vec3(0.5, 0, 0), Vec3(-2, 0, 0), Vec3(1, 0, 0), Vec3(0.25, 0.0625, 0), Vec3(0, -1, 0)};
    const auto value = valuesOf(field, p);
    EXPECT_EQ(std::vector<double>(value.begin(), value.end() - 1), (std::vector<double>{1.5, 5, 4, 1.5}));
    EXPECT_TRUE(std::isnan(value.back()));
    const auto gradient = gradientsOf(field, p);
    EXPECT_EQ(gradient[1], Vec3(0)) << "held beyond the ends";
    EXPECT_EQ(gradient[3], Vec3(1, 2, 0));
    EXPECT_EQ(gradient[4], Vec3(0));
    EXPECT_NEAR(field.range({Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)}).low, 1, 1e-12);
    EXPECT_NEAR(field.range({Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)}).high, 3, 1e-12);
    EXPECT_EQ(MapField(table, std::make_shared<VolumeField>(volume(), 0)).domain(), VolumeField(volume(), 0).domain());
    const auto nowhere = MapField(table, std::make_shared<VolumeField>(volume(), 0)).range({Vec3(5), Vec3(6)});
    EXPECT_GT(nowhere.low, nowhere.high);
}

}  // namespace
}  // namespace voledit
