#include "core/base/box3.h"

#include <gtest/gtest.h>

#include <random>

namespace voledit {
namespace {

TEST(Box3, MovedItHoldsItsMovedCornersAndNoMore) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int n = 0; n < 200; ++n) {
        Mat4 m(1.0);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) m[c][r] = unit(random);
        const Vec3 corner(unit(random), unit(random), unit(random));
        const Box3 box{corner, corner + 1.0 + Vec3(unit(random), unit(random), unit(random))};
        const Box3 found = movedBox(box, m), expected = transformed(box, m);
        for (int a = 0; a < 3; ++a) {
            EXPECT_NEAR(found.min[a], expected.min[a], 1e-14);
            EXPECT_NEAR(found.max[a], expected.max[a], 1e-14);
        }
    }
}

TEST(Box3, MovedNothingStaysNothingAndEverythingEverything) {
    const Mat4 m(2.0);
    EXPECT_TRUE(movedBox(Box3{}, m).empty());
    const Box3 everything{Vec3(-kInfinity), Vec3(kInfinity)};
    EXPECT_EQ(movedBox(everything, m), everything);
    EXPECT_EQ(movedBox({Vec3(0), Vec3(1, kInfinity, 1)}, m), everything);
}

}  // namespace
}  // namespace voledit
