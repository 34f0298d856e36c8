#include "core/objects/term_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/objects/empty_space.h"
#include "core/stf/composite_maps.h"
#include "core/stf/mesh_field.h"
#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

/// Terms of every kind, made at random.
class RandomTerms {
public:
    explicit RandomTerms(unsigned seed) : random_(seed) {}

    TermPtr term(int depth) {
        const int kind = depth == 0 ? pick(6) : pick(12);
        switch (kind) {
            case 0:
                return volume();
            case 1:
                return mesh();
            case 2:
            case 3:
                return someSolid();
            case 4:
            case 5:
                return someFields();
            case 6:
            case 7:
                return moved(term(depth - 1));
            case 8:
                return recoloured(term(depth - 1));
            default:
                break;
        }
        const auto by = CvgOperator(pick(7));
        std::vector<TermPtr> of{term(depth - 1), term(depth - 1)};
        if (by == CvgOperator::Blend) return makeCvgTerm(by, of, expression("0.5 + x"));
        if (pick(3) == 0) of.push_back(term(depth - 1));
        return makeCvgTerm(by, of);
    }

    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    Vec3 point(double reach) {
        const double x = number(-reach, reach), y = number(-reach, reach), z = number(-reach, reach);
        return {x, y, z};
    }

private:
    int pick(int count) { return int(random_() % unsigned(count)); }

    TermPtr volume() {
        const Vec3 at = point(0.6);
        TransferFunction look = constantLook(0, Vec3(1));
        look.opacity.points = {{0, 0}, {0.3, number(0.2, 1)}};
        const auto ball = sampledVolume(15, [&](const Vec3& p) { return 0.4 - glm::length(p - at); });
        return makeVolumeTerm(ball, 0, look, Interpolation(pick(3)));
    }
    TermPtr mesh() {
        MeshData data;
        const auto grid = gridCells(frameOf({Vec3(-0.8), Vec3(0.8)}), {3, 3, 3});
        data.points = grid.source;
        data.hexahedra = grid.hexahedra;
        for (const Vec3& p : data.points) data.values.push_back(float(p.x + 0.3 * p.y));
        TransferFunction look = constantLook(0, Vec3(1));
        look.opacity.points = {{number(-0.3, 0.5), 0}, {0.9, 1}};
        return makeMeshTerm(std::make_shared<MeshField>(std::make_shared<Mesh>(data), 0), look);
    }
    TermPtr someSolid() {
        const Vec3 at = point(0.5);
        const SolidShape shapes[]{SphereShape{at, 0.3},
                                  BoxShape{at - 0.2, at + Vec3(0.3, 0.1, 0.2)},
                                  CylinderShape{at, at + Vec3(0.3, 0.2, 0.4), 0.2},
                                  CapsuleShape{at, at + Vec3(0.3, 0.2, 0.4), 0.1},
                                  TorusShape{at, {0.2, 0.3, 1}, 0.4, 0.1},
                                  DistanceShape{{"sin(5*x) + y*z - 0.3", "", 1, 1}, {Vec3(-0.7), Vec3(0.7)}}};
        const char* const opacities[]{"0.8", "-4*d", "0.5 - r", "sqrt(x)", "x > y", "-d/(d - d)", "0"};
        return solid(shapes[pick(6)], Vec3(1), opacities[pick(7)], pick(2) ? 0.2 : 0);
    }
    TermPtr someFields() {
        const char* const opacities[]{
            "0.6 - length(x, y, z)", "sin(8*x) - 0.7", "sqrt(x - 0.5)", "x/y - 3", "log(x)", "1"};
        return fields(opacities[pick(6)], Vec3(1), {{"density", expression("x - y")}});
    }
    TermPtr moved(const TermPtr& of) {
        const auto place = std::make_shared<AffineMap>(placementMatrix(point(0.3), point(1), Vec3(1.1, 0.8, 0.9)));
        const std::vector<TransferPtr> maps{
            place, bentLattice(number(0.1, 0.4), 4), bentLattice(1.5, 4),
            std::make_shared<SequenceMap>(std::vector<TransferPtr>{place, bentLattice(0.2, 4)})};
        return makeTransferTerm(maps[std::size_t(pick(4))], of, Combine(pick(4)), "");
    }
    TermPtr recoloured(const TermPtr& of) {
        const char* const names[]{"opacity", "r", "scalar", "density"};
        const PiecewiseLinear tables[]{{{{0.5, 0}, {1, 1}}}, {{{0, 1}, {0.3, 0}}}, {{{0, 0}}}};
        return makeRecolorTerm({names[pick(4)], std::nullopt, tables[pick(3)], of});
    }

    std::mt19937 random_;
};

