#include "core/stf/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/stf/affine.h"

namespace voledit {
namespace {

constexpr LatticeBasis kBezier = LatticeBasis::Bezier, kSpline = LatticeBasis::BSpline;
const Frame kOblique{Vec3(-120, 80, 1000), {Vec3(240, 10, 0), Vec3(0, 200, 10), Vec3(5, 0, 180)}};

Lattice restLattice(LatticeBasis basis, Index3 points, const Frame& frame) {
    return {basis, points, frame, restControlPoints(basis, points, frame)};
}

/// Every control point moved by up to `amount` of the box.
Lattice shakenLattice(LatticeBasis basis, Index3 points, double amount, unsigned seed) {
    Lattice lattice = restLattice(basis, points, kOblique);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-amount, amount);
    for (Vec3& c : lattice.control)
        c += unit(random) * kOblique.edge[0] + unit(random) * kOblique.edge[1] + unit(random) * kOblique.edge[2];
    return lattice;
}

std::vector<Vec3> randomParameters(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> u(count);
    for (Vec3& v : u) v = {unit(random), unit(random), unit(random)};
    return u;
}

Vec3 restAt(const Vec3& u) {
    return transformPoint(worldFromNormalised(kOblique), u);
}

struct Case {
    LatticeBasis basis;
    Index3 points;
};
const std::vector<Case> kCases{{kBezier, {4, 4, 4}}, {kBezier, {2, 3, 6}},  {kBezier, {16, 2, 31}},
                               {kSpline, {4, 4, 4}}, {kSpline, {5, 9, 12}}, {kSpline, {20, 4, 6}}};

TEST(Lattice, AtRestIsTheIdentity) {
    for (const auto& [basis, points] : kCases) {
        const Lattice lattice = restLattice(basis, points, kOblique);
        const LatticeMap map(lattice, {16, 16, 16}, Outside::Hide);
        const auto u = randomParameters(2000, 1);
        std::vector<Vec3> p, q(u.size());
        for (const Vec3& at : u) {
            p.push_back(restAt(at));
            EXPECT_LT(glm::length(evaluate(lattice, at) - p.back()), 1e-12 * 1000);
        }
        map.map(p, q);
        std::vector<Mat3> jacobian(p.size());
        map.jacobian(p, jacobian);
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_LT(glm::length(q[i] - p[i]), 1e-12 * 1000);
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(jacobian[i][c] - Mat3(1)[c]), 1e-12);
        }
        EXPECT_FALSE(map.cells()->mayOverlap());
        EXPECT_TRUE(map.foldingPoints().empty());
    }
}

TEST(Lattice, AffineControlPointsGiveTheAffineMap) {
    const Mat4 m = placementMatrix({30, -50, 20}, {0.3, -0.5, 1.1}, {1.2, 0.7, 1.5});
    const AffineMap affine(m);
    for (const auto& [basis, points] : kCases) {
        Lattice lattice = restLattice(basis, points, kOblique);
        for (Vec3& c : lattice.control) c = transformPoint(m, c);
        const LatticeMap map(lattice, {7, 8, 9}, Outside::Hide);
        std::vector<Vec3> p;
        for (const Vec3& u : randomParameters(2000, 2)) p.push_back(transformPoint(m, restAt(u)));
        std::vector<Vec3> q(p.size()), expected(p.size());
        std::vector<Mat3> jacobian(p.size()), expectedJacobian(p.size());
        map.map(p, q);
        affine.map(p, expected);
        map.jacobian(p, jacobian);
        affine.jacobian(p, expectedJacobian);
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_LT(glm::length(q[i] - expected[i]), 1e-12 * 2000);
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(jacobian[i][c] - expectedJacobian[i][c]), 1e-11);
        }
    }
}

