// The paper's Ψ₂ and Ψ₄ with its parameters on a CT head, voxelised, against arithmetic that shares no code with it:
// from voxel numbers to normalised coordinates, through the map as printed, and trilinearly between the voxels.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/eval/voxelise.h"
#include "core/io/io_client.h"
#include "core/stf/transfer_definition.h"
#include "tests/support/fixtures.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

/// Interpolated at fractional voxel numbers within the volume.
double trilinear(const Volume& volume, const Vec3& index) {
    const Index3 last = volume.grid().size - 1;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        Index3 voxel;
        double weight = 1;
        for (int a = 0; a < 3; ++a) {
            const int low = std::min(int(index[a]), last[a] - 1);
            const double part = index[a] - low;
            const bool high = corner >> a & 1;
            voxel[a] = low + high;
            weight *= high ? part : 1 - part;
        }
        if (weight != 0) sum += weight * volume.at(voxel);
    }
    return sum;
}

struct PaperCase {
    const char* name;
    std::map<std::string, TransferArgument> arguments;
    /// u → Ψ(u), NaN where undefined; `margin` is the distance to the nearest cut, in u.
    std::function<Vec3(const Vec3& u, double& margin)> map;
};

void expectEqualValues(const std::shared_ptr<const Volume>& volume, const PaperCase& c) {
    const VolumeGrid& grid = volume->grid();
    const auto map = libraryTransfer(c.name)->make({c.arguments, frameOf(boundsOf(grid.worldFrame())), {}, 1, 0});
    const auto term = makeTransferTerm(map, makeVolumeTerm(volume, 0, greyRamp(0, 1)), Combine::Union, "");
    const double fill = -12345;
    const auto out = voxelise(test::sceneOf(term, {}, 1), {grid, VoxeliseWhat::Scalar, VoxelType::Double, fill});
    // In this file the second axis runs against the world's y.
    const Vec3 last = Vec3(grid.size - 1);
    std::size_t compared = 0, empty = 0, atCut = 0, different = 0;
    double largest = 0;
    for (int k = 0; k < grid.size.z; ++k)
        for (int j = 0; j < grid.size.y; ++j)
            for (int i = 0; i < grid.size.x; ++i) {
                const Vec3 u(i / last.x, 1 - j / last.y, k / last.z);
                double margin = 1;
                const Vec3 q = c.map(u, margin);
                if (margin < 1e-12) {
                    ++atCut;
                    continue;
                }
                const bool inside = q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x <= 1 && q.y <= 1 && q.z <= 1;
                const double expected =
                    inside ? trilinear(*volume, Vec3(q.x * last.x, (1 - q.y) * last.y, q.z * last.z)) : fill;
                const double difference = std::abs(out->at({i, j, k}) - expected);
                largest = std::max(largest, difference);
                different += !(difference < 1e-6);
                ++compared;
                empty += !inside;
            }
    std::printf("%s: %zu voxels, %zu of them empty, %zu at the cut; largest difference %.3g\n", c.name, compared, empty,
                atCut, largest);
    EXPECT_EQ(different, 0u) << c.name;
    EXPECT_LT(atCut, compared / 100);
    EXPECT_GT(compared - empty, compared / 4);
    EXPECT_GT(empty, 0u);
}

TEST(PaperMaps, OnTheHeadsGridGiveTheValuesOfTheFormulasAsPrinted) {
    VOLEDIT_SHARED_OR_SKIP(file, "data/volumes/ct_head.mhd");
    const auto volume = IoClient().readVolume(file).volume;
    ASSERT_LT(volume->grid().worldFromIndex[1][1], 0);
    const auto part = [](double a, double& margin) {
        const double b = 0.3;
        margin = std::min({margin, std::abs(2 * a - (1 - b)), std::abs(2 * a - (1 + b))});
        if (2 * a <= 1 - b) return a / (1 - b);
        return 2 * a >= 1 + b ? 1 - (1 - a) / (1 - b) : kNaN;
    };
    const std::vector<int> all{0, 1, 2};
    expectEqualValues(
        volume, {"dissect", {{"axes", all}, {"gap", std::vector<double>{0.3}}}, [&](const Vec3& u, double& margin) {
                     return Vec3(part(u.x, margin), part(u.y, margin), part(u.z, margin));
                 }});
    expectEqualValues(
        volume, {"open",
                 {{"axis", std::vector<int>{0}}, {"hinge", std::vector<int>{2}}, {"width", std::vector<double>{0.2}}},
                 [](const Vec3& u, double& margin) {
                     const double low = 0.3 + 0.2 * u.z, high = 0.7 - 0.2 * u.z;
                     margin = std::min(std::abs(u.x - low), std::abs(u.x - high));
                     if (u.x < low) return Vec3(u.x + 0.2 - 0.2 * u.z, u.y, u.z);
                     return u.x > high ? Vec3(u.x - 0.2 + 0.2 * u.z, u.y, u.z) : kUndefined;
                 }});
}

}  // namespace
}  // namespace voledit
