#include "core/stf/component_field.h"

#include <gtest/gtest.h>

#include "tests/core/stf/analytic_maps.h"

namespace voledit {
namespace {

const Box3 kUnit{Vec3(-1), Vec3(1)};

TEST(ComponentField, IsAComponentOfThePointOrOfTheDisplacement) {
    const auto p = randomPoints(kUnit, 100);
    const auto q = mappedBy(*wave(), p);
    std::vector<double> value(p.size());
    for (int axis = 0; axis < 3; ++axis) {
        ComponentField(wave(), axis, false).sample(p, value);
        for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(value[i], q[i][axis]);
        ComponentField(wave(), axis, true).sample(p, value);
        for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(value[i], q[i][axis] - p[i][axis]);
    }
}

TEST(ComponentField, IsUndefinedWhereTheMapIs) {
    const ComponentField field(halfSpace({1, 0, 0}), 0, true);
    const std::vector<Vec3> p{Vec3(0.5), Vec3(-0.5), kUndefined};
    std::vector<double> value(3);
    std::vector<Vec3> gradient(3);
    field.sample(p, value);
    field.gradient(p, gradient);
    EXPECT_NE(value[0], value[0]);
    EXPECT_EQ(value[1], 1);
    EXPECT_NE(value[2], value[2]);
    EXPECT_EQ(gradient[0], Vec3(0));
    const Interval nothing = field.range({Vec3(0.2), Vec3(0.3)});
    EXPECT_GT(nothing.low, nothing.high);
}

TEST(ComponentField, GradientsAreThoseOfFiniteDifferences) {
    const auto p = randomPoints(kUnit, 100);
    std::vector<Vec3> gradient(p.size());
    const double h = 1e-5;
    for (const bool displacement : {false, true})
        for (int axis = 0; axis < 3; ++axis) {
            const ComponentField field(wave(), axis, displacement);
            field.gradient(p, gradient);
            for (std::size_t i = 0; i < p.size(); ++i)
                for (int a = 0; a < 3; ++a) {
                    Vec3 step(0);
                    step[a] = h;
                    std::array<double, 2> ends;
                    field.sample(std::array{p[i] - step, p[i] + step}, ends);
                    EXPECT_NEAR(gradient[i][a], (ends[1] - ends[0]) / (2 * h), 1e-8);
                }
        }
}

TEST(ComponentField, RangesHoldTheValues) {
    for (const bool displacement : {false, true})
        for (unsigned n = 0; n < 100; ++n) {
            const ComponentField field(wave(), int(n % 3), displacement);
            const Vec3 corner = randomPoints(kUnit, 1, n)[0];
            const Box3 box{corner, corner + 0.02 * double(n % 20)};
            const Interval range = field.range(box);
            const auto p = randomPoints(box, 100, n);
            std::vector<double> value(p.size());
            field.sample(p, value);
            for (const double v : value) EXPECT_TRUE(range.low - 1e-12 <= v && v <= range.high + 1e-12);
            EXPECT_LT(range.high - range.low, 10 * (box.max.x - box.min.x) + 1e-12) << "and not much more";
        }
}

}  // namespace
}  // namespace voledit