TEST(Lattice, BezierVolumesAreTheirFormula) {
    const Lattice lattice = shakenLattice(kBezier, {4, 3, 5}, 0.2, 3);
    const auto bernstein = [](int degree, int i, double u) {
        return std::tgamma(degree + 1.0) / std::tgamma(i + 1.0) / std::tgamma(degree - i + 1.0) * std::pow(u, i) *
               std::pow(1 - u, degree - i);
    };
    for (const Vec3& u : randomParameters(200, 4)) {
        Vec3 expected(0);
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 4; ++i)
                    expected += bernstein(3, i, u.x) * bernstein(2, j, u.y) * bernstein(4, k, u.z) *
                                lattice.control[lattice.indexOf({i, j, k})];
        EXPECT_LT(glm::length(evaluate(lattice, u) - expected), 1e-9);
    }
}

TEST(Lattice, DerivativesAreTheSlopes) {
    for (const auto& [basis, points] : kCases) {
        const Lattice lattice = shakenLattice(basis, points, 0.2, 5);
        for (const Vec3& u : randomParameters(50, 6)) {
            Mat3 slopes;
            evaluate(lattice, 0.01 + 0.98 * u, slopes);
            for (int a = 0; a < 3; ++a) {
                Vec3 step(0);
                step[a] = 1e-6;
                const Vec3 expected =
                    (evaluate(lattice, 0.01 + 0.98 * u + step) - evaluate(lattice, 0.01 + 0.98 * u - step)) / 2e-6;
                EXPECT_LT(glm::length(slopes[a] - expected), 1e-5 * glm::length(kOblique.edge[std::size_t(a)]));
            }
        }
    }
}

TEST(Lattice, ParametersBeyondTheFrameAreClamped) {
    const Lattice lattice = shakenLattice(kBezier, {4, 4, 4}, 0.2, 7);
    EXPECT_EQ(evaluate(lattice, {-0.5, 0.3, 2}), evaluate(lattice, {0, 0.3, 1}));
    EXPECT_EQ(evaluate(lattice, Vec3(0)), lattice.control.front());
}

/// Mean |q − rest(u)| over points p = P(u): how far the cells' piecewise affine inverse is from the true one.
double meanError(const Lattice& lattice, int cells) {
    const LatticeMap map(lattice, Index3(cells), Outside::Hide);
    std::vector<Vec3> u = randomParameters(20000, 8), p;
    for (Vec3& at : u) p.push_back(evaluate(lattice, at = 0.05 + 0.9 * at));
    std::vector<Vec3> q(p.size());
    map.map(p, q);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += glm::length(q[i] - restAt(u[i]));
    return sum / double(p.size());
}

TEST(LatticeMap, ErrorFallsFourfoldWhenCellsAreHalved) {
    for (const auto& [basis, points] : {Case{kBezier, {4, 4, 4}}, Case{kSpline, {6, 5, 7}}}) {
        const Lattice lattice = shakenLattice(basis, points, 0.08, 9);
        double before = meanError(lattice, 8);
        for (const int cells : {16, 32}) {
            const double now = meanError(lattice, cells);
            EXPECT_GT(before / now, 3.5) << cells << " cells";
            EXPECT_LT(before / now, 4.5) << cells << " cells";
            before = now;
        }
    }
}

TEST(LatticeMap, ForwardThenInverseReturnsAtTheCellsVertices) {
    const Lattice lattice = shakenLattice(kBezier, {4, 4, 4}, 0.08, 10);
    const LatticeMap map(lattice, {8, 8, 8}, Outside::Hide);
    ASSERT_FALSE(map.cells()->mayOverlap());
    std::vector<Vec3> u, p;
    for (int n = 0; n < 9 * 9 * 9; ++n) {
        u.push_back(Vec3(n % 9, n / 9 % 9, n / 81) / 8.0);
        p.push_back(evaluate(lattice, u.back()));
    }
    std::vector<Vec3> q(p.size());
    map.map(p, q);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT(glm::length(q[i] - restAt(u[i])), 1e-9);
}

