#include "core/stf/cell_map.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/stf/lattice.h"

namespace voledit {
namespace {

LatticeMap bentLattice(Outside outside) {
    const Frame frame = frameOf({Vec3(0), Vec3(10)});
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    lattice.control[lattice.indexOf({3, 3, 3})] += Vec3(3, -1, 2);
    lattice.control[lattice.indexOf({1, 2, 1})] += Vec3(-1, 2, 1);
    return LatticeMap(lattice, Index3(8), outside);
}

std::vector<Vec3> points() {
    std::vector<Vec3> p;
    for (int n = 0; n < 1331; ++n) p.push_back(Vec3(n % 11, n / 11 % 11, n / 121) * 1.3 - Vec3(1.03));
    return p;
}

TEST(ScaledCells, ScaleTheDisplacementEverywhere) {
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const LatticeMap whole = bentLattice(outside);
        for (const double amount : {0.0, 0.3, 1.0}) {
            const TransferPtr scaled = scaledCells(whole, amount);
            const auto p = points();
            std::vector<Vec3> q(p.size()), r(p.size());
            scaled->map(p, q);
            whole.map(p, r);
            for (std::size_t i = 0; i < p.size(); ++i) {
                ASSERT_EQ(isDefined(q[i]), isDefined(r[i]));
                if (!isDefined(r[i])) continue;
                EXPECT_LT(glm::length(q[i] - (p[i] + amount * (r[i] - p[i]))), 1e-12);
            }
        }
    }
}

TEST(ScaledCells, ScaleTheJacobiansDistanceFromTheIdentity) {
    const LatticeMap whole = bentLattice(Outside::Hide);
    const TransferPtr scaled = scaledCells(whole, 0.25);
    const auto p = points();
    std::vector<Mat3> j(p.size()), k(p.size());
    scaled->jacobian(p, j);
    whole.jacobian(p, k);
    for (std::size_t i = 0; i < p.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(glm::length(j[i][c] - (Mat3(1)[c] + 0.25 * (k[i][c] - Mat3(1)[c]))), 1e-12);
}

TEST(ScaledCells, ImageHoldsAllThatMapsIntoTheBox) {
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const LatticeMap whole = bentLattice(outside);
        const TransferPtr scaled = scaledCells(whole, 0.5);
        const Box3 rest{{2, 3, 4}, {6, 7, 12}};
        const Box3 image = scaled->imageOf(rest);
        const auto p = points();
        std::vector<Vec3> q(p.size());
        scaled->map(p, q);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (!isDefined(q[i]) || !rest.contains(q[i])) continue;
            ++inside;
            EXPECT_TRUE(image.contains(p[i]));
        }
        EXPECT_GT(inside, 30u);
    }
}

TEST(ScaledCells, UndefinedPointsStayUndefined) {
    const TransferPtr scaled = scaledCells(bentLattice(Outside::Keep), 0.5);
    std::vector<Vec3> p{kUndefined};
    scaled->map(p, p);
    EXPECT_FALSE(isDefined(p[0]));
}

}  // namespace
}  // namespace voledit
