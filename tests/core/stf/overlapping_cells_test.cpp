#include "core/stf/overlapping_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace voledit {
namespace {

/// A grid of 6 × 3 × 3 cells over a 2 × 1 × 1 box, its points moved by `move`.
template <class Move>
void addGrid(MappedCells::Data& data, const Move& move) {
    MappedCells::Data grid = gridCells({{0, 0, 0}, {Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {6, 3, 3});
    const auto base = std::uint32_t(data.deformed.size());
    for (const Vec3& q : grid.source) {
        data.source.push_back(q);
        data.deformed.push_back(move(q));
    }
    for (auto cell : grid.hexahedra) {
        for (auto& v : cell) v += base;
        data.hexahedra.push_back(cell);
    }
}

Vec3 bent(const Vec3& q) {
    const double angle = 0.9 * q.x;
    return {(2 - q.y) * std::sin(angle), 2 - (2 - q.y) * std::cos(angle), q.z + 0.1 * q.x * q.y};
}

/// Checks with random points that no two cells hold one unless both count as overlapping; gives how many points two
/// cells hold.
int pointsInTwoCells(const MappedCells& cells) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<CellLocation> found;
    int twice = 0;
    std::uint32_t hint = 0;
    for (int n = 0; n < 20'000; ++n) {
        const Vec3 p = cells.bounds().min + cells.bounds().size() * Vec3(unit(random), unit(random), unit(random));
        found.clear();
        cells.locateAll(p, found);
        if (found.size() > 1) ++twice;
        for (const CellLocation& at : found) EXPECT_TRUE(found.size() == 1 || cells.overlapping()[at.tetrahedron / 6]);
        CellLocation alone{};
        if (cells.locateAlone(p, hint, alone)) {
            EXPECT_EQ(found.size(), 1u);
            EXPECT_TRUE(!found.empty() && found.front().tetrahedron == alone.tetrahedron);
        }
        if (!found.empty()) hint = found.front().tetrahedron;
    }
    return twice;
}

std::size_t countOf(std::span<const char> flags) {
    return std::size_t(std::count(flags.begin(), flags.end(), char(1)));
}

TEST(OverlappingCells, NoneInAGridThatDoesNotMeetItself) {
    MappedCells::Data data;
    addGrid(data, bent);
    EXPECT_EQ(countOf(overlappingCells(MappedCells(std::move(data)))), 0u);
}

TEST(OverlappingCells, OnlyThoseWhereTwoGridsMeet) {
    MappedCells::Data data;
    addGrid(data, bent);
    addGrid(data, [](const Vec3& q) { return q + Vec3(0.1, -0.45, 0.05); });
    const MappedCells cells(std::move(data));
    EXPECT_GT(pointsInTwoCells(cells), 100);
    EXPECT_LT(countOf(cells.overlapping()), cells.cellCount() * 2 / 3);  // most of both lie apart
}

TEST(OverlappingCells, AGridWithinAnother) {
    MappedCells::Data data;
    addGrid(data, [](const Vec3& q) { return 4.0 * q; });
    addGrid(data, [](const Vec3& q) { return 0.6 * q + Vec3(3.1, 1.7, 1.4); });
    const MappedCells cells(std::move(data));
    EXPECT_GT(pointsInTwoCells(cells), 5);
    EXPECT_TRUE(cells.overlapping()[60]);
}

TEST(OverlappingCells, AFoldOverItsNeighbours) {
    MappedCells::Data data;
    addGrid(data, [](const Vec3& q) { return Vec3(q.x > 1.2 ? 2.4 - q.x : q.x, q.y, q.z + 0.01 * q.x); });
    EXPECT_GT(pointsInTwoCells(MappedCells(std::move(data))), 1000);
}

TEST(OverlappingCells, MirroredCellsAreNoFold) {
    MappedCells::Data data;
    addGrid(data, [](const Vec3& q) { return Vec3(-q.x, q.y, q.z); });
    EXPECT_EQ(countOf(overlappingCells(MappedCells(std::move(data)))), 0u);
}

}  // namespace
}  // namespace voledit