TEST(LatticeMap, JacobianIsTheInverseOfTheForwardMaps) {
    const Lattice lattice = shakenLattice(kBezier, {4, 4, 4}, 0.08, 11);
    const LatticeMap coarse(lattice, {8, 8, 8}, Outside::Hide), fine(lattice, {32, 32, 32}, Outside::Hide);
    const Mat3 restFromNormalised(worldFromNormalised(kOblique));
    const auto meanDifference = [&](const LatticeMap& map) {
        double sum = 0;
        const auto u = randomParameters(2000, 12);
        for (const Vec3& at : u) {
            Mat3 slopes, found;
            const Vec3 p = evaluate(lattice, 0.05 + 0.9 * at, slopes);
            map.jacobian(std::span(&p, 1), std::span(&found, 1));
            const Mat3 expected = restFromNormalised * glm::inverse(slopes);
            for (int c = 0; c < 3; ++c) sum += glm::length(found[c] - expected[c]);
        }
        return sum / double(u.size());
    };
    const double difference = meanDifference(coarse);
    EXPECT_LT(difference, 0.02);
    EXPECT_GT(difference / meanDifference(fine), 10) << "interpolated between vertices: second order";
}

TEST(LatticeMap, OutsideHidesOrKeeps) {
    const Lattice lattice = restLattice(kBezier, {4, 4, 4}, frameOf({Vec3(0), Vec3(1)}));
    std::vector<Vec3> p{Vec3(0.5), Vec3(2, 0.5, 0.5), kUndefined}, q(3);
    const LatticeMap hide(lattice, {4, 4, 4}, Outside::Hide), keep(lattice, {4, 4, 4}, Outside::Keep);
    hide.map(p, q);
    EXPECT_LT(glm::length(q[0] - p[0]), 1e-15);
    EXPECT_FALSE(isDefined(q[1]));
    keep.map(p, q);
    EXPECT_EQ(q[1], p[1]);
    EXPECT_FALSE(isDefined(q[2]));
    std::vector<Mat3> jacobian(3);
    keep.jacobian(p, jacobian);
    EXPECT_EQ(jacobian[1], Mat3(1));
    keep.map(p, p);
    EXPECT_EQ(p[1], Vec3(2, 0.5, 0.5)) << "in place";
}

TEST(LatticeMap, ImageIsTheHullOfTheControlPoints) {
    Lattice lattice = restLattice(kBezier, {4, 4, 4}, frameOf({Vec3(0), Vec3(1)}));
    lattice.control[lattice.indexOf({3, 3, 3})] = {1.5, 1.2, 1};
    lattice.control[lattice.indexOf({0, 1, 1})] = {-0.4, 1 / 3.0, 1 / 3.0};
    const Box3 rest{Vec3(-2), Vec3(1)};
    EXPECT_EQ(LatticeMap(lattice, {4, 4, 4}, Outside::Hide).imageOf(rest), (Box3{Vec3(-0.4, 0, 0), Vec3(1.5, 1.2, 1)}));
    EXPECT_EQ(LatticeMap(lattice, {4, 4, 4}, Outside::Keep).imageOf(rest), (Box3{Vec3(-2), Vec3(1.5, 1.2, 1)}));
    EXPECT_TRUE(LatticeMap(lattice, {4, 4, 4}, Outside::Keep).imageOf({}).empty());
}

TEST(LatticeMap, NamesTheControlPointThatFolds) {
    Lattice lattice = restLattice(kBezier, {4, 4, 4}, frameOf({Vec3(0), Vec3(1)}));
    lattice.control[lattice.indexOf({3, 2, 1})].x -= 2.5;
    const LatticeMap map(lattice, {16, 16, 16}, Outside::Hide);
    EXPECT_TRUE(map.cells()->mayOverlap());
    const auto points = map.foldingPoints();
    EXPECT_TRUE(std::find(points.begin(), points.end(), lattice.indexOf({3, 2, 1})) != points.end());
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
    EXPECT_LT(points.size(), 24u);
}

}  // namespace
}  // namespace voledit
