#include "core/base/triangles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace voledit {
namespace {

using Corners = std::array<Vec3, 3>;

TEST(Triangles, AnyPairOfBoxesFindsEachMeetingPairOnce) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Box3> boxes(300);
    for (Box3& box : boxes) {
        const Vec3 at(unit(random), unit(random), unit(random));
        box = {at, at + 0.2 * Vec3(unit(random), unit(random), unit(random))};
    }
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    EXPECT_FALSE(anyPairOfBoxes(boxes, [&](std::uint32_t a, std::uint32_t b) {
        found.insert(std::minmax(a, b));
        return false;
    }));
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
            if (!intersect(boxes[a], boxes[b]).empty()) expected.insert({a, b});
    EXPECT_EQ(found, expected);
    EXPECT_GT(expected.size(), 100u);
    EXPECT_TRUE(anyPairOfBoxes(boxes, [](std::uint32_t, std::uint32_t) { return true; }));
    EXPECT_FALSE(anyPairOfBoxes({}, [](std::uint32_t, std::uint32_t) { return true; }));
}

TEST(Triangles, TouchWhenOnePiercesAnother) {
    const Corners flat{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
    EXPECT_TRUE(trianglesTouch(flat, {Vec3(0.5, 0.5, -1), Vec3(0.5, 0.5, 1), Vec3(3, 3, 1)}, 1e-12));
    EXPECT_FALSE(trianglesTouch(flat, {Vec3(1.5, 1.5, -1), Vec3(1.5, 1.5, 1), Vec3(3, 3, 1)}, 1e-12));
    EXPECT_TRUE(trianglesTouch(flat, {Vec3(0.5, 0.5, 0), Vec3(1, 1, 1), Vec3(2, 1, 1)}, 1e-12)) << "a corner on it";
    EXPECT_FALSE(trianglesTouch(flat, {Vec3(0.5, 0.5, 1e-6), Vec3(1, 1, 1), Vec3(2, 1, 1)}, 1e-12));
}

TEST(Triangles, InOnePlaneTouchWhereTheyOverlap) {
    const Corners flat{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
    EXPECT_TRUE(trianglesTouch(flat, {Vec3(0.5, 0.5, 0), Vec3(3, 3, 0), Vec3(3, 0, 0)}, 1e-12));
    EXPECT_FALSE(trianglesTouch(flat, {Vec3(1.5, 1.5, 0), Vec3(3, 3, 0), Vec3(3, 1.5, 0)}, 1e-12));
}

TEST(Triangles, ASegmentIsAFlatTriangle) {
    const Corners flat{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
    EXPECT_TRUE(trianglesTouch({Vec3(0.5, 0.5, -1), Vec3(0.6, 0.4, 1), Vec3(0.6, 0.4, 1)}, flat, 1e-12));
    EXPECT_FALSE(trianglesTouch({Vec3(1.5, 0.6, -1), Vec3(1.6, 0.4, 1), Vec3(1.6, 0.4, 1)}, flat, 1e-12));
}

/// Distance of two triangles by brute force: sampled densely, an upper bound.
double sampledDistance(const Corners& a, const Corners& b) {
    constexpr int n = 24;
    double smallest = kInfinity;
    const auto at = [](const Corners& t, int i, int j) {
        return t[0] + double(i) / n * (t[1] - t[0]) + double(j) / n * (t[2] - t[0]);
    };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            for (int k = 0; k <= n; ++k)
                for (int l = 0; k + l <= n; ++l) smallest = std::min(smallest, glm::length(at(a, i, j) - at(b, k, l)));
    return smallest;
}

TEST(Triangles, AgreeWithDenseSampling) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto corners = [&] {
        Corners t;
        for (Vec3& v : t) v = Vec3(unit(random), unit(random), unit(random));
        return t;
    };
    int touching = 0, apart = 0;
    for (int n = 0; n < 150; ++n) {
        const Corners a = corners(), b = corners();
        const double distance = sampledDistance(a, b);
        if (trianglesTouch(a, b, 0)) {
            ++touching;
            EXPECT_LT(distance, 0.1);
        } else {
            ++apart;
        }
        EXPECT_TRUE(distance >= 1e-3 || trianglesTouch(a, b, 2e-3));
    }
    EXPECT_GT(touching, 10);
    EXPECT_GT(apart, 10);
}

}  // namespace
}  // namespace voledit
