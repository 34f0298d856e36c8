// setLatticeShape (core/scene/edits.h): the shape of a lattice survives a change of its basis.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "core/base/error.h"
#include "core/scene/edits.h"

namespace voledit {
namespace {

const Frame kFrame{{-3, 1, 10}, {Vec3{40, 0, 0}, Vec3{0, 25, 0}, Vec3{0, 0, 60}}};

Scene randomLattice(LatticeBasis basis, Index3 points, unsigned seed) {
    Scene scene = sceneOfVolume("a.nrrd", "a", "");
    FfdTransfer ffd;
    ffd.basis = basis;
    ffd.points = points;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-6, 6);
    const auto count = std::size_t(points.x * points.y * points.z);
    for (std::size_t i = 0; i < count; i += 2) {
        const Vec3 by{offset(random), offset(random), offset(random)};
        ffd.moves[i] = {by, false};
    }
    ffd.moves[1] = {Vec3{5, 5, 30}, true};
    addLattice(scene, "ffd", ffd, kFrame);
    return scene;
}

Lattice latticeIn(const Scene& scene) {
    const Transfer* transfer = findTransfer(scene, "ffd");
    return latticeOf(std::get<FfdTransfer>(transfer->kind), *transfer->frame);
}

double largestDifference(const Lattice& a, const Lattice& b) {
    double largest = 0;
    for (int k = 0; k <= 10; ++k)
        for (int j = 0; j <= 10; ++j)
            for (int i = 0; i <= 10; ++i) {
                const Vec3 u{i / 10.0, j / 10.0, k / 10.0};
                largest = std::max(largest, glm::length(evaluate(a, u) - evaluate(b, u)));
            }
    return largest;
}

TEST(SetLatticeShape, DegreeElevationKeepsTheShapeExactly) {
    for (const Index3 points : {Index3{5, 4, 4}, Index3{4, 6, 9}, Index3{12, 12, 12}}) {
        Scene scene = randomLattice(LatticeBasis::Bezier, {4, 4, 3}, 11);
        const Lattice before = latticeIn(scene);
        setLatticeShape(scene, "ffd", LatticeBasis::Bezier, points, {8, 8, 8}, kFrame);
        EXPECT_EQ(latticeIn(scene).points, points);
        EXPECT_LT(largestDifference(before, latticeIn(scene)), 1e-11);
    }
}

TEST(SetLatticeShape, ACubicBezierIsABSplineOfAnySize) {
    Scene scene = randomLattice(LatticeBasis::Bezier, {4, 4, 4}, 3);
    const Lattice before = latticeIn(scene);
    setLatticeShape(scene, "ffd", LatticeBasis::BSpline, {7, 4, 11}, {8, 8, 8}, kFrame);
    EXPECT_LT(largestDifference(before, latticeIn(scene)), 1e-10);
}

TEST(SetLatticeShape, AFitAgreesAtTheNewGrevillePoints) {
    Scene scene = randomLattice(LatticeBasis::Bezier, {7, 7, 7}, 5);
    const Lattice before = latticeIn(scene);
    setLatticeShape(scene, "ffd", LatticeBasis::BSpline, {5, 6, 5}, {8, 8, 8}, kFrame);
    const Lattice after = latticeIn(scene);
    for (const Vec3& u : restControlPoints(LatticeBasis::BSpline, {5, 6, 5}, Frame{}))
        EXPECT_LT(glm::length(evaluate(before, u) - evaluate(after, u)), 1e-10);
    EXPECT_GT(largestDifference(before, after), 1e-3) << "fewer points cannot hold the old shape";
}

TEST(SetLatticeShape, ARestLatticeStaysAtRest) {
    Scene scene = sceneOfVolume("a.nrrd", "a", "");
    addLattice(scene, "ffd", {}, kFrame);
    setLatticeShape(scene, "ffd", LatticeBasis::BSpline, {9, 5, 4}, {20, 1, 3}, kFrame);
    const auto& ffd = std::get<FfdTransfer>(findTransfer(scene, "ffd")->kind);
    EXPECT_TRUE(ffd.moves.empty());
    EXPECT_EQ(ffd.cells, Index3(20, 1, 3));
}

TEST(SetLatticeShape, ChangingTheCellsAloneLeavesThePoints) {
    Scene scene = randomLattice(LatticeBasis::Bezier, {4, 4, 4}, 8);
    const Lattice before = latticeIn(scene);
    setLatticeShape(scene, "ffd", LatticeBasis::Bezier, {4, 4, 4}, {32, 32, 32}, kFrame);
    EXPECT_EQ(latticeIn(scene), before);
}

TEST(SetLatticeShape, RefusesShapesThatCannotBe) {
    Scene scene = randomLattice(LatticeBasis::Bezier, {4, 4, 4}, 8);
    const Scene before = scene;
    const Index3 cells{8, 8, 8};
    const auto set = [&](LatticeBasis basis, Index3 points, Index3 n) {
        setLatticeShape(scene, "ffd", basis, points, n, kFrame);
    };
    EXPECT_THROW(set(LatticeBasis::Bezier, {1, 4, 4}, cells), Error);
    EXPECT_THROW(set(LatticeBasis::Bezier, {66, 4, 4}, cells), Error);
    EXPECT_THROW(set(LatticeBasis::BSpline, {3, 4, 4}, cells), Error);
    EXPECT_THROW(set(LatticeBasis::BSpline, {1000, 1000, 4}, cells), Error);
    EXPECT_THROW(set(LatticeBasis::Bezier, {4, 4, 4}, {0, 1, 1}), Error);
    EXPECT_THROW(set(LatticeBasis::Bezier, {4, 4, 4}, {1000, 1000, 1000}), Error);
    EXPECT_EQ(scene, before);
}

}  // namespace
}  // namespace voledit
