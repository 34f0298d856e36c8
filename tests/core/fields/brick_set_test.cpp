#include "core/fields/brick_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <random>

namespace voledit {
namespace {

constexpr Index3 kCount{13, 7, 9};

std::vector<Index3> cellsOf(Index3 first, Index3 end) {
    std::vector<Index3> cells;
    for (int k = first.z; k < end.z; ++k)
        for (int j = first.y; j < end.y; ++j)
            for (int i = first.x; i < end.x; ++i) cells.push_back({i, j, k});
    return cells;
}

BrickSet randomSet(unsigned seed, double density) {
    std::mt19937 random(seed);
    std::bernoulli_distribution in(density);
    std::vector<std::uint8_t> member(std::size_t(kCount.x * kCount.y * kCount.z));
    for (auto& m : member) m = in(random);
    return {kCount, member};
}

TEST(BrickSet, DistancesAreThoseToTheNearestMember) {
    for (const double density : {0.004, 0.05, 0.5}) {
        const BrickSet set = randomSet(3, density);
        for (const int farthest : {2, 5, 24}) {
            const auto distances = set.distances(farthest);
            std::size_t n = 0;
            for (const Index3& from : cellsOf({0, 0, 0}, kCount)) {
                int nearest = farthest;
                for (const Index3& to : cellsOf({0, 0, 0}, kCount)) {
                    const Index3 away = glm::abs(to - from);
                    if (set.contains(to)) nearest = std::min(nearest, std::max({away.x, away.y, away.z}));
                }
                ASSERT_EQ(int(distances[n++]), nearest) << from.x << " " << from.y << " " << from.z;
            }
        }
    }
}

TEST(BrickSet, AnyIsWhetherABoxHoldsAMember) {
    const BrickSet set = randomSet(7, 0.03);
    std::mt19937 random(1);
    std::uniform_int_distribution<int> place(-4, 16);
    for (int n = 0; n < 2000; ++n) {
        const Index3 first(place(random), place(random), place(random)),
            end(place(random), place(random), place(random));
        bool expected = false;
        for (const Index3& c : cellsOf(glm::max(first, Index3(0)), glm::min(end, kCount)))
            expected = expected || set.contains(c);
        ASSERT_EQ(set.any(first, end), expected);
    }
}

TEST(BrickSet, BoundsHoldAllMembers) {
    const BrickSet set = randomSet(11, 0.01);
    Index3 first = kCount, end(0);
    std::size_t size = 0;
    for (const Index3& c : cellsOf({0, 0, 0}, kCount)) {
        if (!set.contains(c)) continue;
        ++size;
        first = glm::min(first, c);
        end = glm::max(end, c + 1);
    }
    EXPECT_EQ(set.first(), first);
    EXPECT_EQ(set.end(), end);
    EXPECT_EQ(set.size(), size);
    EXPECT_TRUE(BrickSet(kCount, std::vector<std::uint8_t>(set.distances(1).size(), 0)).empty());
}

}  // namespace
}  // namespace voledit
