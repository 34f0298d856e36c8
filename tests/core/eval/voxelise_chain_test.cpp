#include "core/eval/voxelise_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/fields/voxel_type.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

using namespace test;

const Camera kCamera;

/// Smooth shapes and noise over [−1, 1]³ in numbers of T, using all of their range.
template <class T>
std::shared_ptr<const Volume> noisyVolume(Index3 size) {
    std::mt19937 random(3);
    VolumeGrid grid{size, 1, placementMatrix(Vec3(-1), Vec3(0), 2.0 / Vec3(size - 1))};
    std::vector<T> values(grid.sampleCount());
    const double low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
    for (std::size_t n = 0; n < values.size(); ++n) {
        const double wave = 0.5 + 0.4 * std::sin(double(n % std::size_t(size.x)) / 3) * std::cos(double(n) / 777);
        const double share = std::clamp(wave + 0.1 * std::normal_distribution<double>()(random), 0.0, 1.0);
        values[n] = T(low + share * (high - low));
    }
    return Volume::fromValues(grid, std::move(values));
}

/// The scalar of each voxel by sampling the term, rounded.
template <class T>
std::vector<T> byTheGeneralWay(const Term& root, const VolumeGrid& grid, double fill) {
    std::vector<T> values;
    std::vector<Vec3> p(std::size_t(grid.size.x));
    std::vector<ObjectSample> samples(p.size());
    for (int k = 0; k < grid.size.z; ++k)
        for (int j = 0; j < grid.size.y; ++j) {
            for (int i = 0; i < grid.size.x; ++i)
                p[std::size_t(i)] = transformPoint(grid.worldFromIndex, Vec3(i, j, k));
            sample(root, p, samples, false, "scalar");
            for (const ObjectSample& s : samples) {
                const double value = s.value == s.value ? s.value : fill;
                values.push_back(T(std::clamp(std::round(value), double(std::numeric_limits<T>::min()),
                                              double(std::numeric_limits<T>::max()))));
            }
        }
    return values;
}

template <class T>
void expectTheGeneralWay(const TermPtr& root, const VolumeGrid& grid, double fill = 7) {
    const VoxeliseRequest request{grid, VoxeliseWhat::Scalar, voxelTypeFor<T>(), fill};
    const auto chain = scalarChainOf(*root);
    ASSERT_TRUE(chain && mayVoxeliseChain(*chain, request));
    const auto found = voxelise(sceneOf(root, kCamera, 1), request);
    const std::vector<T> expected = byTheGeneralWay<T>(*root, grid, fill);
    const T* values = reinterpret_cast<const T*>(found->voxels().data());
    ASSERT_EQ(found->grid().sampleCount(), expected.size());
    std::size_t filled = 0;
    for (std::size_t n = 0; n < expected.size(); ++n) {
        filled += expected[n] == T(fill);
        ASSERT_EQ(int(values[n]), int(expected[n])) << "voxel " << n;
    }
    EXPECT_LT(filled, expected.size());
}

TermPtr bent(std::shared_ptr<const Volume> volume, double amount, int cells, Outside outside = Outside::Hide) {
    return makeTransferTerm(bentLattice(amount, cells, outside), makeVolumeTerm(std::move(volume), 0, greyRamp(0, 200)),
                            Combine::Union, "");
}

const VolumeGrid kAbout = cellCentredGrid({Vec3(-1.3), Vec3(1.3)}, {61, 43, 37}, 1);

template <class T>
class VoxeliseChainOfType : public testing::Test {};
using Types = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t>;
TYPED_TEST_SUITE(VoxeliseChainOfType, Types);

TYPED_TEST(VoxeliseChainOfType, GivesWhatSamplingGivesToTheBit) {
    const auto volume = noisyVolume<TypeParam>({41, 30, 35});
    expectTheGeneralWay<TypeParam>(bent(volume, 0.25, 6), kAbout);
    expectTheGeneralWay<TypeParam>(bent(volume, 0.25, 6), volume->grid());
}

