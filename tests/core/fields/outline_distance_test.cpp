#include "core/fields/outline_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voledit {
namespace {

GlyphOutline polygon(const std::vector<Vec2>& corners) {
    GlyphOutline outline;
    for (std::size_t n = 0; n < corners.size(); ++n) {
        outline.segments.push_back({corners[n], corners[(n + 1) % corners.size()]});
        outline.min = glm::min(outline.min, corners[n]);
        outline.max = glm::max(outline.max, corners[n]);
    }
    return outline;
}

GlyphOutline rectangle(const Vec2& a, const Vec2& b) {
    return polygon({a, {b.x, a.y}, b, {a.x, b.y}});
}

/// Signed distance from a rectangle, in closed form.
double fromRectangle(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 q = glm::abs(p - 0.5 * (a + b)) - 0.5 * (b - a);
    return glm::length(glm::max(q, Vec2(0))) + std::min(std::max(q.x, q.y), 0.0);
}

template <class Expected>
void expectDistances(const std::vector<GlyphOutline>& letters, const Expected& expected) {
    const auto table = tabulatedDistance(letters, 0.01, 0.3);
    const Index3 size = table->grid().size;
    for (int k = 0; k < size.z; ++k)
        for (int i = 0; i < size.x; ++i) {
            const Vec3 p = transformPoint(table->grid().worldFromIndex, {i, 0, k});
            ASSERT_NEAR(table->at({i, 0, k}), expected(Vec2(p.x, p.z)), 1e-6) << p.x << " " << p.z;
        }
}

TEST(OutlineDistance, IsExactAtEverySample) {
    expectDistances({rectangle({0.1, 0.2}, {0.7, 0.5})}, [](const Vec2& p) {
        return fromRectangle({0.1, 0.2}, {0.7, 0.5}, p);
    });
}

TEST(OutlineDistance, GridHoldsTheLettersAndTheirMargin) {
    const auto table = tabulatedDistance({rectangle({0.1, 0.2}, {0.7, 0.5})}, 0.01, 0.3);
    const Box3 box = boundsOf(table->grid().worldFrame());
    EXPECT_EQ(table->grid().size.y, 1);
    EXPECT_EQ(table->type(), VoxelType::Float);
    EXPECT_NEAR(box.min.x, -0.2, 1e-12);
    EXPECT_NEAR(box.min.z, -0.1, 1e-12);
    EXPECT_GE(box.max.x, 1.0 - 1e-12);
    EXPECT_GE(box.max.z, 0.8 - 1e-12);
}

TEST(OutlineDistance, AHoleIsOutsideWhereContoursWindOppositeWays) {
    GlyphOutline ring = rectangle({0, 0}, {1, 1});
    for (const OutlineSegment& s : rectangle({0.3, 0.3}, {0.6, 0.7}).segments) ring.segments.push_back({s.to, s.from});
    expectDistances({ring}, [](const Vec2& p) {
        return std::max(fromRectangle({0, 0}, {1, 1}, p), -fromRectangle({0.3, 0.3}, {0.6, 0.7}, p));
    });
}

TEST(OutlineDistance, WhatLiesWithinAnotherIsNoBoundary) {
    // A cross of two bars, as two letters and as two contours of one.
    const auto bar = rectangle({0, 0.4}, {1, 0.6}), post = rectangle({0.4, 0}, {0.6, 1});
    GlyphOutline both = bar;
    both.segments.insert(both.segments.end(), post.segments.begin(), post.segments.end());
    both.min = glm::min(bar.min, post.min);
    both.max = glm::max(bar.max, post.max);
    const auto expected = [](const Vec2& p) {
        const Vec2 q = glm::abs(p - 0.5);
        // By symmetry in one quadrant; the inner corner at (0.1, 0.1) is nearest from inside.
        if (q.x < 0.1 && q.y < 0.1) return -glm::distance(q, Vec2(0.1));
        return std::min(fromRectangle({0, 0.4}, {1, 0.6}, p), fromRectangle({0.4, 0}, {0.6, 1}, p));
    };
    const auto inTheArms = [&](const Vec2& p) {
        const Vec2 q = glm::abs(p - 0.5);
        const double inside = expected(p);
        // Near the middle an arm's own sides end at the inner corners.
        if (inside < 0 && std::max(q.x, q.y) >= 0.1)
            return -std::min({0.1 - std::min(q.x, q.y), 0.5 - std::max(q.x, q.y)});
        return inside;
    };
    expectDistances({bar, post}, inTheArms);
    expectDistances({both}, inTheArms);
    double length = 0;
    for (const OutlineSegment& s : boundaryOf({bar, post})) length += glm::distance(s.from, s.to);
    EXPECT_NEAR(length, 4.0, 1e-9) << "two bars of perimeter 2.4 less four hidden pieces of 0.2";
}

TEST(OutlineDistance, LettersThatShareAnEdgeAreOnePiece) {
    // The shared edge lies inside the union.
    expectDistances({rectangle({0, 0}, {0.5, 1}), rectangle({0.5, 0}, {1, 1})}, [](const Vec2& p) {
        return fromRectangle({0, 0}, {1, 1}, p);
    });
}

}  // namespace
}  // namespace voledit
