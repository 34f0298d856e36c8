#include "core/stf/composite_maps.h"

#include <gtest/gtest.h>

#include "core/fields/simple_fields.h"
#include "core/stf/lattice.h"
#include "tests/core/stf/analytic_maps.h"

namespace voledit {
namespace {

using Choice = ChosenMap::Choice;
const Box3 kUnit{Vec3(-1), Vec3(1)};

FieldPtr number(double value) {
    return std::make_shared<ConstantField>(value);
}
TransferPtr scaled(FieldPtr by, TransferPtr of) {
    return std::make_shared<ScaledMap>(std::move(by), std::move(of));
}
TransferPtr sum(std::vector<TransferPtr> of) {
    return std::make_shared<SumMap>(std::move(of));
}
TransferPtr sequence(std::vector<TransferPtr> of) {
    return std::make_shared<SequenceMap>(std::move(of));
}
TransferPtr chosen(Choice choice, std::vector<TransferPtr> of) {
    return std::make_shared<ChosenMap>(choice, std::move(of));
}
TransferPtr blend(FieldPtr weight, TransferPtr a, TransferPtr b) {
    return std::make_shared<BlendedMap>(std::move(weight), std::move(a), std::move(b));
}
TransferPtr turn(double degrees) {
    return std::make_shared<AffineMap>(placementMatrix(Vec3(0), {0, 0, degrees * kPi / 180}, Vec3(1)));
}
TransferPtr bulge() {
    const Frame frame = frameOf(kUnit);
    Lattice lattice{LatticeBasis::Bezier, Index3(3), frame, restControlPoints(LatticeBasis::Bezier, Index3(3), frame)};
    lattice.control[26] += Vec3(0.8, 0.5, 0.3);
    return std::make_shared<LatticeMap>(lattice, Index3(4), Outside::Hide);
}

double largestDifference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(isDefined(a[i]), isDefined(b[i])) << i;
        if (isDefined(a[i])) largest = std::max(largest, glm::length(a[i] - b[i]));
    }
    return largest;
}

/// One of every combination, over smooth maps, a map with a border, and cells.
std::vector<std::pair<std::string, TransferPtr>> everyKind() {
    return {{"sequence", sequence({wave(), turn(30), translation({0.2, 0, 0})})},
            {"sequence over cells", sequence({bulge(), wave()})},
            {"scaled by a number", scaled(number(0.6), wave())},
            {"scaled by more than 1", scaled(number(1.7), wave())},
            {"scaled by a field", scaled(xField(), wave())},
            {"scaled cells", scaled(number(0.5), bulge())},
            {"sum", sum({wave(), translation({0.3, -0.1, 0}), wave()})},
            {"union", chosen(Choice::Larger, {wave(), translation({0.1, 0, 0})})},
            {"intersection", chosen(Choice::Smaller, {wave(), translation({0.1, 0, 0})})},
            {"blend", blend(number(0.3), wave(), turn(20))},
            {"blend by a field", blend(xField(0.5), wave(), translation({0.2, 0, 0}))},
            {"nested", scaled(number(0.5), sum({chosen(Choice::Larger, {wave(), turn(10)}), sequence({wave()})}))},
            {"with a border", sum({halfSpace({0.2, 0, 0}), wave()})}};
}

TEST(CompositeMaps, ASequenceTransfersByItsFirstMapFirst) {
    // o moved by +1 and then turned by 90°: what shows at p is what lay at (turned back p) − 1.
    const auto map = sequence({translation({1, 0, 0}), turn(90)});
    const auto q = mappedBy(*map, {Vec3(0, 3, 5)});
    EXPECT_LT(glm::length(q[0] - Vec3(2, 0, 5)), 1e-14);
    EXPECT_EQ(mappedBy(*sequence({wave()}), {Vec3(0.1, 0.2, 0.3)}), mappedBy(*wave(), {Vec3(0.1, 0.2, 0.3)}));
}

