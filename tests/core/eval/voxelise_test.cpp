#include "core/eval/voxelise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

using namespace test;

const Camera kCamera;

VolumeGrid obliqueGrid(Index3 size) {
    VolumeGrid grid{size, 1, placementMatrix({10.1, -20.2, 30.3}, {0.3, -0.2, 0.1}, {0.7, 1.1, 2.3})};
    return grid;
}

template <class T>
std::shared_ptr<const Volume> noise(const VolumeGrid& grid) {
    std::mt19937 random(1);
    std::vector<T> values(grid.valueCount());
    for (T& v : values) v = T(std::normal_distribution<double>(50, 30)(random));
    return Volume::fromValues(grid, std::move(values));
}

std::shared_ptr<const Volume> voxelised(const TermPtr& root, VoxeliseWhat what, const VolumeGrid& grid,
                                        VoxelType type = VoxelType::Double, double fill = 0) {
    return voxelise(sceneOf(root, kCamera, 1), {grid, what, type, fill});
}

std::vector<double> valuesOf(const Volume& volume) {
    std::vector<double> values;
    for (int k = 0; k < volume.grid().size.z; ++k)
        for (int j = 0; j < volume.grid().size.y; ++j)
            for (int i = 0; i < volume.grid().size.x; ++i)
                for (int c = 0; c < volume.grid().channels; ++c) values.push_back(volume.at({i, j, k}, c));
    return values;
}

template <class T>
class VoxeliseOfType : public testing::Test {};
using Types =
    testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t, float, double>;
TYPED_TEST_SUITE(VoxeliseOfType, Types);

TYPED_TEST(VoxeliseOfType, AnUndeformedScalarOnItsOwnGridIsTheVolumeToTheBit) {
    const auto volume = noise<TypeParam>(obliqueGrid({7, 5, 6}));
    const auto term = makeVolumeTerm(volume, 0, constantLook(0.5, Vec3(1)));
    const auto out = voxelised(term, VoxeliseWhat::Scalar, volume->grid(), volume->type());
    EXPECT_EQ(out->type(), volume->type());
    EXPECT_EQ(out->grid(), volume->grid());
    EXPECT_TRUE(std::equal(out->voxels().begin(), out->voxels().end(), volume->voxels().begin()));
}

TEST(Voxelise, ValuesAreRoundedAndClampedToTheirType) {
    const VolumeGrid grid{{6, 1, 1}, 1, Mat4(1.0)};
    const auto volume = Volume::fromValues(grid, std::vector<double>{-1e9, -2.5, 0.49, 2.5, 127.6, kNaN});
    const auto term = makeVolumeTerm(volume, 0, constantLook(0.5, Vec3(1)));
    EXPECT_EQ(valuesOf(*voxelised(term, VoxeliseWhat::Scalar, grid, VoxelType::Int8, 7)),
              (std::vector<double>{-128, -3, 0, 3, 127, 7}));
    EXPECT_EQ(valuesOf(*voxelised(term, VoxeliseWhat::Scalar, grid, VoxelType::UInt32, -7)),
              (std::vector<double>{0, 0, 0, 3, 128, 0}));
}

TEST(Voxelise, AScalarIsFilledOutsideAndWhereUndefined) {
    const auto volume = sampledVolume(5, [](const Vec3& p) { return p.x; });
    const auto term =
        makeTransferTerm(bentLattice(0, 4), makeVolumeTerm(volume, 0, constantLook(1, Vec3(1))), Combine::Union, "");
    const VolumeGrid grid = cellCentredGrid({Vec3(-2), Vec3(2)}, {8, 8, 8}, 1);
    const auto out = voxelised(term, VoxeliseWhat::Scalar, grid, VoxelType::Float, -1000);
    EXPECT_EQ(out->at({0, 4, 4}), -1000);
    EXPECT_NEAR(out->at({4, 4, 4}), 0.25, 1e-6);
}

TEST(Voxelise, OpacityAndColourAreTheTerms) {
    const auto volume = sampledVolume(5, [](const Vec3& p) { return p.x; });
    TransferFunction f = constantLook(0, Vec3(0.25, 0.5, 0.75));
    f.opacity.points = {{-1, 0}, {1, 1}};
    const auto term = makeVolumeTerm(volume, 0, f);
    const VolumeGrid grid = cellCentredGrid({Vec3(-1), Vec3(1)}, {4, 2, 2}, 1);
    EXPECT_NEAR(voxelised(term, VoxeliseWhat::Opacity, grid)->at({3, 1, 0}), 0.875, 1e-12);
    const auto rgba = voxelised(term, VoxeliseWhat::Rgba, grid);
    ASSERT_EQ(rgba->grid().channels, 4);
    EXPECT_EQ(rgba->at({3, 1, 0}, 0), 0.25);
    EXPECT_EQ(rgba->at({3, 1, 0}, 2), 0.75);
    EXPECT_NEAR(rgba->at({3, 1, 0}, 3), 0.875, 1e-12);
}

