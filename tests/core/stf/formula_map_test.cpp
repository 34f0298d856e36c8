#include "core/stf/formula_map.h"

#include <gtest/gtest.h>

#include "tests/core/stf/analytic_maps.h"

namespace voledit {
namespace {

FormulaMap::Parts parts(const std::string& q, const std::string& undefined = "") {
    FormulaSymbols symbols;
    symbols.variables = {{"p", 3}};
    symbols.parameters = {{"k", 1}};
    std::vector<FormulaOutput> outputs{{{q, "", 1, 1}, FormulaType::Vector}};
    if (!undefined.empty()) outputs.push_back({{undefined, "", 1, 1}, FormulaType::Condition});
    return {FormulaGraph({}, outputs, symbols), {2.0}, Mat4(1), Mat4(1), Outside::Hide, {}, std::nullopt};
}

TEST(FormulaMap, WorldCoordinatesGoThroughToTheBit) {
    const FormulaMap map(parts("p"));
    const auto points = randomPoints({Vec3(-1e7), Vec3(1e7)}, 3000);  // more than a block
    EXPECT_EQ(mappedBy(map, points), points);
    std::vector<Mat3> j(points.size());
    map.jacobian(points, j);
    for (const Mat3& m : j) EXPECT_EQ(m, Mat3(1));
}

TEST(FormulaMap, AliasedAndShortSpansGiveTheSame) {
    const FormulaMap map(parts("[p.x * k, sin(p.y), p.z - p.x]"));
    const auto points = randomPoints({Vec3(-3), Vec3(3)}, 1000);
    std::vector<Vec3> q(points.size());
    map.map(points, q);
    EXPECT_EQ(mappedBy(map, points), q);  // in place
    for (std::size_t i = 0; i < points.size(); i += 17) EXPECT_EQ(mappedBy(map, {points[i]})[0], q[i]);
    map.map({}, {});
}

TEST(FormulaMap, WhatIsNoNumberOrConditionedAwayIsUndefined) {
    const std::vector<Vec3> points{{1, 1, 1}, {0, 1, 1}, {-1, 1, 1}, {1, 0, 1}, {5, 5, 5}, kUndefined};
    const FormulaMap hidden(parts("[sqrt(p.x), 1 / p.y, p.z / p.x]", "p.x > 4"));
    const auto q = mappedBy(hidden, points);
    EXPECT_EQ(q[0], Vec3(1));
    for (std::size_t i = 1; i < 6; ++i) {
        // All three components are NaN: one alone would be half a point.
        EXPECT_TRUE(std::isnan(q[i].x) && std::isnan(q[i].y) && std::isnan(q[i].z)) << i;
    }
    FormulaMap::Parts keeping = parts("[sqrt(p.x), 1 / p.y, p.z / p.x]", "p.x > 4");
    keeping.outside = Outside::Keep;
    const FormulaMap kept(keeping);
    const auto k = mappedBy(kept, points);
    EXPECT_EQ(k[0], Vec3(1));
    for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(k[i], points[i]);
    EXPECT_FALSE(isDefined(k[5]));
    for (const FormulaMap* map : {&hidden, &kept}) {
        std::vector<Mat3> j(points.size());
        map->jacobian(points, j);
        EXPECT_NE(j[0], Mat3(1));
        for (std::size_t i = 1; i < points.size(); ++i) EXPECT_EQ(j[i], Mat3(1)) << i;
    }
    const FormulaMap constant(parts("[1, 2, 3]"));
    EXPECT_EQ(mappedBy(constant, {Vec3(9)})[0], Vec3(1, 2, 3));
    EXPECT_FALSE(isDefined(mappedBy(constant, {kUndefined})[0]));
}

TEST(FormulaMap, CoordinatesOfAFrameTurnPointsAndJacobians) {
    FormulaMap::Parts in = parts("[p.x * p.x, p.y + 0.3 * sin(p.z), p.z * (1 + p.x)]");
    const Frame frame{{3, 4, 5}, {Vec3(2, 1, 0), Vec3(-1, 3, 0.5), Vec3(0.2, 0, 4)}};
    in.formulaFromWorld = normalisedFromWorld(frame);
    in.worldFromFormula = worldFromNormalised(frame);
    const FormulaMap map(in);
    const auto points = randomPoints({Vec3(-5), Vec3(8)}, 300);
    const auto q = mappedBy(map, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 u = transformPoint(in.formulaFromWorld, points[i]);
        const Vec3 v(u.x * u.x, u.y + 0.3 * std::sin(u.z), u.z * (1 + u.x));
        EXPECT_LT(glm::length(q[i] - transformPoint(in.worldFromFormula, v)), 1e-12);
    }
    EXPECT_LT(jacobianError(map, points), 1e-6);
}

TEST(FormulaMap, ImagesOfNothingAreNothingAndKeepHoldsTheBox) {
    FormulaMap::Parts in = parts("p + [5, 0, 0]");
    const Box3 rest{Vec3(0), Vec3(1)}, moved{Vec3(-5, 0, 0), Vec3(-4, 1, 1)};
    EXPECT_EQ(FormulaMap(in).imageOf(rest), rest);  // without an image of its own
    in.image = [&](const Box3&) { return moved; };
    EXPECT_EQ(FormulaMap(in).imageOf(rest), moved);
    EXPECT_TRUE(FormulaMap(in).imageOf(Box3{}).empty());
    in.outside = Outside::Keep;
    EXPECT_EQ(FormulaMap(in).imageOf(rest), join(rest, moved));
}

TEST(FormulaMap, SourceBoxesAreTightBoundedInNumberAndStopWhenFound) {
    // The square's natural bounds are loose about 0: the box is split, into at most eight.
    const FormulaMap map(parts("[p.x * p.y, p.x * (1 - p.x), p.z]"));
    int boxes = 0;
    Box3 all;
    EXPECT_FALSE(map.anySourceBox({{0, 0, 0}, {1, 0.1, 0.1}},
                                  [&](const Box3& b) { return ++boxes, all = join(all, b), false; }));
    EXPECT_GT(boxes, 1);
    EXPECT_LE(boxes, 8);
    EXPECT_LT(all.max.y, 0.5);  // the truth is 0.25; unsplit it would be 1
    EXPECT_GE(all.max.y, 0.25);
    boxes = 0;
    EXPECT_TRUE(map.anySourceBox({{0, 0, 0}, {1, 0.1, 0.1}}, [&](const Box3&) { return ++boxes, true; }));
    EXPECT_EQ(boxes, 1);
    EXPECT_FALSE(map.anySourceBox(Box3{}, [](const Box3&) { return true; }));
    // Poles and boxes without end give boxes without end, not none.
    for (const auto& box : {Box3{Vec3(-1), Vec3(1)}, Box3{Vec3(-kInfinity), Vec3(kInfinity)}})
        EXPECT_TRUE(FormulaMap(parts("1 / p")).anySourceBox(box, [](const Box3& b) { return b.contains(Vec3(1e6)); }));
}

}  // namespace
}  // namespace voledit
