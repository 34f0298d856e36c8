#include "app/editor/panels/gradient_statistics.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

std::uint64_t counted(const VolumeStatistics& statistics) {
    return std::accumulate(statistics.histogram.begin(), statistics.histogram.end(), std::uint64_t(0));
}

// Values grow by 500 a voxel of ten units.
TEST(GradientStatistics, OfARampAreOneNumber) {
    const VolumeStatistics statistics = gradientStatistics(*test::smallVolume());
    EXPECT_EQ(statistics.min, 0);
    EXPECT_NEAR(statistics.max, 50, 1e-9);
    EXPECT_EQ(counted(statistics), 729u);
    EXPECT_EQ(statistics.histogram.back(), 729u);
}

TEST(GradientStatistics, OfAConstantHaveARangeAllTheSame) {
    const auto volume = Volume::fromValues(VolumeGrid{.size = {5, 5, 5}}, std::vector<std::uint8_t>(125, 7));
    const VolumeStatistics statistics = gradientStatistics(*volume);
    EXPECT_GT(statistics.max, statistics.min);
    EXPECT_EQ(statistics.histogram.front(), 125u);
}

TEST(GradientStatistics, LookAtAPartOfALargeVolume) {
    const auto volume =
        Volume::fromValues(VolumeGrid{.size = {120, 90, 100}}, std::vector<std::uint8_t>(120 * 90 * 100, 7));
    const std::uint64_t voxels = counted(gradientStatistics(*volume));
    EXPECT_GT(voxels, 10000u);
    EXPECT_LT(voxels, 60000u);
}

}  // namespace
}  // namespace voledit
