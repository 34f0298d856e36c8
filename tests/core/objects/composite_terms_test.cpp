#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/objects/cvg.h"
#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

constexpr CvgOperator kAll[]{CvgOperator::Union, CvgOperator::Intersection, CvgOperator::Difference, CvgOperator::Merge,
                             CvgOperator::Cap,   CvgOperator::Trim,         CvgOperator::Blend};

FieldPtr weight() {
    return expression("0.5 + 0.4*x");
}

TermPtr made(CvgOperator by, std::vector<TermPtr> of) {
    return makeCvgTerm(by, std::move(of), by == CvgOperator::Blend ? weight() : nullptr);
}

TermPtr volume() {
    TransferFunction look = greyRamp(0, 2);
    look.color.points = {{0, Vec3(0, 0, 1)}, {2, Vec3(1, 1, 0)}};
    const auto values = sampledVolume(21, [](const Vec3& p) { return 1.2 - glm::length(p - Vec3(0.2)); });
    return makeTransferTerm(std::make_shared<AffineMap>(placementMatrix({0.1, 0, 0}, {0.3, 0.2, 0.1}, Vec3(1.1))),
                            makeVolumeTerm(values, 0, look), Combine::Union, "", TransferRole::Place);
}

/// A volume of another grid, a solid with a soft rim, an object of fields with a named attribute.
std::vector<TermPtr> operands() {
    const auto other = sampledVolume(13, [](const Vec3& p) { return 1 + p.x * p.y - p.z; });
    return {volume(), solid(SphereShape{{0, 0, 0}, 0.7}, {1, 0, 0}, "0.4 + 0.3*z", 0.4),
            fields("0.5 - 0.5*x*y", {0, 1, 0}, {{"density", expression("x + y")}}),
            makeVolumeTerm(other, 0, greyRamp(0, 3))};
}

void expectSame(const ObjectSample& a, const ObjectSample& b) {
    EXPECT_EQ(a.opacity, b.opacity);
    if (a.opacity > 0) {
        EXPECT_EQ(a.color, b.color);
        EXPECT_EQ(a.normalGradient, b.normalGradient);
    }
    EXPECT_TRUE(a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) << a.value << " " << b.value;
}

TEST(CvgTerm, CombinesWhatItsOperandsAreAtEachPoint) {
    const auto of = operands();
    const auto p = randomPoints(2500, 1.2);
    std::vector<double> w(p.size());
    weight()->sample(p, w);
    for (std::size_t first = 0; first < of.size(); ++first)
        for (std::size_t second = 0; second < of.size(); ++second) {
            const auto a = sampled(of[first], p, true), b = sampled(of[second], p, true);
            for (const CvgOperator by : kAll) {
                const auto found = sampled(made(by, {of[first], of[second]}), p, true);
                for (std::size_t i = 0; i < p.size(); ++i) expectSame(found[i], cvg(by, a[i], b[i], w[i]));
            }
        }
}

TEST(CvgTerm, AListIsCombinedFromLeftToRight) {
    const auto of = operands();
    const auto p = randomPoints(1500, 1.2);
    for (const CvgOperator by : kAll) {
        if (by == CvgOperator::Blend) continue;
        const auto list = sampled(made(by, of), p, true);
        const auto nested = sampled(made(by, {made(by, {made(by, {of[0], of[1]}), of[2]}), of[3]}), p, true);
        for (std::size_t i = 0; i < p.size(); ++i) expectSame(list[i], nested[i]);
    }
}

TEST(CvgTerm, MergesAreNotAssociative) {
    const auto of = operands();
    const auto left = made(CvgOperator::Merge, {made(CvgOperator::Merge, {of[0], of[1]}), of[2]});
    const auto right = made(CvgOperator::Merge, {of[0], made(CvgOperator::Merge, {of[1], of[2]})});
    double largest = 0;
    const auto p = randomPoints(500, 0.6);
    const auto a = sampled(left, p), b = sampled(right, p);
    for (std::size_t i = 0; i < p.size(); ++i) largest = std::max(largest, glm::distance(a[i].color, b[i].color));
    EXPECT_GT(largest, 0.01);
}