TEST(CompositeMaps, ScaledByExactlyZeroIsTheIdentityAlsoWhereUndefined) {
    const auto p = randomPoints(kUnit, 100);
    EXPECT_EQ(mappedBy(*scaled(number(0), halfSpace({1, 0, 0})), p), p);
    // A field that is 0 at one point: there alone the gap closes.
    const auto q = mappedBy(*scaled(xField(-0.5), halfSpace({1, 0, 0})), {Vec3(0.5, 0, 0), Vec3(0.25, 0, 0)});
    EXPECT_EQ(q[0], Vec3(0.5, 0, 0));
    EXPECT_FALSE(isDefined(q[1]));
}

TEST(CompositeMaps, ScaledByOneIsTheWholeToTheBit) {
    const auto p = randomPoints(kUnit, 1000);
    EXPECT_EQ(mappedBy(*scaled(number(1), wave()), p), mappedBy(*wave(), p));
    const auto q = mappedBy(*scaled(number(1), halfSpace({1, 0, 0})), {Vec3(0.5, 0, 0), Vec3(-0.5, 0, 0)});
    EXPECT_FALSE(isDefined(q[0]));
    EXPECT_EQ(q[1], Vec3(0.5, 0, 0));
}

TEST(CompositeMaps, UndefinedWhereTheFactorIs) {
    const FieldPtr bounded =
        std::make_shared<FunctionField>([](const Vec3&) { return 0.5; }, [](const Vec3&) { return Vec3(0); },
                                        Interval{0.5, 0.5}, Box3{Vec3(0), Vec3(1)});
    const std::vector<Vec3> p{Vec3(0.5), Vec3(-0.5)};
    for (const TransferPtr& map : {scaled(bounded, wave()), blend(bounded, wave(), wave())}) {
        const auto q = mappedBy(*map, p);
        EXPECT_TRUE(isDefined(q[0]));
        EXPECT_FALSE(isDefined(q[1]));
    }
}

TEST(CompositeMaps, TwoHalvesMakeAWhole) {
    const auto p = randomPoints(kUnit, 1000);
    const auto half = scaled(number(0.5), wave());
    EXPECT_LT(largestDifference(mappedBy(*sum({half, half}), p), mappedBy(*wave(), p)), 1e-15);
}

TEST(CompositeMaps, DisplacementsAddUp) {
    const auto map = sum({translation({1, 0, 0}), translation({0, 2, 0}), translation({0, 0, 3})});
    EXPECT_EQ(mappedBy(*map, {Vec3(0)})[0], Vec3(-1, -2, -3));
    EXPECT_FALSE(isDefined(mappedBy(*sum({wave(), halfSpace(Vec3(0))}), {Vec3(0.5, 0, 0)})[0]));
}

TEST(CompositeMaps, UnionTakesTheLargerIntersectionTheSmallerTheFirstOnATie) {
    const auto small = translation({-0.1, 0, 0}), large = translation({0, -0.3, 0}), tied = translation({0, 0, 0.3});
    const Vec3 p(0.1, 0.2, 0.3);
    const auto at = [&](const TransferPtr& map) { return mappedBy(*map, {p})[0]; };
    EXPECT_EQ(at(chosen(Choice::Larger, {small, large, tied})), at(large));
    EXPECT_EQ(at(chosen(Choice::Larger, {small, tied, large})), at(tied)) << "the first on a tie";
    EXPECT_EQ(at(chosen(Choice::Smaller, {tied, large, small})), at(small));
    EXPECT_EQ(at(chosen(Choice::Smaller, {tied, large})), at(tied)) << "the first on a tie";
    for (const Choice choice : {Choice::Larger, Choice::Smaller})
        EXPECT_FALSE(isDefined(mappedBy(*chosen(choice, {small, halfSpace(Vec3(0))}), {Vec3(0.5, 0, 0)})[0]))
            << "undefined if any is";
}

