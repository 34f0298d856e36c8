#include "core/fields/volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

namespace voledit {
namespace {

/// A sheared, mirrored, far-away grid: nothing about it is convenient.
VolumeGrid obliqueGrid(Index3 size, int channels = 1) {
    VolumeGrid grid{size, channels, Mat4(1.0)};
    grid.worldFromIndex[0] = Vec4(0.7, 0.1, -0.2, 0);
    grid.worldFromIndex[1] = Vec4(-0.3, -1.1, 0.4, 0);
    grid.worldFromIndex[2] = Vec4(0.05, 0.2, 2.5, 0);
    grid.worldFromIndex[3] = Vec4(1234.5, -987.6, 31.41, 1);
    return grid;
}

template <class T>
std::vector<T> randomValues(std::size_t count, std::mt19937& random) {
    std::vector<T> values(count);
    for (T& v : values) {
        if constexpr (std::is_floating_point_v<T>)
            v = T(std::normal_distribution<double>(0, 1000)(random));
        else
            v = T(random());
    }
    return values;
}

double valueAt(const Volume& volume, const Vec3& p, int channel = 0) {
    double value = 0;
    volume.sample(std::span(&p, 1), std::span(&value, 1), channel);
    return value;
}

Vec3 gradientAt(const Volume& volume, const Vec3& p) {
    Vec3 gradient;
    volume.gradient(std::span(&p, 1), std::span(&gradient, 1));
    return gradient;
}

template <class T>
class VolumeOfType : public testing::Test {};
using Types =
    testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, float, double>;
TYPED_TEST_SUITE(VolumeOfType, Types);

TYPED_TEST(VolumeOfType, GivesItsSamplesToTheBit) {
    std::mt19937 random(1);
    const VolumeGrid grid = obliqueGrid({5, 4, 6}, 2);
    const auto values = randomValues<TypeParam>(grid.valueCount(), random);
    const auto volume = Volume::fromValues(grid, values);
    std::size_t n = 0;
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i)
                for (int c = 0; c < 2; ++c, ++n) {
                    EXPECT_EQ(volume->at({i, j, k}, c), double(values[n]));
                    EXPECT_EQ(valueAt(*volume, transformPoint(grid.worldFromIndex, {i, j, k}), c), double(values[n]));
                }
}

TYPED_TEST(VolumeOfType, InterpolatesByTheEightNeighboursWeights) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    const VolumeGrid grid = obliqueGrid({5, 4, 6}, 3);
    const auto volume = Volume::fromValues(grid, randomValues<TypeParam>(grid.valueCount(), random));
    const auto [low, high] = std::pair{volume->statistics().min, volume->statistics().max};
    for (int n = 0; n < 2000; ++n) {
        const Vec3 x = Vec3(unit(random), unit(random), unit(random)) * Vec3(4, 3, 5);
        const int channel = n % 3;
        double expected = 0;
        for (int corner = 0; corner < 8; ++corner) {
            double weight = 1;
            Index3 at;
            for (int a = 0; a < 3; ++a) {
                const int below = std::min(int(x[a]), grid.size[a] - 2), bit = corner >> a & 1;
                at[a] = below + bit;
                weight *= bit ? x[a] - below : 1 - (x[a] - below);
            }
            expected += weight * volume->at(at, channel);
        }
        EXPECT_NEAR(valueAt(*volume, transformPoint(grid.worldFromIndex, x), channel), expected,
                    1e-10 * std::max(std::abs(low), std::abs(high)));
    }
}