TEST(CvgTerm, WithoutAnAttributeAskedForNothingVisibleChanges) {
    const auto of = operands();
    const auto p = randomPoints(1500, 1.2);
    for (const CvgOperator by : kAll) {
        const auto term = made(by, {of[1], of[0]});
        const auto with = sampled(term, p, true), without = sampled(term, p, true, "");
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_EQ(with[i].opacity, without[i].opacity);
            if (with[i].opacity == 0) continue;
            EXPECT_EQ(with[i].color, without[i].color);
            EXPECT_EQ(with[i].normalGradient, without[i].normalGradient);
        }
    }
}

TEST(CvgTerm, BoundsAreThoseOfTheDefinitions) {
    const auto left = solid(BoxShape{{-1, -1, -1}, {0.5, 0.5, 0.5}}, Vec3(1), "1");
    const auto right = solid(BoxShape{{-0.2, 0, 0.1}, {2, 2, 2}}, Vec3(1), "1");
    const Box3 joined = join(left->bounds, right->bounds), common = intersect(left->bounds, right->bounds);
    for (const CvgOperator by : {CvgOperator::Union, CvgOperator::Merge, CvgOperator::Blend})
        EXPECT_EQ(made(by, {left, right})->bounds, joined);
    EXPECT_EQ(made(CvgOperator::Intersection, {left, right})->bounds, common);
    for (const CvgOperator by : {CvgOperator::Difference, CvgOperator::Cap, CvgOperator::Trim})
        EXPECT_EQ(made(by, {left, right})->bounds, left->bounds);
    EXPECT_EQ(made(CvgOperator::Union, {left, right, volume()})->bounds, join(joined, volume()->bounds));
}

TEST(TransferTerm, OfAUnionIsTheUnionOfTheTransfers) {
    const auto of = operands();
    const auto p = randomPoints(2000, 1.4);
    for (const bool folded : {false, true}) {
        const auto map = bentLattice(folded ? 1.5 : 0.3, 6);
        ASSERT_EQ(map->cells()->mayOverlap(), folded);
        const auto through = [&](const TermPtr& term) { return makeTransferTerm(map, term, Combine::Union, ""); };
        for (const CvgOperator by : kAll) {
            // Pre-images of a fold join by union, which is a union's own rule only.
            if (folded && by != CvgOperator::Union) continue;
            if (by == CvgOperator::Blend) continue;  // its weight is a field of the deformed space
            const auto whole = sampled(through(made(by, of)), p, true);
            std::vector<TermPtr> moved;
            for (const TermPtr& term : of) moved.push_back(through(term));
            const auto parts = sampled(made(by, moved), p, true);
            for (std::size_t i = 0; i < p.size(); ++i) {
                EXPECT_EQ(whole[i].opacity, parts[i].opacity);
                if (whole[i].opacity == 0 || folded) continue;
                EXPECT_EQ(whole[i].color, parts[i].color);
                EXPECT_LT(glm::distance(whole[i].normalGradient, parts[i].normalGradient),
                          1e-9 * (1 + glm::length(parts[i].normalGradient)));
            }
        }
    }
}

TEST(TransferTerm, TurnsTheNormalsOfEveryKindOfObject) {
    const auto map = std::make_shared<AffineMap>(placementMatrix({0.1, 0.2, 0.3}, {0.4, -0.8, 1.2}, {2, 0.7, 1.3}));
    for (const TermPtr& object : operands()) {
        const auto term = makeTransferTerm(map, object, Combine::Union, "");
        for (const Vec3& q : randomPoints(100, 0.5)) {
            const auto rest = sampled(object, {q}, true)[0];
            const auto moved = sampled(term, {transformPoint(map->worldFromRest(), q)}, true)[0];
            const Vec3 expected = glm::transpose(glm::inverse(Mat3(map->worldFromRest()))) * rest.normalGradient;
            EXPECT_LT(glm::distance(moved.normalGradient, expected), 1e-6 * (1 + glm::length(expected)));
        }
    }
}