TEST(CompositeMaps, BlendGoesFromTheFirstToTheSecond) {
    const auto p = randomPoints(kUnit, 100);
    const auto a = wave(), b = turn(40);
    EXPECT_EQ(mappedBy(*blend(number(0), a, b), p), mappedBy(*a, p));
    EXPECT_EQ(mappedBy(*blend(number(1), a, b), p), mappedBy(*b, p));
    const auto qa = mappedBy(*a, p), qb = mappedBy(*b, p), q = mappedBy(*blend(xField(), a, b), p);
    for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_LT(glm::length(q[i] - ((1 - p[i].x) * qa[i] + p[i].x * qb[i])), 1e-14);
    EXPECT_FALSE(isDefined(mappedBy(*blend(number(0), a, halfSpace(Vec3(0))), {Vec3(0.5)})[0]))
        << "undefined if any operand is, whatever its weight";
}

TEST(CompositeMaps, UndefinedPointsStayUndefinedAndTurnNothing) {
    for (const auto& [name, map] : everyKind()) {
        const std::vector<Vec3> p{kUndefined};
        std::vector<Mat3> jacobian(1, Mat3(7));
        map->jacobian(p, jacobian);
        EXPECT_FALSE(isDefined(mappedBy(*map, p)[0])) << name;
        EXPECT_EQ(jacobian[0], Mat3(1)) << name;
    }
    std::vector<Mat3> jacobian(1);
    const std::vector<Vec3> hidden{Vec3(0.5)};
    for (const TransferPtr& map :
         {scaled(number(0.5), halfSpace(Vec3(0))), sum({wave(), halfSpace(Vec3(0))}),
          sequence({wave(), halfSpace(Vec3(0))}), blend(number(0.5), wave(), halfSpace(Vec3(0))),
          chosen(Choice::Larger, {wave(), halfSpace(Vec3(0))})}) {
        map->jacobian(hidden, jacobian);
        EXPECT_EQ(jacobian[0], Mat3(1));
    }
}

TEST(CompositeMaps, PointsMayBeMappedInPlace) {
    for (const auto& [name, map] : everyKind()) {
        const auto p = randomPoints(kUnit, 200);
        std::vector<Vec3> apart(p.size());
        map->map(p, apart);
        EXPECT_EQ(largestDifference(mappedBy(*map, p), apart), 0) << name;
    }
}

TEST(CompositeMaps, JacobiansAreThoseOfFiniteDifferences) {
    const auto p = randomPoints({Vec3(-0.9), Vec3(-0.1)}, 300);
    for (const auto& [name, map] : everyKind()) {
        // Cells interpolate Jacobians between their vertices (README.md), which differences of points do not show;
        // the choice between two displacements jumps.
        if (name.find("cells") != std::string::npos || name == "nested" || name == "union" || name == "intersection")
            continue;
        EXPECT_LT(jacobianError(*map, p), 1e-8) << name;
    }
}

TEST(CompositeMaps, AChoiceHasTheJacobianOfTheOneChosen) {
    const auto p = randomPoints(kUnit, 500);
    const auto a = wave(), b = turn(5), larger = chosen(Choice::Larger, {a, b});
    std::vector<Mat3> ja(p.size()), jb(p.size()), j(p.size());
    a->jacobian(p, ja);
    b->jacobian(p, jb);
    larger->jacobian(p, j);
    const auto qa = mappedBy(*a, p), qb = mappedBy(*b, p);
    int first = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const bool isFirst = glm::length(qa[i] - p[i]) >= glm::length(qb[i] - p[i]);
        EXPECT_EQ(j[i], isFirst ? ja[i] : jb[i]);
        first += isFirst;
    }
    EXPECT_GT(first, 50);
    EXPECT_LT(first, 480);
}

