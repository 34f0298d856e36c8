#include "core/stf/cell_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/stf/lattice.h"

namespace voledit {
namespace {

const Frame kUnit{};

/// A row of cells bent to an arc of `angle` about the z axis, radii 2 to 3.
MappedCells arc(double angle) {
    auto data = gridCells(kUnit, {24, 2, 2});
    for (Vec3& p : data.deformed) {
        const double phi = angle * p.x, r = 2 + p.y;
        p = {r * std::cos(phi), r * std::sin(phi), p.z};
    }
    return MappedCells(std::move(data));
}

/// Two unit cubes of 2³ cells, the second with its corner at `corner` and scaled.
MappedCells twoCubes(const Vec3& corner, double scale) {
    auto data = gridCells(kUnit, {2, 2, 2});
    const auto other = gridCells(kUnit, {2, 2, 2});
    const auto first = std::uint32_t(data.deformed.size());
    for (const Vec3& p : other.source) {
        data.deformed.push_back(corner + scale * p);
        data.source.push_back(p);
    }
    for (auto hexahedron : other.hexahedra) {
        for (auto& v : hexahedron) v += first;
        data.hexahedra.push_back(hexahedron);
    }
    return MappedCells(std::move(data));
}

TEST(CellOverlap, ARowBentRoundOverlapsOnceItsEndsMeet) {
    EXPECT_FALSE(cellsMayOverlap(arc(0.5)));
    EXPECT_FALSE(cellsMayOverlap(arc(1.95 * kPi)));
    EXPECT_TRUE(cellsMayOverlap(arc(2.02 * kPi)));
    EXPECT_TRUE(cellsMayOverlap(arc(2.5 * kPi)));
}

TEST(CellOverlap, SeparateCubesOverlapWhereTheyMeet) {
    EXPECT_FALSE(cellsMayOverlap(twoCubes({1.5, 0, 0}, 1)));
    EXPECT_TRUE(cellsMayOverlap(twoCubes({0.7, 0.1, 0.2}, 1)));
    EXPECT_TRUE(cellsMayOverlap(twoCubes({0.5, 0, 0}, 1))) << "no outer face pierces another, they lie in one plane";
    EXPECT_TRUE(cellsMayOverlap(twoCubes({0, 0, 0}, 1))) << "one upon the other";
    EXPECT_TRUE(cellsMayOverlap(twoCubes({0.3, 0.3, 0.3}, 0.2))) << "one within the other";
}

TEST(CellOverlap, AHexahedronOnAFaceOfItsNeighboursSideIsAFold) {
    auto data = gridCells(kUnit, {2, 1, 1});
    for (Vec3& p : data.deformed) p.x = p.x == 1 ? 0.2 : p.x;  // the second cell lies back over the first
    EXPECT_TRUE(cellsMayOverlap(MappedCells(std::move(data))));
}

TEST(CellOverlap, AWedgeWithVerticesTwiceIsNoFold) {
    auto data = gridCells(kUnit, {2, 1, 1});
    for (auto& hexahedron : data.hexahedra) hexahedron[5] = hexahedron[4];
    data.hexahedra.resize(1);
    EXPECT_FALSE(cellsMayOverlap(MappedCells(std::move(data))));
}

/// Tetrahedra of the corner at the origin of size 1 and of others, by their points.
MappedCells tetrahedraOf(std::vector<Vec3> points, std::vector<std::array<std::uint32_t, 4>> tetrahedra) {
    MappedCells::Data data;
    data.source = points;
    data.deformed = std::move(points);
    data.tetrahedra = std::move(tetrahedra);
    return MappedCells(std::move(data));
}

TEST(CellOverlap, TetrahedraLieApartOnTheTwoSidesOfAFace) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0.1, 0.1, 0.1}};
    for (const auto& second : {std::array<std::uint32_t, 4>{4, 1, 2, 3}, std::array<std::uint32_t, 4>{1, 4, 2, 3}})
        EXPECT_FALSE(cellsMayOverlap(tetrahedraOf(points, {{0, 1, 2, 3}, second})));
    EXPECT_TRUE(cellsMayOverlap(tetrahedraOf(points, {{0, 1, 2, 3}, {5, 1, 2, 3}}))) << "both on one side";
    EXPECT_TRUE(cellsMayOverlap(tetrahedraOf(points, {{0, 1, 2, 3}, {4, 1, 2, 3}, {4, 1, 2, 3}}))) << "one twice";
}

TEST(CellOverlap, SeparateTetrahedraOverlapWhereTheyMeet) {
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto second = [&](const Vec3& corner, double size) {
        auto both = points;
        for (const Vec3& p : points) both.push_back(corner + size * p);
        return tetrahedraOf(std::move(both), {{0, 1, 2, 3}, {4, 5, 6, 7}});
    };
    EXPECT_FALSE(cellsMayOverlap(second({0.5, 0.5, 0.5}, 1)));
    EXPECT_TRUE(cellsMayOverlap(second({0.3, 0.2, 0.1}, 1)));
    EXPECT_TRUE(cellsMayOverlap(second({0.1, 0.1, 0.1}, 0.2))) << "one within the other";
}

TEST(CellOverlap, HostileHeapsOfCellsTakeNoLongTime) {
    // 30000 needles through one place, none touching another's in exact arithmetic or not: nobody may try all pairs.
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> needles;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> at(-1, 1);
    for (std::uint32_t n = 0; n < 30000; ++n) {
        const Vec3 end(at(random), at(random), at(random)), start = Vec3(1e-3 * at(random)) - end;
        const std::uint32_t v = std::uint32_t(points.size());
        points.insert(points.end(), {start, end, end + Vec3(0, 1e-9, 0), end + Vec3(0, 0, 1e-9)});
        needles.push_back({v, v + 1, v + 2, v + 3});
    }
    EXPECT_TRUE(cellsMayOverlap(tetrahedraOf(std::move(points), std::move(needles))));
}

TEST(CellOverlap, NoPointOfCellsDeclaredApartHasTwoPreImages) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, 1);
    std::uniform_real_distribution<double> unit(0, 1);
    int apart = 0, overlapping = 0, confirmed = 0;
    for (int n = 0; n < 60; ++n) {
        Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, kUnit, {}};
        lattice.control = restControlPoints(lattice.basis, lattice.points, lattice.frame);
        for (Vec3& c : lattice.control) c += 0.02 * (n % 12) * Vec3(normal(random), normal(random), normal(random));
        const LatticeMap map(lattice, {6, 6, 6}, Outside::Hide);
        const bool may = map.cells()->mayOverlap();
        (may ? overlapping : apart)++;
        bool several = false;
        std::vector<CellLocation> all;
        const Box3& box = map.cells()->bounds();
        for (int i = 0; i < 4000; ++i) {
            all.clear();
            map.cells()->locateAll(box.min + Vec3(unit(random), unit(random), unit(random)) * box.size(), all);
            several = several || all.size() > 1;
        }
        EXPECT_FALSE(several && !may) << n;
        confirmed += several;
    }
    EXPECT_GT(apart, 10);
    EXPECT_GT(overlapping, 10);
    EXPECT_GT(2 * confirmed, overlapping) << "most of what is declared to overlap does";
}

}  // namespace
}  // namespace voledit