TEST(Volume, ReproducesAffineFieldsAndTheirGradients) {
    const VolumeGrid grid = obliqueGrid({6, 5, 4});
    const Vec3 slope(3, -2, 0.5);
    const auto field = [&](const Vec3& p) { return glm::dot(slope, p) + 17; };
    std::vector<double> values;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 6; ++i) values.push_back(field(transformPoint(grid.worldFromIndex, {i, j, k})));
    const auto volume = Volume::fromValues(grid, std::move(values));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 500; ++n) {
        Vec3 x = Vec3(unit(random), unit(random), unit(random)) * Vec3(5, 4, 3);
        if (n % 4 == 0) x[n % 3] = n % 8 ? 0 : grid.size[n % 3] - 1;  // on the domain's faces, too
        const Vec3 p = transformPoint(grid.worldFromIndex, x);
        EXPECT_NEAR(valueAt(*volume, p), field(p), 1e-9);
        EXPECT_LT(glm::length(gradientAt(*volume, p) - slope), 1e-8);
    }
}

TEST(Volume, GradientIsTheDifferenceOfOneVoxel) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    const VolumeGrid grid = obliqueGrid({6, 5, 7});
    const auto volume = Volume::fromValues(grid, randomValues<std::int16_t>(grid.valueCount(), random));
    for (int n = 0; n < 500; ++n) {
        const Vec3 x = Vec3(unit(random), unit(random), unit(random)) * Vec3(5, 4, 6);
        Vec3 g;
        for (int a = 0; a < 3; ++a) {
            Vec3 ahead = x, behind = x;
            ahead[a] = std::min(x[a] + 1, grid.size[a] - 1.0);
            behind[a] = std::max(x[a] - 1, 0.0);
            g[a] = (valueAt(*volume, transformPoint(grid.worldFromIndex, ahead)) -
                    valueAt(*volume, transformPoint(grid.worldFromIndex, behind))) /
                   (ahead[a] - behind[a]);
        }
        const Vec3 expected = glm::transpose(glm::inverse(Mat3(grid.worldFromIndex))) * g;
        EXPECT_LT(glm::length(gradientAt(*volume, transformPoint(grid.worldFromIndex, x)) - expected),
                  1e-9 * (1 + glm::length(expected)));
    }
}

TEST(Volume, DomainEndsAThousandthOfAVoxelBeyondItsSamples) {
    VolumeGrid grid{{3, 3, 3}, 1, Mat4(1.0)};
    grid.worldFromIndex[0][0] = 2;
    const auto volume = Volume::fromValues(grid, std::vector<float>(27, 5));
    EXPECT_EQ(valueAt(*volume, {-0.0018, 1, 1}), 5);
    EXPECT_TRUE(std::isnan(valueAt(*volume, {-0.0022, 1, 1})));
    EXPECT_EQ(valueAt(*volume, {4.0018, 1, 1}), 5);
    EXPECT_TRUE(std::isnan(valueAt(*volume, {4.0022, 1, 1})));
    EXPECT_TRUE(std::isnan(valueAt(*volume, {1, 1, 2.0011})));
    EXPECT_EQ(valueAt(*volume, {4.002, 2.001, -0.001}), 5) << "just that far, too";
    EXPECT_TRUE(std::isnan(valueAt(*volume, kUndefined)));
    EXPECT_TRUE(std::isnan(valueAt(*volume, {1, kInfinity, 1})));
    EXPECT_EQ(gradientAt(*volume, {-1, 1, 1}), Vec3(0));
}

TEST(Volume, AnAxisOfOneSampleIsOneSpacingThick) {
    VolumeGrid grid{{2, 2, 1}, 1, Mat4(1.0)};
    grid.worldFromIndex[2][2] = 4;
    const auto volume = Volume::fromValues(grid, std::vector<std::uint8_t>{0, 10, 20, 30});
    EXPECT_EQ(valueAt(*volume, {0.5, 0.5, 1.99}), 15);
    EXPECT_EQ(valueAt(*volume, {1, 1, -2}), 30);
    EXPECT_TRUE(std::isnan(valueAt(*volume, {0.5, 0.5, 2.01})));
    EXPECT_EQ(gradientAt(*volume, {0.5, 0.5, 1.5}), Vec3(10, 20, 0));
    EXPECT_EQ(grid.worldFrame().corner, Vec3(0, 0, -2));
    EXPECT_EQ(grid.worldFrame().edge[2], Vec3(0, 0, 4));
}

