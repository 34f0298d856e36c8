#include "render/cell_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "core/base/types.h"

namespace voledit {
namespace {

/// Cuts a cell by many planes: the polygon must hold each crossed edge once, and be convex in the order given.
void checkAgainstPlanes(std::span<const Vec3> corners, std::span<const std::array<int, 2>> edges,
                        std::span<const CutPolygon> cuts) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    int hits = 0;
    for (int n = 0; n < 5000; ++n) {
        const Vec3 direction = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
        const double offset = 0.5 * normal(random);
        const auto side = [&](int v) { return glm::dot(corners[std::size_t(v)] - Vec3(0.5), direction) - offset; };
        unsigned mask = 0;
        for (int v = 0; v < int(corners.size()); ++v) mask |= unsigned(side(v) < 0) << v;
        std::set<int> crossed;
        for (int e = 0; e < int(edges.size()); ++e)
            if ((side(edges[std::size_t(e)][0]) < 0) != (side(edges[std::size_t(e)][1]) < 0)) crossed.insert(e);
        const CutPolygon& polygon = cuts[mask];
        ASSERT_EQ(std::set<int>(polygon.edge.begin(), polygon.edge.begin() + polygon.count), crossed);
        if (crossed.empty()) continue;
        ++hits;
        std::vector<Vec3> points;
        for (int i = 0; i < polygon.count; ++i) {
            const auto [a, b] = edges[polygon.edge[std::size_t(i)]];
            const double t = side(a) / (side(a) - side(b));
            points.push_back(corners[std::size_t(a)] * (1 - t) + corners[std::size_t(b)] * t);
        }
        double turn = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3 &p = points[i], &q = points[(i + 1) % points.size()], &r = points[(i + 2) % points.size()];
            const double here = glm::dot(glm::cross(q - p, r - q), direction);
            if (std::abs(here) < 1e-12) continue;
            ASSERT_GT(here * (turn == 0 ? here : turn), 0) << "not convex";
            turn = here;
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(CellCut, TetrahedraGiveConvexPolygons) {
    const std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(1, 0, 0.1), Vec3(0, 1, 0), Vec3(0.2, 0.3, 1)};
    checkAgainstPlanes(corners, kTetrahedronEdges, tetrahedronCuts());
}

TEST(CellCut, BricksGiveConvexPolygons) {
    std::array<Vec3, 8> corners;
    for (int v = 0; v < 8; ++v) corners[std::size_t(v)] = Vec3(v & 1, v >> 1 & 1, v >> 2);
    checkAgainstPlanes(corners, kBrickEdges, brickCuts());
}

}  // namespace
}  // namespace voledit