TEST(TermBounds, WhatIsProvedEmptyIsEmpty) {
    int empty = 0, visible = 0;
    for (unsigned seed = 1; seed <= 150; ++seed) {
        RandomTerms make(seed);
        const TermPtr term = make.term(int(seed % 4));
        for (int n = 0; n < 40; ++n) {
            const Vec3 corner = make.point(1.2);
            const Box3 box{corner, corner + make.number(0.02, 0.3) * Vec3(1, make.number(0.5, 1), make.number(0.5, 1))};
            std::vector<Vec3> p;
            for (int m = 0; m < 60; ++m)
                p.push_back(box.min +
                            (m < 8 ? Vec3(m & 1, m >> 1 & 1, m >> 2) : 0.5 + 0.5 * make.point(1)) * box.size());
            const auto samples = sampled(term, p);
            const bool seen = std::any_of(samples.begin(), samples.end(), [](const auto& s) { return s.opacity > 0; });
            const bool possible = mayBeVisible(*term, box);
            EXPECT_TRUE(possible || !seen) << "seed " << seed;
            empty += !possible;
            visible += seen;
        }
    }
    EXPECT_GT(empty, 2000);
    EXPECT_GT(visible, 500);
}

// Layer by layer the work doubled once: this did not end.
TEST(TermBounds, ManyLayersOfRecolouringAreAskedOnceEach) {
    FieldsTerm fields;
    fields.opacity = std::make_shared<ConstantField>(0.5);
    fields.color = {fields.opacity, fields.opacity, fields.opacity};
    fields.box = {Vec3(-1), Vec3(1)};
    TermPtr term = makeFieldsTerm(fields);
    for (int n = 0; n < 200; ++n) {
        RecolorTerm layer;
        layer.opacity = PiecewiseLinear{{{0, 0}, {1, 1}}};
        layer.of = term;
        term = makeRecolorTerm(layer);
    }
    EXPECT_TRUE(mayBeVisible(*term, {Vec3(-0.1), Vec3(0.1)}));
    EXPECT_FALSE(mayBeVisible(*term, {Vec3(2), Vec3(3)}));
}

TEST(TermBounds, EmptySpaceLeavesOutNothingVisible) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        RandomTerms make(seed);
        const TermPtr term = make.term(2 + int(seed % 2));
        if (term->bounds.empty()) continue;
        const EmptySpace& space = emptySpaceOf(*term);
        std::vector<Vec3> p(3000);
        for (Vec3& at : p) at = term->bounds.center() + 0.5 * make.point(1) * term->bounds.size();
        const auto samples = sampled(term, p);
        for (std::size_t i = 0; i < p.size(); ++i)
            if (samples[i].opacity > 0) {
                EXPECT_EQ(space.emptyAhead(p[i], Vec3(0, 0, 1)), 0) << "seed " << seed;
            }
    }
}

TEST(TermBounds, NothingIsVisibleOutsideTheBoundsOfTheDefinitions) {
    for (unsigned seed = 1; seed <= 150; ++seed) {
        RandomTerms make(seed);
        const TermPtr term = make.term(int(seed % 4));
        std::vector<Vec3> p(500);
        for (Vec3& at : p) at = make.point(2);
        const auto samples = sampled(term, p);
        for (std::size_t i = 0; i < p.size(); ++i) {
            // Locating in cells, and a volume's border, accept a little more.
            const Box3 grown{term->bounds.min - 1e-3, term->bounds.max + 1e-3};
            EXPECT_TRUE(samples[i].opacity == 0 || grown.contains(p[i])) << "seed " << seed;
        }
    }
}

TEST(TermBounds, AttributesLieInTheirRange) {
    for (unsigned seed = 1; seed <= 150; ++seed) {
        RandomTerms make(seed);
        const TermPtr term = make.term(int(seed % 4));
        for (const std::string name : {"scalar", "density", "opacity", "g"})
            for (int n = 0; n < 10; ++n) {
                const Vec3 corner = make.point(1);
                const Box3 box{corner, corner + make.number(0.02, 0.4)};
                const Interval range = attributeRange(*term, box, name);
                std::vector<Vec3> p(30);
                for (Vec3& at : p) at = box.center() + 0.5 * make.point(1) * box.size();
                for (const ObjectSample& s : sampled(term, p, false, name))
                    EXPECT_TRUE(std::isnan(s.value) || (range.low - 1e-9 <= s.value && s.value <= range.high + 1e-9))
                        << "seed " << seed << ", " << name << " " << s.value;
            }
    }
}

TEST(TermBounds, ATermHasWhatItAlwaysHas) {
    int always = 0;
    for (unsigned seed = 1; seed <= 150; ++seed) {
        RandomTerms make(seed);
        const TermPtr term = make.term(int(seed % 3));
        std::vector<Vec3> p(500);
        for (Vec3& at : p) at = make.point(1);
        for (const std::string name : {"scalar", "density", "opacity"}) {
            if (!alwaysHas(*term, name)) continue;
            ++always;
            for (const ObjectSample& s : sampled(term, p, false, name))
                EXPECT_TRUE(s.opacity == 0 || !std::isnan(s.value)) << "seed " << seed << ", " << name;
        }
    }
    EXPECT_GT(always, 160);
}

}  // namespace
}  // namespace voledit
