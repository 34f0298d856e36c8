#include "core/eval/baked_map.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "core/base/parallel.h"
#include "core/eval/baked_cells.h"
#include "core/stf/lattice.h"

namespace voledit {
namespace {

const Mat4 kPlace = [] {
    Mat4 m(20);
    m[3] = Vec4(31.5, 31.5, 31.5, 1);
    return m;
}();

LatticeMap bent(double amount) {
    Lattice lattice;
    lattice.frame = frameOf({Vec3(-1), Vec3(1)});
    lattice.control = restControlPoints(lattice.basis, lattice.points, lattice.frame);
    lattice.control[lattice.indexOf({3, 3, 3})] += amount * Vec3(0.4, 0, 0.4);
    lattice.control[lattice.indexOf({1, 0, 2})] -= amount * Vec3(0, 0.5, 0);
    return {lattice, Index3(8), Outside::Hide};
}

BakedCells cellsOf(const LatticeMap& map) {
    return {map.cells(), Mat4(1), kPlace, [](const Box3&) { return true; }};
}

TEST(BakedMap, NodesAreExactWhereTheMapIsDefined) {
    const LatticeMap map = bent(1);
    const BakedMap baked = CellBaker(cellsOf(map), bakeGrid(map.cells()->bounds(), 40)).bake();
    int within = 0;
    for (int k = 0; k < baked.grid.nodes.z; ++k)
        for (int j = 0; j < baked.grid.nodes.y; ++j)
            for (int i = 0; i < baked.grid.nodes.x; ++i) {
                const Vec3 p = baked.grid.origin + baked.grid.cell * Vec3(i, j, k);
                Vec3 q;
                map.map(std::span(&p, 1), std::span(&q, 1));
                if (!isDefined(q)) continue;
                ++within;
                const Vec4f& node = baked.node[baked.grid.indexOf({i, j, k})];
                ASSERT_EQ(node.w, 1);
                ASSERT_LT(glm::length(Vec3(Vec3f(node)) - transformPoint(kPlace, q)), 1e-4);
            }
    EXPECT_GT(within, 20000);
}

TEST(BakedMap, AnAffineMapIsExactUpToItsFacesAndBeyond) {
    Lattice lattice;
    lattice.frame = frameOf({Vec3(-1), Vec3(1)});
    lattice.control = restControlPoints(lattice.basis, lattice.points, lattice.frame);
    const Mat3 shear(Vec3(1, 0.2, 0), Vec3(0, 1.1, 0.1), Vec3(-0.15, 0, 0.9));
    for (Vec3& c : lattice.control) c = shear * c;
    const LatticeMap map(lattice, Index3(4), Outside::Hide);
    const BakedMap baked = CellBaker(cellsOf(map), bakeGrid(map.cells()->bounds(), 32)).bake();
    std::mt19937 random(2);
    // Half a cell beyond the faces, edges and corners too.
    std::uniform_real_distribution<double> coordinate(-1 - 0.5 * baked.grid.cell, 1 + 0.5 * baked.grid.cell);
    for (int n = 0; n < 20000; ++n) {
        const Vec3 q(coordinate(random), coordinate(random), coordinate(random));
        Vec3 place;
        ASSERT_TRUE(baked.at(shear * q, place)) << q.x << " " << q.y << " " << q.z;
        ASSERT_LT(glm::length(place - transformPoint(kPlace, q)), 1e-3);
    }
    const Index3 middle = baked.grid.nodes / 2;
    const Mat3 expected = Mat3(kPlace) * glm::inverse(shear);
    for (int a = 0; a < 3; ++a) EXPECT_LT(glm::length(baked.jacobianAt(middle)[a] - expected[a]), 1e-2);
}

TEST(BakedMap, ErrorsFallAsNodesGetCloserAndBoundWhatIsSeen) {
    const LatticeMap map = bent(1);
    double before = kInfinity;
    for (const int most : {20, 40, 80}) {
        const BakeGrid grid = bakeGrid(map.cells()->bounds(), most);
        const CellBaker baker(cellsOf(map), grid);
        const BakedMap baked = baker.bake();
        const Index3 count = grid.nodes - 1;
        const std::vector<std::uint8_t> all(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z), 1);
        const double error = baked.error(baker.centres(all));
        EXPECT_LT(error, 0.75 * before);
        before = error;
        EXPECT_EQ(baked.error(baker.centres(std::vector<std::uint8_t>(all.size(), 0))), 0);
        std::mt19937 random(4);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        for (int n = 0; n < 5000; ++n) {
            const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
            Vec3 q, place;
            map.map(std::span(&p, 1), std::span(&q, 1));
            if (!isDefined(q)) continue;
            ASSERT_TRUE(baked.at(p, place));
            // Centres are where linear interpolation is worst, but for kinks that pass beside them.
            ASSERT_LT(glm::length(place - transformPoint(kPlace, q)), 2 * error);
        }
    }
}

TEST(BakedMap, UnwantedTetrahedraStayUnknown) {
    const LatticeMap map = bent(0);
    BakedCells cells = cellsOf(map);
    cells.wanted = [](const Box3& box) { return box.min.x < 20; };
    const BakedMap baked = CellBaker(cells, bakeGrid(map.cells()->bounds(), 40)).bake();
    Vec3 place;
    EXPECT_TRUE(baked.at({-0.8, 0.1, 0.2}, place));
    EXPECT_FALSE(baked.at({0.9, 0.1, 0.2}, place));
}

TEST(BakedMap, AnyMapIsBakedAndItsGapsAreTold) {
    // A shear that is torn apart at x = 0.
    const PlaceMap torn = [](std::span<const Vec3> p, std::span<Vec3> place) {
        for (std::size_t n = 0; n < p.size(); ++n) {
            const Vec3 at = p[n];
            place[n] =
                std::abs(at.x) < 0.3 ? kUndefined : Vec3(at.x - (at.x > 0 ? 0.3 : -0.3), at.y + 0.5 * at.x, at.z);
        }
    };
    const BakedMap map = bake(torn, bakeGrid({Vec3(-1), Vec3(1)}, 40));
    Vec3 place;
    ASSERT_TRUE(map.surelyKnownAt({0.5, 0.1, 0.2}) && map.at({0.5, 0.1, 0.2}, place));
    EXPECT_LT(glm::length(place - Vec3(0.2, 0.35, 0.2)), 1e-5);
    EXPECT_FALSE(map.surelyKnownAt({0.29, 0, 0}));
    EXPECT_TRUE(map.at({0.29, 0, 0}, place)) << "continued";
    EXPECT_FALSE(map.at({0, 0, 0}, place));
    const Index3 count = map.grid.nodes - 1;
    std::vector<std::uint8_t> right(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z), 0);
    std::vector<std::uint8_t> all(right.size(), 1);
    for (std::size_t n = 0; n < right.size(); ++n)
        right[n] = map.grid.origin.x + map.grid.cell * int(n % std::size_t(count.x)) > 0.3;
    EXPECT_LT(map.error(bakedCentres(map, torn, right)), 1e-5);
    EXPECT_LT(map.error(bakedCentres(map, torn, right), 0.05 / map.grid.cell), 1e-5);
    EXPECT_EQ(map.error(bakedCentres(map, torn, all)), kInfinity);
}

TEST(BakedMap, ThreadsChangeNothing) {
    const LatticeMap map = bent(1);
    const BakeGrid grid = bakeGrid(map.cells()->bounds(), 40);
    const BakedMap many = CellBaker(cellsOf(map), grid).bake();
    setThreadCount(1);
    const BakedMap one = CellBaker(cellsOf(map), grid).bake();
    setThreadCount(0);
    EXPECT_EQ(many.node, one.node);
}

}  // namespace
}  // namespace voledit
