#include "core/objects/combine.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voledit {
namespace {

ObjectSample made(double opacity, double red, double value) {
    return {opacity, Vec3(red, 0.5, 1 - red), value, Vec3(value, 0, 0)};
}

const std::vector<ObjectSample> kTwo{made(0.2, 0.1, 10), made(0.6, 0.9, 20)};

TEST(Combine, NothingIsEmptyAndOneIsItself) {
    for (const Combine by : {Combine::Union, Combine::Merge, Combine::Intersection, Combine::First}) {
        EXPECT_EQ(combined({}, by).opacity, 0);
        EXPECT_TRUE(std::isnan(combined({}, by).value));
        const auto one = combined(std::span(kTwo).first(1), by);
        EXPECT_EQ(one.opacity, 0.2);
        EXPECT_EQ(one.color, kTwo[0].color);
        EXPECT_EQ(one.value, 10);
        EXPECT_EQ(one.normalGradient, Vec3(10, 0, 0));
    }
}

TEST(Combine, UnionTakesTheLargerOpacityWholeAndTheFirstOnATie) {
    const auto larger = combined(kTwo, Combine::Union);
    EXPECT_EQ(larger.opacity, 0.6);
    EXPECT_EQ(larger.color, kTwo[1].color);
    EXPECT_EQ(larger.value, 20);
    EXPECT_EQ(larger.normalGradient, Vec3(20, 0, 0));
    const auto tie = combined(std::vector{made(0.3, 0.1, 1), made(0.3, 0.2, 2), made(0.3, 0.3, 3)}, Combine::Union);
    EXPECT_EQ(tie.value, 1);
    EXPECT_EQ(tie.color, made(0.3, 0.1, 1).color);
}

TEST(Combine, MergeAddsAndMixes) {
    const auto sum = combined(kTwo, Combine::Merge);
    EXPECT_DOUBLE_EQ(sum.opacity, 0.8);
    EXPECT_DOUBLE_EQ(sum.color.r, (0.2 * 0.1 + 0.6 * 0.9) / 0.8);
    EXPECT_EQ(combined(std::vector{made(0.7, 0, 1), made(0.7, 1, 2)}, Combine::Merge).opacity, 1);
    EXPECT_EQ(combined(std::vector{made(0, 0.2, 1), made(0, 0.4, 2)}, Combine::Merge).color.r, 0.30000000000000004);
}

TEST(Combine, IntersectionTakesTheSmallerOpacityWithTheLargersColour) {
    const auto common = combined(kTwo, Combine::Intersection);
    EXPECT_EQ(common.opacity, 0.2);
    EXPECT_EQ(common.color, kTwo[1].color);
    EXPECT_EQ(common.value, 20) << "the scalar is always that of the largest opacity";
    EXPECT_EQ(common.normalGradient, Vec3(10, 0, 0)) << "the surface seen is the smaller one's";
}

TEST(Combine, FirstIsTheFirst) {
    const auto first = combined(kTwo, Combine::First);
    EXPECT_EQ(first.opacity, 0.2);
    EXPECT_EQ(first.color, kTwo[0].color);
    EXPECT_EQ(first.normalGradient, Vec3(10, 0, 0));
}

TEST(Combine, OnATieTheFirstShadesThoughAnotherHasTheValue) {
    ObjectSample plain = made(0.5, 0.1, 1);
    plain.value = kNaN;
    const auto s = combined(std::vector{plain, made(0.5, 0.9, 2)}, Combine::Union);
    EXPECT_EQ(s.value, 2);
    EXPECT_EQ(s.color, plain.color);
    EXPECT_EQ(s.normalGradient, plain.normalGradient);
}

TEST(Combine, AnInvisibleValueCountsBeforeNone) {
    const auto s = combined(std::vector{ObjectSample{}, made(0, 0.5, 7), made(0, 0.5, 8)}, Combine::Union);
    EXPECT_EQ(s.value, 7);
}

}  // namespace
}  // namespace voledit