TEST(CompositeMaps, SourceBoxesHoldAllImages) {
    for (const auto& [name, map] : everyKind())
        for (unsigned n = 0; n < 60; ++n) {
            const Vec3 corner = randomPoints(kUnit, 1, n)[0];
            const double side = 0.01 * double(1 + n % 30);
            EXPECT_EQ(straySources(*map, {corner, corner + side}, n), 0) << name << " " << n;
        }
}

TEST(CompositeMaps, SourceBoxesAreNotCalledWhereNothingIsDefined) {
    const Box3 hidden{Vec3(0.2), Vec3(0.3)};
    const auto any = [](const Box3&) { return true; };
    EXPECT_FALSE(sum({wave(), halfSpace(Vec3(0))})->anySourceBox(hidden, any));
    EXPECT_FALSE(chosen(Choice::Smaller, {wave(), halfSpace(Vec3(0))})->anySourceBox(hidden, any));
    EXPECT_FALSE(blend(number(0.5), wave(), halfSpace(Vec3(0)))->anySourceBox(hidden, any));
    EXPECT_FALSE(sequence({wave(), halfSpace(Vec3(0))})->anySourceBox(hidden, any));
    EXPECT_FALSE(scaled(number(0.5), halfSpace(Vec3(0)))->anySourceBox(hidden, any));
    EXPECT_TRUE(scaled(number(0), halfSpace(Vec3(0)))->anySourceBox(hidden, any)) << "the identity there";
}

TEST(CompositeMaps, ImagesLieWithinTheirBox) {
    const Box3 rest{{-0.7, -0.5, -0.9}, {0.8, 0.6, 0.4}};
    const auto around = randomPoints({Vec3(-3), Vec3(3)}, 200000);
    for (const auto& [name, map] : everyKind()) EXPECT_EQ(strayImages(*map, rest, around), 0) << name;
}

TEST(CompositeMaps, ADisplacedBoxIsGrownByTheLargestDisplacement) {
    const Box3 rest{Vec3(0), {1, 2, 3}};
    const auto near = [](const Box3& a, const Box3& b) {
        return glm::length(a.min - b.min) < 1e-12 && glm::length(a.max - b.max) < 1e-12;
    };
    const auto moved = sum({translation({0.3, 0, 0}), translation({0, 0.4, 0})});
    EXPECT_TRUE(near(moved->imageOf(rest), {rest.min - 0.5, rest.max + 0.5}));
    EXPECT_TRUE(near(scaled(number(0.5), moved)->imageOf(rest), {rest.min - 0.25, rest.max + 0.25}));
    EXPECT_EQ(scaled(number(0), moved)->imageOf(rest), rest);
    EXPECT_EQ(scaled(number(1), bulge())->imageOf(kUnit), bulge()->imageOf(kUnit));
    EXPECT_EQ(chosen(Choice::Larger, {bulge(), translation({3, 0, 0})})->imageOf(kUnit),
              join(bulge()->imageOf(kUnit), Box3{{2, -1, -1}, {4, 1, 1}}));
    EXPECT_TRUE(moved->imageOf(Box3{}).empty());
}

TEST(CompositeMaps, WhatIsAffineThroughoutSaysSo) {
    const auto a = turn(30), b = translation({1, 2, 3});
    for (const TransferPtr& map : {sequence({a, b}), scaled(number(0.3), a), sum({a, b}), blend(number(0.2), a, b)}) {
        const auto matrix = map->affine();
        ASSERT_TRUE(matrix);
        const Vec3 p(0.3, -2, 1);
        EXPECT_LT(glm::length(transformPoint(*matrix, p) - mappedBy(*map, {p})[0]), 1e-14);
    }
    EXPECT_FALSE(sequence({a, wave()})->affine());
    EXPECT_FALSE(scaled(xField(), a)->affine());
    EXPECT_EQ(scaled(number(0), wave())->affine(), Mat4(1));
}

}  // namespace
}  // namespace voledit
