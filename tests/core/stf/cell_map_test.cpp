#include "core/stf/cell_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/base/error.h"
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

Vec3 mapped(const SpatialTransferFunction& map, const Vec3& p) {
    Vec3 q;
    map.map({&p, 1}, {&q, 1});
    return q;
}

/// A bent block of hexahedra, or the same as tetrahedra, every third one turned over.
MappedCells::Data bentBlock(bool tetrahedra) {
    auto data = gridCells(frameOf({Vec3(0), Vec3(4)}), {4, 3, 3});
    for (Vec3& p : data.deformed) p += 0.3 * Vec3(std::sin(p.y), std::cos(p.z + 1), std::sin(p.x + p.y));
    if (!tetrahedra) return data;
    const MappedCells hexahedra{MappedCells::Data(data)};
    data.hexahedra.clear();
    data.tetrahedra.assign(hexahedra.tetrahedra().begin(), hexahedra.tetrahedra().end());
    for (std::size_t t = 0; t < data.tetrahedra.size(); t += 3) std::swap(data.tetrahedra[t][2], data.tetrahedra[t][3]);
    return data;
}

std::vector<Vec3> randomPoints(int count, double low, double high) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> at(low, high);
    std::vector<Vec3> points;
    for (int n = 0; n < count; ++n) points.push_back({at(random), at(random), at(random)});
    return points;
}

TEST(CellMap, OneTetrahedronIsOneAffineMap) {
    const Mat3 turn(Vec3(0.5, 2, 0), Vec3(-1, 0.25, 1), Vec3(0, 0, -3));  // dq/dp
    MappedCells::Data data;
    data.deformed = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Vec3& p : data.deformed) data.source.push_back(turn * p + Vec3(7));
    data.tetrahedra = {{0, 1, 2, 3}};
    for (const bool swapped : {false, true}) {
        if (swapped) std::swap(data.tetrahedra[0][0], data.tetrahedra[0][3]);
        const CellMap hidden(data, Outside::Hide), kept(data, Outside::Keep);
        const Vec3 inside(0.5, 0.3, 0.2), outside(1.5, 0.3, 0.2);
        EXPECT_LT(glm::length(mapped(hidden, inside) - (turn * inside + Vec3(7))), 1e-14);
        EXPECT_FALSE(isDefined(mapped(hidden, outside)));
        EXPECT_EQ(mapped(kept, outside), outside);
        Mat3 jacobian;
        hidden.jacobian({&inside, 1}, {&jacobian, 1});
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(jacobian[c] - turn[c]), 1e-14);
        for (const Vec3& corner : data.deformed) EXPECT_TRUE(isDefined(mapped(hidden, corner)));
    }
}

TEST(CellMap, TetrahedraGiveWhatTheirHexahedraGive) {
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const CellMap hexahedra(bentBlock(false), outside), tetrahedra(bentBlock(true), outside);
        EXPECT_EQ(tetrahedra.cells()->cellCount(), 6 * hexahedra.cells()->cellCount());
        EXPECT_EQ(tetrahedra.cells()->bounds(), hexahedra.cells()->bounds());
        EXPECT_FALSE(tetrahedra.cells()->mayOverlap());
        const auto p = randomPoints(5000, -1, 5);
        std::vector<Vec3> q(p.size()), r(p.size());
        hexahedra.map(p, q);
        tetrahedra.map(p, r);
        std::vector<Mat3> j(p.size()), k(p.size());
        hexahedra.jacobian(p, j);
        tetrahedra.jacobian(p, k);
        for (std::size_t i = 0; i < p.size(); ++i) {
            ASSERT_EQ(isDefined(q[i]), isDefined(r[i]));
            if (!isDefined(q[i])) continue;
            EXPECT_LT(glm::length(q[i] - r[i]), 1e-13);
            for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(j[i][c] - k[i][c]), 1e-12);
        }
    }
}

TEST(CellMap, BoxesOfTetrahedraHoldWhatTheyMust) {
    const CellMap map(bentBlock(true), Outside::Hide);
    const auto p = randomPoints(3000, -1, 5);
    std::vector<Vec3> q(p.size());
    map.map(p, q);
    const Box3 box{{0.7, 1.1, 0.4}, {1.9, 2.6, 2.2}}, image = map.imageOf(box);
    std::vector<Box3> sources;
    map.anySourceBox(box, [&](const Box3& source) {
        sources.push_back(source);
        return false;
    });
    int deformed = 0, source = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!isDefined(q[i])) continue;
        if (box.contains(q[i])) {
            ++source;
            EXPECT_TRUE(image.contains(p[i]));
        }
        if (box.contains(p[i])) {
            ++deformed;
            EXPECT_TRUE(std::ranges::any_of(sources, [&](const Box3& b) { return b.contains(q[i]); }));
        }
    }
    EXPECT_GT(deformed, 20);
    EXPECT_GT(source, 20);
    EXPECT_LT(image.size().x, 2.5) << "the box is 1.2 wide, a cell 1";
}

