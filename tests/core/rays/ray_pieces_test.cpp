#include "core/rays/ray_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace voledit {
namespace {

TEST(RayPieces, AreSorted) {
    std::vector<CellHit> whole;
    for (unsigned n = 0; n < 40; ++n) whole.push_back({float(n), float(n + 1), n});
    std::vector<CellHit> hits = whole;
    std::shuffle(hits.begin(), hits.end(), std::mt19937(3));
    const auto pieces = orderedPieces(hits);
    ASSERT_EQ(pieces.size(), whole.size());
    for (std::size_t n = 0; n < whole.size(); ++n) {
        EXPECT_EQ(pieces[n].cell, whole[n].cell);
        EXPECT_EQ(pieces[n].begin, whole[n].begin);
        EXPECT_EQ(pieces[n].end, whole[n].end);
    }
}

TEST(RayPieces, NeitherOverlapNorLeaveCracks) {
    std::vector<CellHit> hits{{3.001F, 4, 2}, {0, 1.001F, 0}, {1, 3, 1}, {1, 1.0005F, 7}, {6, 8, 3}};
    const auto pieces = orderedPieces(hits);
    ASSERT_EQ(pieces.size(), 4U);
    for (std::size_t n = 1; n < 3; ++n) EXPECT_EQ(pieces[n].begin, pieces[n - 1].end);
    EXPECT_EQ(pieces[3].begin, 6);
    EXPECT_EQ(pieces[2].end, 4);
}

TEST(RayPieces, NothingGivesNothing) {
    EXPECT_TRUE(orderedPieces({}).empty());
}

}  // namespace
}  // namespace voledit