TEST(Voxelise, DisplacementIsThatOfTheOutermostTransfersWholeList) {
    const auto volume = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, constantLook(1, Vec3(1)));
    const auto moved = [](const Vec3& by) {
        return std::make_shared<AffineMap>(placementMatrix(by, Vec3(0), Vec3(1)));
    };
    // place · [s1, s2] · another transfer below, which does not count
    const auto inner = makeTransferTerm(moved({100, 0, 0}), volume, Combine::Union, "");
    const auto s1 = makeTransferTerm(std::make_shared<AffineMap>(placementMatrix(Vec3(0), Vec3(0), Vec3(2, 1, 1))),
                                     inner, Combine::Union, "s1", TransferRole::SameList);
    const auto s2 = makeTransferTerm(moved({0, 3, 0}), s1, Combine::Union, "s2");
    const VolumeGrid grid = cellCentredGrid({Vec3(0), Vec3(4)}, {2, 2, 2}, 1);
    const auto out = voxelised(s2, VoxeliseWhat::Displacement, grid);
    ASSERT_EQ(out->grid().channels, 3);
    const auto at = [](const Volume& v, Index3 i) { return Vec3(v.at(i, 0), v.at(i, 1), v.at(i, 2)); };
    EXPECT_EQ(at(*out, {1, 0, 0}), Vec3(-1.5, -3, 0)) << "q.x = 3 / 2, q.y = 1 − 3";
    const auto placed = makeTransferTerm(moved({10, 0, 0}), s2, Combine::Union, "", TransferRole::Place);
    VolumeGrid there = grid;
    there.worldFromIndex[3].x += 10;
    EXPECT_EQ(at(*voxelised(placed, VoxeliseWhat::Displacement, there), {1, 0, 0}), Vec3(-1.5, -3, 0));
}

TEST(Voxelise, DisplacementIsNotANumberWhereUndefined) {
    const auto term = makeTransferTerm(
        bentLattice(0, 4), makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, {}), Combine::Union, "");
    const auto out = voxelised(term, VoxeliseWhat::Displacement, cellCentredGrid({Vec3(-2), Vec3(2)}, {4, 4, 4}, 1),
                               VoxelType::Float);
    EXPECT_TRUE(std::isnan(out->at({0, 1, 1}, 2)));
    EXPECT_NEAR(out->at({1, 1, 1}, 2), 0, 1e-12);
}

TEST(Voxelise, SaysWhatTheRootLacks) {
    const auto bare = makeVolumeTerm(sampledVolume(3, [](const Vec3&) { return 1; }), 0, {});
    EXPECT_THROW(voxelised(bare, VoxeliseWhat::Displacement, cellCentredGrid({Vec3(0), Vec3(1)}, {1, 1, 1}, 1)), Error);
}

TEST(Voxelise, AFoldedScalarIsThatOfTheLargestOpacity) {
    // Pulled far through: points have several pre-images. Checked against locating them all.
    const auto map = bentLattice(-2, 8);
    ASSERT_TRUE(map->cells()->mayOverlap());
    const auto volume = sampledVolume(9, [](const Vec3& p) { return p.x + 2 * p.y + 3 * p.z; });
    TransferFunction f = constantLook(0, Vec3(1));
    f.opacity.points = {{-6, 1}, {0, 0}, {6, 1}};
    for (const Combine combine : {Combine::Union, Combine::Merge, Combine::First, Combine::Intersection}) {
        const auto term = makeTransferTerm(map, makeVolumeTerm(volume, 0, f), combine, "");
        const VolumeGrid grid = cellCentredGrid({Vec3(-1.5), Vec3(1.5)}, {20, 20, 20}, 1);
        const auto out = voxelised(term, VoxeliseWhat::Scalar, grid, VoxelType::Double, -99);
        int folded = 0;
        std::vector<CellLocation> all;
        for (int n = 0; n < 8000; ++n) {
            const Index3 at(n % 20, n / 20 % 20, n / 400);
            all.clear();
            map->cells()->locateAll(transformPoint(grid.worldFromIndex, Vec3(at)), all);
            double best = -1, expected = -99;
            for (const CellLocation& location : all) {
                const Vec3 q = map->cells()->sourceAt(location);
                double value = 0;
                volume->sample(std::span(&q, 1), std::span(&value, 1));
                if (f.opacity(value) > best) {
                    best = f.opacity(value);
                    expected = value;
                }
            }
            folded += all.size() > 1;
            EXPECT_EQ(out->at(at), expected);
        }
        EXPECT_GT(folded, 100);
    }
}

TEST(Voxelise, CellsAreSampledAtTheirCentres) {
    const VolumeGrid grid = cellCentredGrid({Vec3(1, 2, 3), Vec3(5, 4, 4)}, {4, 4, 1}, 3);
    EXPECT_EQ(grid.channels, 3);
    EXPECT_EQ(grid.origin(), Vec3(1.5, 2.25, 3.5));
    EXPECT_EQ(grid.spacing(), Vec3(1, 0.5, 1));
}

TEST(Voxelise, IsTheSameForEveryNumberOfThreadsAndCanBeCancelled) {
    const auto ball =
        makeVolumeTerm(sampledVolume(20, [](const Vec3& p) { return 1 - glm::length(p); }), 0, greyRamp(0, 1));
    const auto scene = sceneOf(makeTransferTerm(bentLattice(0.2, 8), ball, Combine::Union, ""), kCamera, 1);
    const VoxeliseRequest request{cellCentredGrid({Vec3(-1.2), Vec3(1.2)}, {40, 41, 42}, 1), VoxeliseWhat::Rgba,
                                  VoxelType::Float, 0};
    setThreadCount(1);
    const auto one = voxelise(scene, request);
    setThreadCount(3);
    const auto several = voxelise(scene, request);
    setThreadCount(0);
    EXPECT_TRUE(std::equal(one->voxels().begin(), one->voxels().end(), several->voxels().begin()));
    EXPECT_GT(one->statistics().max, 0);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(voxelise(scene, request, &progress), Cancelled);
}

}  // namespace
}  // namespace voledit