TEST(CellMap, WhereCellsFoldTheFirstOneCounts) {
    // Three cells in a row, the second turned back over the others: x = 0, 2, 1, 3 for q = 0, 1, 2, 3.
    auto data = gridCells(frameOf({Vec3(0), Vec3(3, 1, 1)}), {3, 1, 1});
    for (Vec3& p : data.deformed) p.x = p.x == 1 ? 2 : p.x == 2 ? 1 : p.x;
    const CellMap map(data, Outside::Hide);
    EXPECT_TRUE(map.cells()->mayOverlap());
    EXPECT_LT(glm::length(mapped(map, {1.5, 0.4, 0.3}) - Vec3(0.75, 0.4, 0.3)), 1e-14);
    EXPECT_LT(glm::length(mapped(map, {2.5, 0.4, 0.3}) - Vec3(2.75, 0.4, 0.3)), 1e-14);
    std::vector<CellLocation> all;
    map.cells()->locateAll({1.5, 0.4, 0.3}, all);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_NEAR(map.cells()->sourceAt(all[1]).x, 1.5, 1e-14);
    EXPECT_NEAR(map.cells()->sourceAt(all[2]).x, 2.25, 1e-14);
    std::ranges::reverse(data.hexahedra);
    EXPECT_NEAR(mapped(CellMap(data, Outside::Hide), {1.5, 0.4, 0.3}).x, 2.25, 1e-14);
}

TEST(CellMap, FlatCellsAreNeverFoundAndTheirNeighboursAre) {
    auto data = gridCells(frameOf({Vec3(0), Vec3(3, 1, 1)}), {3, 1, 1});
    for (Vec3& p : data.deformed) p.x = std::max(p.x - 1, 0.0);  // the first cell has no thickness any more
    for (const bool tetrahedra : {false, true}) {
        if (tetrahedra) {
            const MappedCells hexahedra{MappedCells::Data(data)};
            data.hexahedra.clear();
            data.tetrahedra.assign(hexahedra.tetrahedra().begin(), hexahedra.tetrahedra().end());
        }
        const CellMap map(data, Outside::Hide);
        EXPECT_EQ(mapped(map, {0, 0.3, 0.4}), Vec3(1, 0.3, 0.4)) << "the second cell's";
        EXPECT_EQ(mapped(map, {1.5, 0.5, 0.25}), Vec3(2.5, 0.5, 0.25));
        EXPECT_FALSE(isDefined(mapped(map, {-0.01, 0.3, 0.4})));
        Mat3 jacobian;
        const Vec3 p(0.01, 0.5, 0.5);
        map.jacobian({&p, 1}, {&jacobian, 1});
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(jacobian[c] - Mat3(1)[c]), 1e-12);
    }
}

TEST(CellMap, SourcesMayBeFlatOrOnePoint) {
    auto data = gridCells(frameOf({Vec3(0), Vec3(1)}), Index3(1));
    for (Vec3& q : data.source) q = {q.x, q.y, 5};
    EXPECT_EQ(mapped(CellMap(data, Outside::Hide), {0.25, 0.5, 0.75}), Vec3(0.25, 0.5, 5));
    for (Vec3& q : data.source) q = Vec3(2);
    EXPECT_EQ(mapped(CellMap(data, Outside::Hide), {0.25, 0.5, 0.75}), Vec3(2));
}

TEST(CellMap, WithoutCellsNothingIsThere) {
    for (const Outside outside : {Outside::Hide, Outside::Keep}) {
        const CellMap map({}, outside);
        const Vec3 p(1, 2, 3);
        EXPECT_EQ(isDefined(mapped(map, p)), outside == Outside::Keep);
        Mat3 jacobian(5);
        map.jacobian({&p, 1}, {&jacobian, 1});
        EXPECT_EQ(jacobian, Mat3(1));
        EXPECT_FALSE(map.cells()->mayOverlap());
        const Box3 rest{Vec3(0), Vec3(1)};
        EXPECT_EQ(map.imageOf(rest), outside == Outside::Keep ? rest : Box3());
        EXPECT_EQ(map.anySourceBox(rest, [](const Box3&) { return true; }), outside == Outside::Keep);
    }
}

TEST(CellMap, RefusesCellsThatCannotBe) {
    const auto refused = [](const auto& spoil) {
        auto data = bentBlock(true);
        spoil(data);
        EXPECT_THROW(CellMap(std::move(data), Outside::Hide), Error);
    };
    refused([](MappedCells::Data& d) { d.tetrahedra[3][1] = std::uint32_t(d.deformed.size()); });
    refused([](MappedCells::Data& d) { d.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}}; });
    refused([](MappedCells::Data& d) { d.source.pop_back(); });
    refused([](MappedCells::Data& d) { d.source[0].y = kNaN; });
    refused([](MappedCells::Data& d) { d.deformed[5].z = kInfinity; });
    refused([](MappedCells::Data& d) { d.jacobian.resize(3); });
}

TEST(ScaledCells, OfTetrahedraAreTetrahedra) {
    const CellMap whole(bentBlock(true), Outside::Hide);
    const TransferPtr half = scaledCells(whole, 0.5);
    EXPECT_EQ(half->cells()->cellCount(), whole.cells()->cellCount());
    const Vec3 p(1.3, 2.1, 0.7);
    EXPECT_LT(glm::length(mapped(*half, p) - 0.5 * (p + mapped(whole, p))), 1e-14);
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