TEST(RecolorTerm, ColourAndOpacityFollowTheAttribute) {
    const ColorTable color{{{0, Vec3(0)}, {1, Vec3(1, 0.5, 0.25)}}};
    const PiecewiseLinear opacity{{{0, 0.1}, {1, 0.6}}};
    const auto p = randomPoints(1500, 1.2);
    const auto attributed =
        fields("x", {0.2, 0.4, 0.6}, {{"density", expression("y*z")}, {"nothing", expression("sqrt(-1)")}});
    struct Case {
        TermPtr of;
        const char* from;
        std::function<double(const Vec3&, const ObjectSample&)> value;
    };
    const std::vector<Case> cases{
        {operands()[0], "opacity", [](const Vec3&, const ObjectSample& s) { return s.opacity; }},
        {operands()[0], "r", [](const Vec3&, const ObjectSample& s) { return s.color.r; }},
        {operands()[0], "b", [](const Vec3&, const ObjectSample& s) { return s.color.b; }},
        {operands()[0], "scalar", [](const Vec3&, const ObjectSample& s) { return s.value; }},
        {attributed, "g", [](const Vec3&, const ObjectSample& s) { return s.color.g; }},
        {attributed, "density", [](const Vec3& at, const ObjectSample&) { return at.y * at.z; }},
        {attributed, "nothing", [](const Vec3&, const ObjectSample&) { return kNaN; }},
        {attributed, "unknown", [](const Vec3&, const ObjectSample&) { return kNaN; }}};
    for (const Case& c : cases) {
        const auto before = sampled(c.of, p, true);
        const auto both = sampled(makeRecolorTerm({c.from, color, opacity, c.of}), p, true);
        const auto onlyColor = sampled(makeRecolorTerm({c.from, color, std::nullopt, c.of}), p, true);
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double value = c.value(p[i], before[i]);
            const bool changes = before[i].opacity > 0 && !std::isnan(value);
            EXPECT_EQ(both[i].opacity, changes ? opacity(value) : before[i].opacity) << c.from;
            EXPECT_EQ(both[i].color, changes ? color(value) : before[i].color) << c.from;
            EXPECT_EQ(onlyColor[i].opacity, before[i].opacity);
            EXPECT_EQ(onlyColor[i].color, both[i].color);
            EXPECT_EQ(both[i].normalGradient, before[i].normalGradient);
            EXPECT_TRUE(both[i].value == before[i].value || std::isnan(before[i].value)) << "the scalar stays";
        }
    }
}

TEST(RecolorTerm, WorksOnWhatComesFromBelowCompositesAndTransfers) {
    const auto density = fields("0.5", Vec3(1), {{"density", expression("x")}});
    const auto map = std::make_shared<AffineMap>(placementMatrix({0.5, 0, 0}, Vec3(0), Vec3(1)));
    const auto moved = makeTransferTerm(map, density, Combine::Union, "");
    const auto united = makeCvgTerm(CvgOperator::Union, {solid(SphereShape{{0, 0, 0}, 0.2}, Vec3(0), "0.2"), moved});
    const auto term = makeRecolorTerm({"density", ColorTable{{{-1, Vec3(0)}, {1, Vec3(1)}}}, std::nullopt, united});
    EXPECT_NEAR(sampled(term, {Vec3(0.7, 0.5, 0)})[0].color.r, 0.6, 1e-12) << "density 0.2 stood at x = 0.2";
    EXPECT_NEAR(sampled(term, {Vec3(0.1, 0, 0)})[0].color.r, 0.3, 1e-12) << "the larger opacity's attribute";
    EXPECT_NEAR(sampled(term, {Vec3(0.1, 0, 0)}, false, "density")[0].value, -0.4, 1e-12);
    EXPECT_TRUE(std::isnan(sampled(term, {Vec3(0.1, 0, 0)})[0].value));
}