TEST(Volume, ANaNSampleDoesNotReachItsNeighboursPlaces) {
    const VolumeGrid grid{{3, 1, 1}, 1, Mat4(1.0)};
    const auto volume = Volume::fromValues(grid, std::vector<float>{1, NAN, 3});
    EXPECT_EQ(valueAt(*volume, {0, 0, 0}), 1);
    EXPECT_EQ(valueAt(*volume, {2, 0, 0}), 3);
    EXPECT_TRUE(std::isnan(valueAt(*volume, {0.5, 0, 0})));
}

double valueBy(const Volume& volume, const Vec3& p, Interpolation by) {
    double value = 0;
    volume.sample(std::span(&p, 1), std::span(&value, 1), 0, by);
    return value;
}

Vec3 gradientBy(const Volume& volume, const Vec3& p, Interpolation by) {
    Vec3 gradient;
    volume.gradient(std::span(&p, 1), std::span(&gradient, 1), 0, by);
    return gradient;
}

TEST(Volume, NearestIsTheStoredValueOfTheNearestSample) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(0, 1);
    const VolumeGrid grid = obliqueGrid({5, 4, 6});
    const auto volume = Volume::fromValues(grid, randomValues<std::int16_t>(grid.valueCount(), random));
    for (int n = 0; n < 1000; ++n) {
        const Vec3 x = Vec3(unit(random), unit(random), unit(random)) * Vec3(4, 3, 5);
        const Vec3 p = transformPoint(grid.worldFromIndex, x);
        EXPECT_EQ(valueBy(*volume, p, Interpolation::Nearest), volume->at(Index3(glm::round(x))));
        EXPECT_EQ(gradientBy(*volume, p, Interpolation::Nearest), gradientAt(*volume, p));
    }
    const auto row = Volume::fromValues({{3, 1, 1}, 1, Mat4(1.0)}, std::vector<float>{1, 2, 3});
    EXPECT_EQ(valueBy(*row, {0.5, 0, 0}, Interpolation::Nearest), 2) << "halfway: the larger index";
    EXPECT_TRUE(std::isnan(valueBy(*row, {2.1, 0, 0}, Interpolation::Nearest)));
}

/// The uniform cubic B-spline by its definition: the box convolved with itself three times.
double cubicKernel(double t) {
    t = std::abs(t);
    return t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0;
}

TEST(Volume, CubicIsTheSamplesUnderTheBSplineKernel) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    VolumeGrid grid = obliqueGrid({5, 4, 6});
    grid.worldFromIndex[3] = Vec4(1, 2, 3, 1);  // near: values as steep as these magnify the rounding of far places
    const auto volume = Volume::fromValues(grid, randomValues<std::int16_t>(grid.valueCount(), random));
    for (int n = 0; n < 500; ++n) {
        Vec3 x = Vec3(unit(random), unit(random), unit(random)) * Vec3(4, 3, 5);
        if (n % 5 == 0) x = glm::round(x);
        double expected = 0;
        for (int k = -2; k < 9; ++k)
            for (int j = -2; j < 9; ++j)
                for (int i = -2; i < 9; ++i)
                    expected += cubicKernel(x.x - i) * cubicKernel(x.y - j) * cubicKernel(x.z - k) *
                                volume->at(glm::clamp(Index3(i, j, k), Index3(0), grid.size - 1));
        EXPECT_NEAR(valueBy(*volume, transformPoint(grid.worldFromIndex, x), Interpolation::Cubic), expected, 1e-8);
    }
}

