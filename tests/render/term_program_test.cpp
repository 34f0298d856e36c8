#include "render/term_program.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/base/error.h"
#include "core/fields/simple_fields.h"
#include "core/objects/attribute_field.h"
#include "core/stf/affine.h"
#include "core/stf/component_field.h"
#include "core/stf/composite_maps.h"
#include "core/stf/field_maps.h"
#include "core/stf/mesh_field.h"
#include "tests/render/render_fixtures.h"
#include "tests/render/term_fixtures.h"
#include "tests/render/term_probe_fixtures.h"

namespace voledit {
namespace {

using namespace test;

const Box3 kUnitBox{Vec3(-1), Vec3(1)}, kAround{Vec3(-1.25), Vec3(1.25)};

TermPtr softBall() {
    return solid(SphereShape{Vec3(0.2, 0, 0), 0.7}, {1, 0.5, 0.25}, 0.3, "0.3 + 0.5 * r");
}
TermPtr softBox() {
    return solid(BoxShape{Vec3(-0.9, -0.5, -0.8), Vec3(0.4, 0.5, 0.9)}, {0.2, 0.4, 0.9}, 0.2, "0.9 - 0.3 * abs(z)");
}
TermPtr waves(Interpolation interpolation = Interpolation::Linear) {
    return makeVolumeTerm(wavesVolume(24), 0, softAppearance(), interpolation);
}
/// Colour and opacity everywhere: what a map does to it is seen.
TermPtr marked() {
    return makeFieldsTerm({expression("0.5 + 0.2 * sin(3*x) * cos(2*y) + 0.2 * z"),
                           {expression("0.5 + 0.3 * x"), expression("0.5 + 0.3 * y"), expression("0.5 + 0.3 * z")},
                           {Vec3(-1.6), Vec3(1.6)},
                           {{"heat", expression("x + y * z")}}});
}

TEST(TermProgram, Solids) {
    expectParity(softBall());
    expectParity(softBox());
    expectParity(solid(CylinderShape{{-0.5, 0, -1}, {0.5, 0.3, 1}, 0.4}, {1, 1, 0}, 0.2));
    expectParity(solid(CapsuleShape{{-0.5, 0, -1}, {0.5, 0.3, 1}, 0.4}, {1, 1, 0}, 0.2));
    expectParity(solid(TorusShape{{0, 0.1, 0}, {1, 1, 2}, 1, 0.4}, {1, 0, 1}, 0.1));
    expectParity(solid(TextShape{"Vol", 1, 0.5}, {0.5, 1, 1}, 0.1));
    expectParity(
        solid(DistanceShape{{"sqrt(x^2 + y^2 + z^2) - 0.8 - 0.1 * sin(8 * x)", ""}, kUnitBox}, {1, 1, 1}, 0.1));
}

TEST(TermProgram, SolidsFarFromTheOrigin) {
    const TermPtr far =
        through(std::make_shared<AffineMap>(placementMatrix({4000, -2500, 900}, {0.3, 0.2, 1}, Vec3(2))),
                makeCvgTerm(CvgOperator::Union, {softBall(), softBox()}));
    // The solid itself stands near 0, thousands of its sizes from the program's origin.
    ParityLimits limits;
    limits.opacity = limits.color = 5e-3;
    limits.gradient = 1e-2;
    expectParity(far, limits);
}

TEST(TermProgram, Volumes) {
    expectParity(waves());
    expectParity(waves(Interpolation::Cubic), {.opacity = 2e-4, .color = 2e-4});
    expectParity(waves(Interpolation::Nearest), {.outliers = 0.004});
    TransferFunction steep = softAppearance();
    steep.gradientOpacity.points = {{0, 0}, {1000, 0.2}, {3000, 1}};
    expectParity(makeVolumeTerm(wavesVolume(24), 0, steep), {.opacity = 3e-4});
    const auto holed = sampled(Index3(24), [](const Vec3& p) { return p.x > 0.3 ? kNaN : 800.0 * p.y; });
    expectParity(makeVolumeTerm(holed, 0, softAppearance()), {.gradient = 2e-3, .outliers = 0.03});
}

TEST(TermProgram, Fields) {
    expectParity(marked());
    const auto field = [](const FieldPtr& opacity) {
        return makeFieldsTerm({opacity, {expression("0.5"), expression("x"), expression("y")}, kUnitBox, {}});
    };
    PiecewiseLinear table;
    table.points = {{-0.5, 0.1}, {0.1, 0.7}, {0.4, 0.2}, {0.9, 0.9}};
    expectParity(field(std::make_shared<MapField>(table, expression("x * y + z"))),
                 {.opacity = 3e-4, .outliers = 0.01});
    expectParity(
        field(std::make_shared<VolumeField>(sampled(Index3(9), [](const Vec3& p) { return 0.4 + 0.3 * p.x; }), 0)));
    expectParity(field(std::make_shared<AttributeField>("opacity", softBall())), {.gradient = 1e-2, .outliers = 0.02});
    expectParity(field(std::make_shared<AttributeField>("g", marked())), {.gradient = 1e-2});
    expectParity(field(std::make_shared<AttributeField>("heat", marked())), {.gradient = 1e-2});
    expectParity(field(std::make_shared<AttributeField>("heat", through(library("twist", kUnitBox), marked()))),
                 {.gradient = 1e-2});
    expectParity(field(std::make_shared<ComponentField>(library("twist", kUnitBox), 0, false)));
    expectParity(field(std::make_shared<ComponentField>(library("bend", kUnitBox), 2, true)), {.outliers = 0.01});
    // Undefined colour and opacity is nothing.
    expectParity(makeFieldsTerm(
        {expression("sqrt(x)"), {expression("sqrt(y)"), expression("0.3"), expression("z")}, kUnitBox, {}}));
}

class LibraryMap : public testing::TestWithParam<std::string> {};
TEST_P(LibraryMap, IsAsOnTheCpu) {
    ParityLimits limits;
    limits.outliers = 0.005;  // cuts
    limits.box = kAround;
    expectParity(through(library(GetParam(), kUnitBox), marked()), limits);
    expectParity(through(library(GetParam(), kUnitBox, {}, 0.4), marked()), limits);
}
INSTANTIATE_TEST_SUITE_P(All, LibraryMap,
                         testing::Values("affine", "bend", "deflect", "dissect", "insideOut", "open", "rotationalSweep",
                                         "split", "squeeze", "taper", "twist"));

TEST(TermProgram, MapsOfMaps) {
    const TransferPtr twist = library("twist", kUnitBox), bend = library("bend", kUnitBox),
                      split = library("split", kUnitBox), taper = library("taper", kUnitBox);
    const FieldPtr weight = expression("0.5 + 0.4 * sin(x)");
    const ParityLimits limits{.outliers = 0.005, .box = kAround};
    const auto check = [&](TransferPtr map) { expectParity(through(map, marked()), limits); };
    check(std::make_shared<SequenceMap>(std::vector{twist, split, bend}));
    check(std::make_shared<ScaledMap>(weight, twist));
    check(std::make_shared<ScaledMap>(std::make_shared<ConstantField>(0), split));
    check(std::make_shared<ScaledMap>(expression("max(x, 0)"), split));
    check(std::make_shared<SumMap>(std::vector{twist, bend, split}));
    check(std::make_shared<ChosenMap>(ChosenMap::Choice::Larger, std::vector{twist, bend, taper}));
    check(std::make_shared<ChosenMap>(ChosenMap::Choice::Smaller, std::vector{twist, split, bend}));
    check(std::make_shared<BlendedMap>(weight, twist, bend));
    const std::array<FieldPtr, 3> fields{expression("0.2 * sin(y)"), expression("0.2 * sqrt(1 - x)"),
                                         expression("0.1 * x * y")};
    check(std::make_shared<FieldsMap>(fields, true, Outside::Keep));
    check(std::make_shared<FieldsMap>(fields, true, Outside::Hide));
    check(std::make_shared<FieldsMap>(
        std::array<FieldPtr, 3>{expression("y"), expression("x"), expression("z * (1 + 0.2 * x)")}, false,
        Outside::Hide));
}

TEST(TermProgram, ForwardMapsAnywhere) {
    ParityLimits limits;
    limits.outliers = 0.004;
    const TransferPtr bent = bentLattice(kUnitBox), twist = library("twist", kUnitBox);
    expectParity(through(bent, marked()), limits);
    expectParity(through(twist, through(bent, marked())), limits);
    expectParity(through(bent, through(twist, through(bent, marked()))), limits);
    expectParity(through(std::make_shared<SequenceMap>(std::vector{bent, twist}), marked()), limits);
    expectParity(through(std::make_shared<ScaledMap>(expression("0.5 + 0.5 * x"), bent), marked()), limits);
    Lattice lattice = bentLattice({Vec3(-0.6), Vec3(0.7)})->lattice();
    expectParity(through(std::make_shared<LatticeMap>(lattice, Index3(8), Outside::Keep), marked()), limits);
    expectParity(
        makeCvgTerm(CvgOperator::Difference, {through(bent, marked()), through(restLattice(kUnitBox), softBall())}),
        limits);
}

TEST(TermProgram, FoldedMapsCombineTheirPreImages) {
    for (const Combine combine : {Combine::Union, Combine::Merge, Combine::Intersection, Combine::First}) {
        const TermPtr folded = through(foldedLattice(kUnitBox), marked(), combine);
        expectParity(folded, {.outliers = 0.005});
        expectParity(through(library("twist", kUnitBox), folded), {.outliers = 0.005});
    }
}

class EachOperator : public testing::TestWithParam<CvgOperator> {};
TEST_P(EachOperator, IsAsOnTheCpu) {
    const FieldPtr weight = GetParam() == CvgOperator::Blend ? expression("0.5 + 0.3 * sin(4 * x)") : nullptr;
    const TermPtr ball = softBall(), box = softBox();
    ParityLimits limits;
    limits.box = kUnitBox;
    limits.visible = 0.02;
    limits.outliers = 0.005;  // along seams, where one operand takes over
    expectParity(makeCvgTerm(GetParam(), {ball, box}, weight), limits);
    expectParity(makeCvgTerm(GetParam(), {marked(), ball}, weight), limits);
    if (!weight) expectParity(makeCvgTerm(GetParam(), {box, marked(), ball}), limits);
}
INSTANTIATE_TEST_SUITE_P(All, EachOperator,
                         testing::Values(CvgOperator::Union, CvgOperator::Intersection, CvgOperator::Difference,
                                         CvgOperator::Merge, CvgOperator::Cap, CvgOperator::Trim, CvgOperator::Blend));

TEST(TermProgram, Recoloring) {
    ColorTable color;
    color.points = {{0, {1, 0, 0}}, {0.5, {0, 1, 0}}, {1, {0, 0, 1}}};
    PiecewiseLinear opacity;
    opacity.points = {{0, 0.1}, {0.6, 0.9}};
    const ParityLimits limits{.opacity = 3e-4, .color = 6e-4, .outliers = 0.005};
    for (const std::string from : {"opacity", "r", "heat", "scalar"})
        expectParity(makeRecolorTerm({from, color, opacity, marked()}), limits);
    ColorTable wide;
    wide.points = {{0, {1, 0, 0}}, {1000, {0, 0, 1}}};
    expectParity(
        makeRecolorTerm({"scalar", wide, std::nullopt, makeCvgTerm(CvgOperator::Union, {waves(), softBall()})}),
        limits);
    expectParity(
        makeRecolorTerm({"heat", color, std::nullopt, makeRecolorTerm({"g", std::nullopt, opacity, marked()})}),
        limits);
}

TEST(TermProgram, Meshes) {
    MeshData data;
    const MappedCells::Data grid = gridCells(frameOf(kUnitBox), Index3(5));
    data.points = grid.deformed;
    data.hexahedra = grid.hexahedra;
    for (Vec3& p : data.points) {
        p.x += 0.1 * p.y * p.z;
        data.values.push_back(float(500 + 300 * p.x * p.y + 200 * p.z));
    }
    const auto field = std::make_shared<MeshField>(std::make_shared<Mesh>(data), 0);
    expectParity(makeMeshTerm(field, softAppearance()), {.outliers = 0.005});
    expectParity(through(library("twist", kUnitBox), makeMeshTerm(field, softAppearance())), {.outliers = 0.005});
}

/// Largest angle, degrees, between a program's gradient and central differences of core's opacity, at points of the
/// unit box away from where the opacity jumps.
double largestNormalError(const TermPtr& term) {
    const double h = 1e-5;
    std::vector<Vec3> around;
    const std::vector<Vec3> p = pointsIn(kUnitBox, 4000);
    for (const Vec3& at : p)
        for (int n = 0; n < 6; ++n) {
            around.push_back(at);
            around.back()[n / 2] += n % 2 ? h : -h;
        }
    std::vector<ObjectSample> samples(around.size());
    sample(*term, around, samples, false);
    const Probed got = probed(term, p);
    double largest = 0;
    int compared = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        Vec3 slope;
        bool smooth = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const double before = samples[6 * i + 2 * a].opacity, after = samples[6 * i + 2 * a + 1].opacity;
            smooth = smooth && before > 0 && after > 0 && std::abs(after - before) < 100 * h;
            slope[int(a)] = (after - before) / (2 * h);
        }
        const Vec3 gradient = got.lit[i].normalGradient;
        // Where it is all but flat, single precision has no direction.
        if (!smooth || glm::length(slope) < 0.02 || glm::length(gradient) == 0) continue;
        ++compared;
        const double cosine = glm::dot(slope, gradient) / (glm::length(slope) * glm::length(gradient));
        largest = std::max(largest, glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
    EXPECT_GT(compared, 300);
    return largest;
}

TEST(TermProgram, NormalsAreThoseOfTheDeformedField) {
    double largest = 0;
    for (const std::string name : {"affine", "bend", "dissect", "deflect", "insideOut", "open", "rotationalSweep",
                                   "split", "squeeze", "taper", "twist"})
        largest = std::max(largest, largestNormalError(through(library(name, kUnitBox), marked())));
    EXPECT_LT(largest, 0.01);
    const TermPtr twice = through(library("bend", kUnitBox), through(library("twist", kUnitBox), marked()));
    EXPECT_LT(largestNormalError(twice), 0.01);
    // Cells interpolate the Jacobians of their vertices, so that shading shows no facets: less than the map's own
    // facets.
    const double cells = largestNormalError(through(bentLattice(kUnitBox, Index3(16)), marked()));
    EXPECT_LT(cells, 5);
    std::printf("normals: formulas within %.4f degrees, cells within %.2f\n", largest, cells);
}

TEST(TermProgram, TextDependsOnStructureOnly) {
    const auto made = [](double angle, double radius, const std::string& formula, double weight) {
        const TermPtr ball = solid(SphereShape{Vec3(radius, 0, 0), radius}, Vec3(radius), radius, formula);
        const TermPtr both = makeCvgTerm(CvgOperator::Blend, {ball, waves()}, std::make_shared<ConstantField>(weight));
        return makeTermProgram(through(library("twist", {Vec3(-radius), Vec3(2)}, {{"angle", number(angle)}}), both))
            .text;
    };
    EXPECT_EQ(made(30, 0.5, "0.5", 0.1), made(-77, 1.25, "0.5", 0.9));
    EXPECT_NE(made(30, 0.5, "0.5", 0.1), made(30, 0.5, "0.5 * r", 0.1));
}

TEST(TermProgram, SharedNodesAreWrittenOnce) {
    const TermPtr ball = softBall();
    const auto sizeOf = [](const TermPtr& term) { return makeTermProgram(term).text.size(); };
    const TermPtr twice = makeCvgTerm(CvgOperator::Union, {ball, ball});
    EXPECT_LT(sizeOf(makeCvgTerm(CvgOperator::Union, {twice, twice})), sizeOf(twice) + 400);
}

TEST(TermProgram, WhatIsTooLargeSaysToUseRays) {
    const auto messageOf = [](const TermPtr& term) -> std::string {
        try {
            makeTermProgram(term);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    // Doubled again and again: small as a graph, endless when put in place.
    TermPtr doubled = softBall();
    for (int n = 0; n < 30; ++n) doubled = makeCvgTerm(CvgOperator::Union, {doubled, doubled});
    EXPECT_THAT(messageOf(doubled), testing::HasSubstr("--renderer rays"));
    TermPtr deep = softBall();
    const TransferPtr same = library("twist", kUnitBox);
    for (int n = 0; n < 10'000; ++n) deep = through(same, deep);
    EXPECT_THAT(messageOf(deep), testing::HasSubstr("--renderer rays"));
}

}  // namespace
}  // namespace voledit