TYPED_TEST(VoxeliseChainOfType, TakesAffineMapsAlone) {
    const auto volume = noisyVolume<TypeParam>({41, 30, 35});
    const auto turned = std::make_shared<AffineMap>(placementMatrix({0.1, 0, -0.2}, {0.3, 0.2, -0.4}, {0.8, 1.1, 0.9}));
    const auto term = makeVolumeTerm(volume, 0, greyRamp(0, 200));
    expectTheGeneralWay<TypeParam>(term, kAbout);
    expectTheGeneralWay<TypeParam>(term, volume->grid());
    expectTheGeneralWay<TypeParam>(makeTransferTerm(turned, term, Combine::Union, ""), kAbout);
}

TEST(VoxeliseChain, TakesALatticeAtRestOnTheVolumesOwnGrid) {
    // Faces of the cells, and of their tetrahedra, lie on samples.
    const auto volume = noisyVolume<std::uint8_t>({33, 33, 33});
    expectTheGeneralWay<std::uint8_t>(bent(volume, 0, 8), volume->grid());
    VolumeGrid between = volume->grid();  // values halfway between two: the rounding is in doubt everywhere
    between.worldFromIndex[3].x += 0.5 * between.worldFromIndex[0].x;
    expectTheGeneralWay<std::uint8_t>(bent(volume, 0, 8), between);
}

TEST(VoxeliseChain, TakesFoldedCells) {
    const auto volume = noisyVolume<std::uint8_t>({24, 25, 26});
    const auto root = bent(volume, -2, 8);
    ASSERT_TRUE(std::get<TransferTerm>(root->node).by->cells()->mayOverlap());
    expectTheGeneralWay<std::uint8_t>(root, kAbout);
}

TEST(VoxeliseChain, KeepsWhatLiesOutside) {
    const auto volume = noisyVolume<std::uint8_t>({24, 25, 26});
    const auto root =
        makeTransferTerm(bentLattice(0.2, 5, Outside::Keep),
                         makeTransferTerm(std::make_shared<AffineMap>(placementMatrix(Vec3(0), Vec3(0), Vec3(1.2))),
                                          makeVolumeTerm(volume, 0, greyRamp(0, 200)), Combine::Union, ""),
                         Combine::Union, "");
    expectTheGeneralWay<std::uint8_t>(root, kAbout);
}

TEST(VoxeliseChain, TakesTurnedGridsAndPlacedLattices) {
    const auto volume = noisyVolume<std::int16_t>({24, 25, 26});
    const auto placed = std::make_shared<AffineMap>(placementMatrix({3, -2, 1}, {0.2, 0.1, 0.4}, Vec3(1.5)));
    const auto root = makeTransferTerm(placed, bent(volume, 0.2, 5), Combine::Union, "", TransferRole::Place);
    VolumeGrid grid{{50, 40, 30}, 1, placementMatrix({1.2, -3.9, -1.1}, {0.3, -0.2, 0.5}, {0.07, 0.09, 0.11})};
    expectTheGeneralWay<std::int16_t>(root, grid);
}

TEST(VoxeliseChain, LeavesOtherTermsToTheGeneralWay) {
    const auto volume = noisyVolume<std::uint8_t>({24, 25, 26});
    EXPECT_FALSE(scalarChainOf(*makeTransferTerm(bentLattice(0.1, 3), bent(volume, 0.1, 3), Combine::Union, "")));
    EXPECT_FALSE(scalarChainOf(*makeVolumeTerm(volume, 0, greyRamp(0, 1), Interpolation::Cubic)));
    const auto chain = scalarChainOf(*bent(volume, 0.1, 3));
    ASSERT_TRUE(chain);
    EXPECT_FALSE(mayVoxeliseChain(*chain, {kAbout, VoxeliseWhat::Scalar, VoxelType::Float, 0}));
}

}  // namespace
}  // namespace voledit
