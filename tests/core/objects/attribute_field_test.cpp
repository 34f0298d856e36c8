#include "core/objects/attribute_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

TermPtr object() {
    return fields("0.5 + 0.25*sin(x)*y", {0.1, 0.2, 0.3}, {{"density", expression("x*x + y*z")}});
}

TEST(AttributeField, GivesAnObjectsAttribute) {
    const auto p = randomPoints(1500, 1.2);  // more than are evaluated together
    for (const char* name : {"opacity", "r", "g", "b", "density", "scalar", "unknown"}) {
        const AttributeField field(name, object());
        const auto expected = sampled(object(), p, false, name);
        std::vector<double> value(p.size());
        field.sample(p, value);
        for (std::size_t i = 0; i < p.size(); ++i)
            EXPECT_TRUE(value[i] == expected[i].value || (std::isnan(value[i]) && std::isnan(expected[i].value)));
    }
}

TEST(AttributeField, GradientIsThatOfItsValues) {
    const AttributeField density("density", object()), opacity("opacity", object());
    EXPECT_DOUBLE_EQ(density.step(), 2.0 / 512);
    const auto p = randomPoints(300, 0.9);
    std::vector<Vec3> ofDensity(p.size()), ofOpacity(p.size());
    density.gradient(p, ofDensity);
    opacity.gradient(p, ofOpacity);
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_LT(glm::distance(ofDensity[i], Vec3(2 * p[i].x, p[i].z, p[i].y)), 1e-9);
        EXPECT_LT(glm::distance(ofOpacity[i], 0.25 * Vec3(std::cos(p[i].x) * p[i].y, std::sin(p[i].x), 0)), 1e-5);
    }
}

TEST(AttributeField, GradientIsOneSidedWhereTheObjectEndsAndZeroBeyond) {
    const AttributeField field("density", object());
    const std::vector<Vec3> p{Vec3(1, 0.2, 0.4), Vec3(1.1, 0.2, 0.4), kUndefined};
    std::vector<Vec3> gradient(p.size());
    field.gradient(p, gradient);
    EXPECT_LT(glm::distance(gradient[0], Vec3(2, 0.4, 0.2)), 2 * field.step());
    EXPECT_EQ(gradient[1], Vec3(0));
    EXPECT_EQ(gradient[2], Vec3(0));
}

TEST(AttributeField, RangeHoldsTheValues) {
    const AttributeField density("density", object()), nothing("unknown", object());
    const Interval range = density.range({Vec3(0.1), Vec3(0.2)});
    EXPECT_LE(range.low, 0.01 + 0.01);
    EXPECT_GE(range.high, 0.04 + 0.04);
    EXPECT_LT(range.high, 0.1);
    EXPECT_GT(nothing.range({Vec3(0), Vec3(1)}).low, nothing.range({Vec3(0), Vec3(1)}).high) << "no value anywhere";
    EXPECT_EQ(AttributeField("opacity", object()).range({Vec3(2), Vec3(3)}), (Interval{0, 0}));
}

}  // namespace
}  // namespace voledit