TEST(RecolorTerm, NestsWithDifferentAttributes) {
    const auto base = fields("0.5", {0.1, 0.2, 0.3}, {{"density", expression("x")}, {"heat", expression("y")}});
    const ColorTable grey{{{0, Vec3(0)}, {1, Vec3(1)}}};
    const auto inner = makeRecolorTerm({"density", grey, std::nullopt, base});
    const auto outer = makeRecolorTerm({"heat", std::nullopt, PiecewiseLinear{{{0, 0}, {1, 1}}}, inner});
    const auto s = sampled(outer, {Vec3(0.3, 0.7, 0)}, true, "density")[0];
    EXPECT_NEAR(s.color.r, 0.3, 1e-15);
    EXPECT_NEAR(s.opacity, 0.7, 1e-15);
    EXPECT_NEAR(s.value, 0.3, 1e-15);
    const auto again = makeRecolorTerm({"r", std::nullopt, PiecewiseLinear{{{0, 0}, {1, 1}}}, outer});
    EXPECT_NEAR(sampled(again, {Vec3(0.3, 0.7, 0)})[0].opacity, 0.3, 1e-15) << "the colour that recolouring gave";
}

TEST(Attributes, EveryObjectHasOpacityAndColour) {
    for (const TermPtr& term : operands()) {
        const auto p = randomPoints(500, 1.2);
        const auto plain = sampled(term, p);
        const auto opacity = sampled(term, p, false, "opacity"), red = sampled(term, p, false, "r"),
                   green = sampled(term, p, false, "g"), blue = sampled(term, p, false, "b");
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_EQ(opacity[i].value, plain[i].opacity);
            if (plain[i].opacity == 0) continue;
            EXPECT_EQ(Vec3(red[i].value, green[i].value, blue[i].value), plain[i].color);
        }
    }
    const auto ball = solid(SphereShape{{0, 0, 0}, 0.5}, {0.25, 0.5, 0.75}, "1");
    EXPECT_EQ(sampled(ball, {Vec3(2)}, false, "b")[0].value, 0.75) << "a solid has its colour everywhere";
    EXPECT_TRUE(std::isnan(sampled(ball, {kUndefined}, false, "opacity")[0].value));
}

/// Angle between a gradient and a direction, degrees.
double angleBetween(const Vec3& gradient, const Vec3& direction) {
    const double cosine = glm::dot(gradient, direction) / (glm::length(gradient) * glm::length(direction));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / kPi;
}

TEST(CvgTerm, HardSolidsAreLitByTheSurfaceThatIsNear) {
    const auto box = solid(BoxShape{Vec3(-1), Vec3(1)}, Vec3(1), "1");
    const auto ball = solid(SphereShape{{1, 0, 0}, 0.7}, Vec3(1), "1");
    const Vec3 center(1, 0, 0), radial = glm::normalize(Vec3(-1, 0.5, 0.3));
    // Just outside the ball, hence in the wall of the hollow; the box's own faces are farther.
    const auto hollow = makeCvgTerm(CvgOperator::Difference, {box, ball});
    const ObjectSample wall = sampled(hollow, {center + 0.71 * radial}, true)[0];
    EXPECT_EQ(wall.opacity, 1);
    EXPECT_LT(angleBetween(wall.normalGradient, radial), 1e-6);
    const ObjectSample face = sampled(hollow, {Vec3(-0.99, 0.5, 0.2)}, true)[0];
    EXPECT_LT(angleBetween(face.normalGradient, Vec3(1, 0, 0)), 1e-6);
    // Just inside the ball: the lens that both share shows the ball's surface there, the box's at x = 1.
    for (const CvgOperator by : {CvgOperator::Intersection, CvgOperator::Cap}) {
        const auto lens = makeCvgTerm(by, {box, ball});
        EXPECT_LT(angleBetween(sampled(lens, {center + 0.69 * radial}, true)[0].normalGradient, -radial), 1e-6);
        EXPECT_LT(angleBetween(sampled(lens, {Vec3(0.99, 0.1, 0)}, true)[0].normalGradient, Vec3(-1, 0, 0)), 1e-6);
    }
    // Composites have surfaces too: a drilled hollow in a union.
    const auto pair = makeCvgTerm(CvgOperator::Union, {ball, solid(SphereShape{{-1, 0, 0}, 0.5}, Vec3(1), "1")});
    const auto drilled = makeCvgTerm(CvgOperator::Difference, {box, pair});
    EXPECT_LT(angleBetween(sampled(drilled, {center + 0.71 * radial}, true)[0].normalGradient, radial), 1e-6);
}

}  // namespace
}  // namespace voledit
