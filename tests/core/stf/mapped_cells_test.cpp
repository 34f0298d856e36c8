#include "core/stf/mapped_cells.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <set>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {
namespace {

using Random = std::mt19937_64;

Vec3 randomVector(Random& random, double size) {
    std::uniform_real_distribution<double> unit(-size, size);
    return {unit(random), unit(random), unit(random)};
}

/// A box far from the origin whose cells bend smoothly, without folds.
MappedCells::Data bentCells(Index3 count) {
    auto data = gridCells({Vec3(100, -200, 50), {Vec3(40, 1, 0), Vec3(-2, 30, 3), Vec3(0, 4, 50)}}, count);
    for (Vec3& p : data.deformed)
        p += 3.0 * Vec3(std::sin(p.y / 9), std::cos(p.z / 11 + 1), std::sin((p.x + p.y) / 13));
    return data;
}

/// Three cells in a row whose second one is turned back: x = 0, 2, 1, 3 for q = 0, 1, 2, 3.
MappedCells foldedRow() {
    auto data = gridCells({Vec3(0), {Vec3(3, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {3, 1, 1});
    for (Vec3& p : data.deformed) p.x = p.x == 1 ? 2 : p.x == 2 ? 1 : p.x;
    return MappedCells(std::move(data));
}

/// All tetrahedra that contain p, by trying each.
std::vector<std::uint32_t> containing(const MappedCells& cells, const Vec3& p, double tolerance) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < cells.tetrahedra().size(); ++t) {
        const auto& v = cells.tetrahedra()[t];
        const auto x = [&](std::size_t i) { return cells.deformed()[v[i]]; };
        const Vec3 w = glm::inverse(Mat3(x(1) - x(0), x(2) - x(0), x(3) - x(0))) * (p - x(0));
        if (std::min({w.x, w.y, w.z, 1 - w.x - w.y - w.z}) >= -tolerance) found.push_back(t);
    }
    return found;
}

TEST(MappedCells, SixTetrahedraFillTheCubeAroundItsDiagonal) {
    double volume = 0;
    std::set<std::set<int>> seen;
    for (const auto& t : kHexahedronTetrahedra) {
        EXPECT_EQ(t[0], 0);
        EXPECT_EQ(t[3], 7);
        const auto corner = [&](std::size_t v) { return Vec3(t[v] & 1, t[v] >> 1 & 1, t[v] >> 2 & 1); };
        const double six = glm::determinant(Mat3(corner(1) - corner(0), corner(2) - corner(0), corner(3) - corner(0)));
        EXPECT_EQ(six, 1);
        volume += six;
        seen.insert(std::set<int>(t.begin(), t.end()));
    }
    EXPECT_EQ(volume, 6);
    EXPECT_EQ(seen.size(), 6u);
}

TEST(MappedCells, GridCellsAreTheFramesRegularGrid) {
    const Frame frame{Vec3(1, 2, 3), {Vec3(4, 0, 0), Vec3(1, 3, 0), Vec3(0, 0, -2)}};
    const auto data = gridCells(frame, {2, 3, 4});
    ASSERT_EQ(data.source.size(), 3u * 4 * 5);
    ASSERT_EQ(data.hexahedra.size(), 24u);
    EXPECT_EQ(data.deformed, data.source);
    EXPECT_EQ(data.source.front(), frame.corner);
    EXPECT_EQ(data.source.back(), frame.corner + frame.edge[0] + frame.edge[1] + frame.edge[2]);
    EXPECT_EQ(data.source[1], frame.corner + 0.5 * frame.edge[0]) << "x is fastest";
    for (const auto& h : data.hexahedra)
        for (int v = 0; v < 8; ++v) {
            const Vec3 step = data.source[h[std::size_t(v)]] - data.source[h[0]];
            const Vec3 expected = (v & 1 ? 0.5 : 0.0) * frame.edge[0] + (v & 2 ? 1 / 3.0 : 0.0) * frame.edge[1] +
                                  (v & 4 ? 0.25 : 0.0) * frame.edge[2];
            EXPECT_LT(glm::length(step - expected), 1e-14);
        }
}

TEST(MappedCells, UnmovedTheyAreTheIdentity) {
    const Frame frame{Vec3(-120, 80, 1000), {Vec3(240, 0, 0), Vec3(0, 200, 10), Vec3(5, 0, 180)}};
    const MappedCells cells(gridCells(frame, {16, 16, 16}));
    Random random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> p(50000), q(p.size());
    for (Vec3& at : p) at = transformPoint(worldFromNormalised(frame), {unit(random), unit(random), unit(random)});
    cells.map(p, q);
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_LT(glm::length(p[i] - q[i]), 1e-11);
    EXPECT_FALSE(cells.mayOverlap());
    for (const double d : cells.determinants()) EXPECT_NEAR(d, 1, 1e-12);
    for (const Mat3& j : cells.jacobians())
        for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(j[c] - Mat3(1)[c]), 1e-12);
}

TEST(MappedCells, LeaveNoCracks) {
    // Points inside tetrahedra and, as exactly as doubles can say it, on their faces, edges, vertices and diagonals.
    const MappedCells cells(bentCells({16, 16, 16}));
    ASSERT_FALSE(cells.mayOverlap());
    constexpr std::size_t count = 1000000;
    std::atomic<std::size_t> lost{0}, wrong{0};
    parallelFor(count, 10000, [&](std::size_t begin, std::size_t end) {
        Random random(begin);
        std::exponential_distribution<double> weight(1);
        std::uint32_t hint = 0;
        for (std::size_t n = begin; n < end; ++n) {
            const auto t = std::uint32_t(random() % cells.tetrahedra().size());
            std::array<double, 4> w{weight(random), weight(random), weight(random), weight(random)};
            for (std::size_t drop = 0; drop < n % 4; ++drop) w[random() % 4] = 0;
            if (n % 16 == 7) w = {weight(random), 0, 0, weight(random)};
            if (n % 2) {  // sums of few bits, whose points hit faces of several cells to the bit
                for (double& v : w) v = v > 0.7 ? 1 : 0;
            }
            const double sum = w[0] + w[1] + w[2] + w[3];
            if (sum == 0) continue;
            Vec3 p(0), q(0);
            for (std::size_t v = 0; v < 4; ++v) {
                p += w[v] / sum * cells.deformed()[cells.tetrahedra()[t][v]];
                q += w[v] / sum * cells.source()[cells.tetrahedra()[t][v]];
            }
            CellLocation at{}, near{};
            if (!cells.locate(p, at) || !cells.locateNear(p, hint, near)) {
                ++lost;
            } else if (glm::length(cells.sourceAt(at) - q) > 1e-10 || glm::length(cells.sourceAt(near) - q) > 1e-10) {
                ++wrong;
            }
        }
    });
    EXPECT_EQ(lost, 0u);
    EXPECT_EQ(wrong, 0u);
}

TEST(MappedCells, RaysThroughTheBlockMeetNoGap) {
    const MappedCells cells(bentCells({12, 9, 7}));
    Random random(3);
    const Vec3 centre = cells.bounds().center();
    std::size_t inside = 0;
    for (int ray = 0; ray < 2000; ++ray) {
        // Through vertices and along grid lines, where cracks would be.
        const Vec3 through = cells.deformed()[random() % cells.deformed().size()];
        const Vec3 towards =
            ray % 2 ? cells.deformed()[random() % cells.deformed().size()] : centre + randomVector(random, 10);
        std::vector<Vec3> p, q;
        for (int n = 0; n <= 400; ++n) p.push_back(through + n / 400.0 * (towards - through));
        q.resize(p.size());
        cells.map(p, q);
        // Between the first and the last point found the block is as good as convex here: its sides bend gently, so a
        // ray may leave by a little at the rim, but a single lost point between two found ones is a crack.
        for (std::size_t n = 1; n + 1 < p.size(); ++n) {
            inside += isDefined(q[n]);
            EXPECT_FALSE(!isDefined(q[n]) && isDefined(q[n - 1]) && isDefined(q[n + 1])) << ray << " " << n;
        }
    }
    EXPECT_GT(inside, 500000u);
}

TEST(MappedCells, FindTheFirstTetrahedronThatContainsAPoint) {
    const MappedCells cells(bentCells({5, 4, 3}));
    Random random(4);
    CellLocation at{};
    std::vector<CellLocation> all;
    int outside = 0;
    for (int n = 0; n < 3000; ++n) {
        const Vec3 p = cells.bounds().center() + randomVector(random, 30);
        const auto expected = containing(cells, p, 0);
        ASSERT_EQ(cells.locate(p, at), !expected.empty());
        outside += expected.empty();
        EXPECT_TRUE(expected.empty() || at.tetrahedron == expected.front());
    }
    EXPECT_GT(outside, 100);
    for (std::size_t v = 0; v < cells.deformed().size(); ++v) {
        const auto expected = containing(cells, cells.deformed()[v], 1e-9);
        ASSERT_TRUE(cells.locate(cells.deformed()[v], at));
        EXPECT_EQ(at.tetrahedron, expected.front()) << "vertex " << v;
        all.clear();
        cells.locateAll(cells.deformed()[v], all);
        ASSERT_EQ(all.size(), 1u) << "one pre-image, though " << expected.size() << " tetrahedra touch it";
        EXPECT_LT(glm::length(cells.sourceAt(all[0]) - cells.source()[v]), 1e-11);
    }
}

TEST(MappedCells, HoldTheirOuterFacesAndNothingBeyond) {
    const MappedCells cells(gridCells({Vec3(10), {Vec3(7, 0, 0), Vec3(0, 5, 0), Vec3(0, 0, 3)}}, {4, 4, 4}));
    CellLocation at{};
    EXPECT_TRUE(cells.locate({10, 12.3, 11.1}, at));
    EXPECT_TRUE(cells.locate({17, 15, 13}, at));
    EXPECT_FALSE(cells.locate({10 - 1e-9, 12.3, 11.1}, at));
    EXPECT_FALSE(cells.locate({17 + 1e-9, 12.3, 11.1}, at));
    EXPECT_FALSE(cells.locate({12, 12, kNaN}, at));
    EXPECT_FALSE(cells.locate({12, 12, kInfinity}, at));
    for (const double w : at.barycentric) EXPECT_GE(w, 0);
}

TEST(MappedCells, AFoldHasAPreImageOnEachSheet) {
    const MappedCells cells = foldedRow();
    EXPECT_TRUE(cells.mayOverlap());
    std::vector<CellLocation> all;
    cells.locateAll({1.5, 0.3, 0.6}, all);
    ASSERT_EQ(all.size(), 3u);
    const std::array<double, 3> q{0.75, 1.5, 2.25};
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(cells.sourceAt(all[n]).x, q[n], 1e-12);
    all.clear();
    cells.locateAll({0.5, 0.3, 0.6}, all);
    EXPECT_EQ(all.size(), 1u);
    all.clear();
    cells.locateAll({2, 0.3, 0.6}, all);
    ASSERT_EQ(all.size(), 2u) << "the crease, where two sheets meet in one source point, and the third sheet";
    EXPECT_NEAR(cells.sourceAt(all[0]).x, 1, 1e-12);
    EXPECT_NEAR(cells.sourceAt(all[1]).x, 2.5, 1e-12);
    const Vec3 p(1.5, 0.3, 0.6);
    Vec3 first;
    cells.map(std::span(&p, 1), std::span(&first, 1));
    EXPECT_NEAR(first.x, 0.75, 1e-12) << "map takes the first cell's";
    EXPECT_LT(*std::min_element(cells.determinants().begin(), cells.determinants().end()), 0);
}

TEST(MappedCells, DegenerateTetrahedraAreNeverFound) {
    auto data = gridCells({Vec3(0), {Vec3(3, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {3, 1, 1});
    for (Vec3& p : data.deformed) p.x = p.x > 1 ? p.x - 1 : p.x;  // the middle cell is squashed flat
    const MappedCells cells(std::move(data));
    for (std::size_t t = 0; t < 18; ++t) EXPECT_EQ(cells.determinants()[t] == 0, t / 6 == 1);
    EXPECT_TRUE(cells.mayOverlap());
    std::vector<CellLocation> all;
    for (const double x : {0.5, 1.0, 1.5}) {
        all.clear();
        cells.locateAll({x, 0.4, 0.7}, all);
        ASSERT_FALSE(all.empty());
        for (const auto& at : all) EXPECT_NE(at.tetrahedron / 6, 1u);
    }
}

TEST(MappedCells, JacobiansOfAnAffineMapAreItsInverse) {
    auto data = gridCells({Vec3(-1), {Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 2)}}, {3, 3, 3});
    const Mat3 m(1.5, 0.2, 0, -0.3, 0.8, 0.1, 0.4, 0, -2);  // it mirrors, too
    for (Vec3& p : data.deformed) p = m * p + Vec3(5, 6, 7);
    const MappedCells cells(std::move(data));
    EXPECT_FALSE(cells.mayOverlap()) << "all cells are mirrored alike";
    const Mat3 expected = glm::inverse(m);
    CellLocation at{};
    ASSERT_TRUE(cells.locate(m * Vec3(0.1, -0.7, 0.4) + Vec3(5, 6, 7), at));
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(cells.jacobianAt(at)[c] - expected[c]), 1e-13);
}

TEST(MappedCells, GivenJacobiansAreInterpolated) {
    auto data = gridCells({Vec3(0), {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {1, 1, 1});
    for (const Vec3& p : data.source) data.jacobian.push_back(Mat3(1 + p.x + 10 * p.y + 100 * p.z));
    const MappedCells cells(std::move(data));
    CellLocation at{};
    ASSERT_TRUE(cells.locate({0.2, 0.5, 0.3}, at));
    EXPECT_NEAR(cells.jacobianAt(at)[0][0], 1 + 0.2 + 5 + 30, 1e-12);
}

TEST(MappedCells, MapIsTheSameForEveryNumberOfThreadsAndInPlace) {
    const MappedCells cells(bentCells({8, 8, 8}));
    Random random(5);
    std::vector<Vec3> p(30000), one(p.size()), all(p.size());
    for (Vec3& at : p) at = cells.bounds().center() + randomVector(random, 30);
    setThreadCount(1);
    cells.map(p, one);
    setThreadCount(4);
    cells.map(p, all);
    cells.map(p, p);
    setThreadCount(0);
    const auto same = [](const Vec3& a, const Vec3& b) { return a == b || (!isDefined(a) && !isDefined(b)); };
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_TRUE(same(one[i], all[i]) && same(one[i], p[i]));
}

TEST(MappedCells, CellsLyingAllOverEachOtherAreLocatedAllTheSame) {
    // A grid cell for each small box would need them all listed everywhere.
    MappedCells::Data data;
    const auto box = gridCells({Vec3(0), {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {1, 1, 1});
    for (std::uint32_t n = 0; n < 3000; ++n) {
        for (const Vec3& p : box.source) {
            data.deformed.push_back(p);
            data.source.push_back(p + Vec3(n, 0, 0));
        }
        auto hexahedron = box.hexahedra[0];
        for (auto& v : hexahedron) v += 8 * n;
        data.hexahedra.push_back(hexahedron);
    }
    const MappedCells cells(std::move(data));
    EXPECT_TRUE(cells.mayOverlap());
    std::vector<CellLocation> all;
    cells.locateAll({0.3, 0.2, 0.6}, all);
    EXPECT_EQ(all.size(), 3000u);
}

TEST(MappedCells, CellsInOnePointAreNowhere) {
    auto data = gridCells(Frame{}, {2, 2, 2});
    for (Vec3& p : data.deformed) p = Vec3(0);
    const MappedCells cells(std::move(data));
    CellLocation at{};
    EXPECT_FALSE(cells.locate(Vec3(0), at));
    EXPECT_TRUE(cells.mayOverlap()) << "undecided, to be safe";
    for (const double d : cells.determinants()) EXPECT_EQ(d, 0);
    for (const Mat3& j : cells.jacobians()) EXPECT_EQ(j, Mat3(1));
}

TEST(MappedCells, SourceBoxesHoldTheSourcesOfABox) {
    for (const double fold : {1.0, -6.0}) {
        auto data = gridCells({Vec3(0), {Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, 10)}}, {6, 5, 4});
        for (Vec3& p : data.deformed) p += fold * Vec3(std::sin(p.y / 3), std::cos(p.z / 4 + 1), std::sin(p.x / 2));
        const MappedCells cells(std::move(data));
        Random random(6);
        std::vector<CellLocation> all;
        std::size_t checked = 0;
        for (int n = 0; n < 400; ++n) {
            const Vec3 corner = cells.bounds().center() + randomVector(random, 8),
                       side = glm::abs(randomVector(random, 2));
            std::vector<Box3> boxes;
            EXPECT_FALSE(cells.anySourceBox({corner, corner + side}, [&](const Box3& box) {
                boxes.push_back(box);
                return false;
            }));
            for (int i = 0; i < 20; ++i) {
                all.clear();
                cells.locateAll(corner + 0.5 * (side + randomVector(random, 1) * side), all);
                for (const CellLocation& at : all) {
                    const Vec3 q = cells.sourceAt(at);
                    EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), [&](const Box3& b) { return b.contains(q); }));
                    ++checked;
                }
            }
            EXPECT_EQ(cells.anySourceBox({corner, corner + side}, [](const Box3&) { return true; }), !boxes.empty());
        }
        EXPECT_GT(checked, 1000u);
    }
}

TEST(MappedCells, RefuseWhatDoesNotFitTogether) {
    const auto good = gridCells(Frame{}, {1, 1, 1});
    auto data = good;
    data.source.pop_back();
    EXPECT_THROW(MappedCells{data}, Error);
    data = good;
    data.hexahedra[0][3] = 8;
    EXPECT_THROW(MappedCells{data}, Error);
    data = good;
    data.deformed[2].y = kNaN;
    EXPECT_THROW(MappedCells{data}, Error);
    data = good;
    data.jacobian.resize(3);
    EXPECT_THROW(MappedCells{data}, Error);
    CellLocation at{};
    const Vec3 p(0.5);
    Vec3 q(1);
    const MappedCells none{MappedCells::Data{}};
    none.map(std::span(&p, 1), std::span(&q, 1));
    EXPECT_FALSE(none.locate(p, at));
    EXPECT_FALSE(isDefined(q));
}

}  // namespace
}  // namespace voledit
