#include "core/rigging/opaque_voxels.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace voledit {
namespace {

/// A ramp along i: value i, opacity value / 10.
TermPtr rampTerm(const Index3& size, const Mat4& worldFromIndex) {
    VolumeGrid grid;
    grid.size = size;
    grid.worldFromIndex = worldFromIndex;
    std::vector<float> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) values.push_back(static_cast<float>(i));
    return makeVolumeTerm(Volume::fromValues(grid, values), 0, greyRamp(0, 10));
}

Mat4 placed(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
    return {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(origin, 1)};
}

TEST(OpaqueVoxels, AVolumesOwnSamplesAreTheCells) {
    // Axes exchanged and turned round, spacings that differ.
    const Mat4 grid = placed({0, 0, -2}, {0.5, 0, 0}, {0, 1, 0}, {10, 20, 30});
    const auto term = rampTerm({11, 4, 3}, grid);
    const auto voxels = opaqueVoxels(*term, 0.5);
    EXPECT_EQ(voxels.size, Index3(4, 3, 11));
    EXPECT_EQ(voxels.spacing, Vec3(0.5, 1, 2));
    EXPECT_EQ(voxels.origin, Vec3(10, 20, 10));
    EXPECT_EQ(voxels.count(), 4u * 3 * 6);  // values 5 … 10
    // Value i stands at z = 30 − 2 i.
    EXPECT_EQ(voxels.bounds().max.z, 20);
    EXPECT_EQ(voxels.bounds().min.z, 10);
}

TEST(OpaqueVoxels, LargerVolumesAndTurnedOnesAreSampledInCubes) {
    const auto straight = rampTerm({11, 4, 3}, Mat4(1.0));
    const auto coarse = opaqueVoxels(*straight, 0.5, 5);
    EXPECT_EQ(std::max({coarse.size.x, coarse.size.y, coarse.size.z}), 5);
    EXPECT_EQ(coarse.spacing, Vec3(2.0));
    const double c = std::cos(0.3), s = std::sin(0.3);
    const auto turned = rampTerm({11, 4, 3}, placed({c, s, 0}, {-s, c, 0}, {0, 0, 1}, Vec3(0)));
    const auto voxels = opaqueVoxels(*turned, 0.5, 64);
    EXPECT_EQ(voxels.spacing.x, voxels.spacing.y);
    EXPECT_GT(voxels.count(), 0u);
}

TEST(OpaqueVoxels, AreTheSamplesAtOrAboveTheThreshold) {
    const auto term = rampTerm({11, 6, 5}, placed({1, 0.2, 0}, {0, 1, 0}, {0, 0, 1}, Vec3(0)));
    for (const double threshold : {0.02, 0.5, 1.0}) {
        const auto voxels = opaqueVoxels(*term, threshold, 40);
        std::size_t expected = 0;
        for (Index3 c(0); c.z < voxels.size.z; ++c.z)
            for (c.y = 0; c.y < voxels.size.y; ++c.y)
                for (c.x = 0; c.x < voxels.size.x; ++c.x) {
                    const Vec3 p = voxels.centre(c);
                    ObjectSample found;
                    sample(*term, {&p, 1}, {&found, 1}, false);
                    EXPECT_EQ(voxels.opaque[voxels.indexOf(c)], found.opacity >= threshold ? 1 : 0);
                    expected += found.opacity >= threshold ? 1 : 0;
                }
        EXPECT_EQ(voxels.count(), expected);
    }
}

TEST(OpaqueVoxels, OfEmptyAndFlatObjects) {
    OpaqueVoxels nothing;
    EXPECT_EQ(nothing.count(), 0u);
    EXPECT_TRUE(nothing.bounds().empty());
    const auto flat = opaqueVoxels(*rampTerm({11, 4, 1}, Mat4(1.0)), 0.5);
    EXPECT_EQ(flat.size, Index3(11, 4, 1));
    EXPECT_EQ(flat.count(), 6u * 4);
}

TEST(OpaqueVoxels, CanBeStopped) {
    Progress progress;
    progress.cancel();
    const auto term = rampTerm({11, 4, 3}, Mat4(1.0));
    EXPECT_THROW(opaqueVoxels(*term, 0.5, 256, &progress), Cancelled);
}

TEST(OpaqueVoxels, NeedsBounds) {
    Term term = *rampTerm({11, 4, 3}, Mat4(1.0));
    term.bounds = {Vec3(-kInfinity), Vec3(kInfinity)};
    EXPECT_THROW(opaqueVoxels(term, 0.5, 5), Error);
    term.bounds = {};
    EXPECT_EQ(opaqueVoxels(term, 0.5, 5).count(), 0u);
}

}  // namespace
}  // namespace voledit