TEST(Volume, CubicIsSmoothAndItsGradientItsOwn) {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> unit(0, 1);
    VolumeGrid grid = obliqueGrid({6, 5, 7});
    grid.worldFromIndex[3] = Vec4(1, 2, 3, 1);
    const auto volume = Volume::fromValues(grid, randomValues<std::uint8_t>(grid.valueCount(), random));
    for (int n = 0; n < 400; ++n) {
        const Vec3 x = 0.1 + Vec3(unit(random), unit(random), unit(random)) * Vec3(4.8, 3.8, 5.8);
        const Vec3 p =
            transformPoint(grid.worldFromIndex, n % 4 ? x : glm::clamp(glm::round(x), Vec3(1), Vec3(4, 3, 5)));
        const Vec3 found = gradientBy(*volume, p, Interpolation::Cubic);
        for (int a = 0; a < 3; ++a) {
            Vec3 h(0);
            h[a] = 1e-5;
            const double ahead = valueBy(*volume, p + h, Interpolation::Cubic),
                         behind = valueBy(*volume, p - h, Interpolation::Cubic);
            EXPECT_NEAR(found[a], (ahead - behind) / 2e-5, 1e-3);
        }
    }
    const auto flat = Volume::fromValues({{4, 4, 1}, 1, Mat4(1.0)}, std::vector<float>(16, 3));
    EXPECT_NEAR(valueBy(*flat, {1.3, 2.2, 0.4}, Interpolation::Cubic), 3, 1e-12);
    EXPECT_EQ(gradientBy(*flat, {1.3, 2.2, 0.4}, Interpolation::Cubic).z, 0);
}

TEST(Volume, CubicKeepsAffineFieldsAwayFromTheBorder) {
    const VolumeGrid grid = obliqueGrid({8, 7, 6});
    const Vec3 slope(3, -2, 0.5);
    std::vector<double> values;
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 8; ++i)
                values.push_back(glm::dot(slope, transformPoint(grid.worldFromIndex, {i, j, k})));
    const auto volume = Volume::fromValues(grid, std::move(values));
    const Vec3 p = transformPoint(grid.worldFromIndex, {3.4, 2.7, 2.2});
    EXPECT_NEAR(valueBy(*volume, p, Interpolation::Cubic), glm::dot(slope, p), 1e-9);
    EXPECT_LT(glm::length(gradientBy(*volume, p, Interpolation::Cubic) - slope), 1e-9);
}

TEST(VolumeGrid, DirectionsAreUnitColumnsAndSpacingTheirLengths) {
    const VolumeGrid grid = obliqueGrid({2, 2, 2});
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(glm::length(grid.direction()[a]), 1, 1e-15);
        EXPECT_LT(glm::length(grid.direction()[a] * grid.spacing()[a] - Vec3(grid.worldFromIndex[a])), 1e-15);
    }
    EXPECT_EQ(grid.origin(), Vec3(1234.5, -987.6, 31.41));
}

TEST(VoxelType, NamesAndSizesAreTheContracts) {
    const std::vector<std::pair<std::string, std::size_t>> expected{{"int8", 1},   {"uint8", 1}, {"int16", 2},
                                                                    {"uint16", 2}, {"int32", 4}, {"uint32", 4},
                                                                    {"float", 4},  {"double", 8}};
    for (std::size_t t = 0; t < expected.size(); ++t) {
        const auto type = voxelTypeOf(expected[t].first);
        ASSERT_EQ(type, VoxelType(t));
        EXPECT_EQ(nameOf(*type), expected[t].first);
        EXPECT_EQ(byteSize(*type), expected[t].second);
    }
    EXPECT_EQ(voxelTypeOf("int64"), std::nullopt);
    EXPECT_EQ(rangeOf(VoxelType::Int16), (std::pair{-32768.0, 32767.0}));
    EXPECT_EQ(rangeOf(VoxelType::UInt32), (std::pair{0.0, 4294967295.0}));
    EXPECT_EQ(rangeOf(VoxelType::Float), (std::pair{-kInfinity, kInfinity}));
}

}  // namespace
}  // namespace voledit
