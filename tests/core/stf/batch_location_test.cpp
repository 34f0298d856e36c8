#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "core/base/parallel.h"
#include "core/stf/cell_locator.h"
#include "core/stf/mapped_cells.h"

namespace voledit {
namespace {

/// A twisted box of cells; with a large amplitude it folds over itself.
MappedCells::Data waves(Index3 count, double amplitude) {
    auto data = gridCells({Vec3(-64), {Vec3(128, 0, 0), Vec3(0, 128, 0), Vec3(0, 0, 128)}}, count);
    for (Vec3& p : data.deformed) {
        const double turn = 0.6 * p.z / 64;
        p = {std::cos(turn) * p.x - std::sin(turn) * p.y + amplitude * std::sin(p.z / 9),
             std::sin(turn) * p.x + std::cos(turn) * p.y + amplitude * std::sin(p.x / 11), p.z};
    }
    return data;
}

/// Random points in and around the cells; some on vertices, edges and faces; some undefined.
std::vector<Vec3> pointsAbout(const MappedCells& cells, std::size_t count) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-0.05, 1.05);
    const Box3 box = cells.bounds();
    std::vector<Vec3> p(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& t = cells.tetrahedra()[random() % cells.tetrahedra().size()];
        const Vec3 a = cells.deformed()[t[0]], b = cells.deformed()[t[1]], c = cells.deformed()[t[3]];
        switch (i % 5) {
            case 0:
                p[i] = a;
                break;
            case 1:
                p[i] = (a + b + c) / 3.0;
                break;
            case 2:
                p[i] = i % 35 == 2 ? kUndefined : 0.5 * (a + c);
                break;
            default:
                p[i] = box.min + box.size() * Vec3(unit(random), unit(random), unit(random));
        }
    }
    return p;
}

bool same(const Vec3& a, const Vec3& b) {
    return std::memcmp(&a, &b, sizeof a) == 0 || (!isDefined(a) && !isDefined(b));
}

void expectTheFirstOfEach(const MappedCells& cells) {
    const CellLocator locator(cells);
    const std::vector<Vec3> p = pointsAbout(cells, 20000);
    std::vector<Vec3> q(p.size());
    locator.firstOfMany(p, cells, q);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        CellLocation at{};
        const Vec3 expected = locator.first(p[i], at) ? cells.sourceAt(at) : kUndefined;
        inside += isDefined(expected);
        ASSERT_TRUE(same(q[i], expected)) << i;
    }
    EXPECT_GT(inside, p.size() / 3);
    EXPECT_LT(inside, p.size());
    std::vector<Vec3> itself = p;
    locator.firstOfMany(itself, cells, itself);
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_TRUE(same(itself[i], q[i])) << i;
}

TEST(BatchLocation, GivesWhatOnePointAtATimeGivesToTheBit) {
    expectTheFirstOfEach(MappedCells(waves({9, 8, 7}, 6)));
}

TEST(BatchLocation, GivesTheFirstCellWhereTheMapFolds) {
    const MappedCells cells(waves({8, 8, 8}, 40));
    ASSERT_TRUE(cells.mayOverlap());
    expectTheFirstOfEach(cells);
}

TEST(BatchLocation, PassesOverDegenerateCells) {
    auto data = waves({6, 6, 6}, 5);
    for (std::size_t v = 0; v < data.deformed.size(); ++v)
        if (v / 7 % 7 == 3) data.deformed[v] = data.deformed[v - 7];  // a layer of cells without thickness
    expectTheFirstOfEach(MappedCells(std::move(data)));
}

TEST(BatchLocation, TakesTetrahedraByThemselves) {
    auto data = waves({5, 6, 7}, 8);
    const MappedCells hexahedra(data);
    data.hexahedra.clear();
    data.jacobian.clear();
    data.tetrahedra.assign(hexahedra.tetrahedra().begin(), hexahedra.tetrahedra().end());
    expectTheFirstOfEach(MappedCells(std::move(data)));
}

TEST(BatchLocation, MapsTheSameForEveryOrderAndNumberOfThreads) {
    const MappedCells cells(waves({10, 10, 10}, 6));
    const std::vector<Vec3> p = pointsAbout(cells, 300000);
    std::vector<Vec3> many(p.size()), one(p.size());
    setThreadCount(1);
    cells.map(p, many);
    setThreadCount(3);
    cells.map(p, one);
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_TRUE(same(many[i], one[i])) << i;
    setThreadCount(0);
    for (std::size_t i = 0; i < p.size(); i += 97) {
        cells.map({&p[i], 1}, {&one[i], 1});
        ASSERT_TRUE(same(many[i], one[i])) << i;
    }
}

}  // namespace
}  // namespace voledit
