#include <gtest/gtest.h>

#include "core/rigging/curve_skeleton.h"
#include "tests/core/rigging/solids.h"

namespace voledit {
namespace {

/// Distance to the nearest cell that is not opaque, by trying all of them and those around the grid.
double bruteDistance(const OpaqueVoxels& voxels, const Index3& c) {
    double best = kInfinity;
    for (Index3 k(-1); k.z <= voxels.size.z; ++k.z)
        for (k.y = -1; k.y <= voxels.size.y; ++k.y)
            for (k.x = -1; k.x <= voxels.size.x; ++k.x) {
                const bool inside = k.x >= 0 && k.y >= 0 && k.z >= 0 && k.x < voxels.size.x && k.y < voxels.size.y &&
                                    k.z < voxels.size.z;
                if (inside && voxels.opaque[voxels.indexOf(k)]) continue;
                best = std::min(best, glm::length(voxels.centre(k) - voxels.centre(c)));
            }
    return best;
}

TEST(DistanceField, IsTheNearestCellThatIsNotOpaque) {
    const std::vector<std::pair<Index3, Vec3>> grids{
        {{9, 8, 7}, Vec3(1)}, {{12, 5, 6}, Vec3(0.5, 2, 1.25)}, {{1, 10, 10}, Vec3(3, 1, 1)}, {{6, 6, 6}, Vec3(0.1)}};
    unsigned seed = 1;
    for (const auto& [size, spacing] : grids)
        for (const double share : {0.2, 0.8, 0.97, 1.0}) {
            const OpaqueVoxels voxels = test::randomVoxels(size, spacing, share, seed++);
            const auto distance = distanceField(voxels);
            ASSERT_EQ(distance.size(), voxels.opaque.size());
            for (Index3 c(0); c.z < size.z; ++c.z)
                for (c.y = 0; c.y < size.y; ++c.y)
                    for (c.x = 0; c.x < size.x; ++c.x) {
                        const double d = double(distance[voxels.indexOf(c)]);
                        if (voxels.opaque[voxels.indexOf(c)])
                            EXPECT_NEAR(d, bruteDistance(voxels, c), 1e-6 * (1 + d));
                        else
                            EXPECT_EQ(d, 0);
                    }
        }
}

TEST(DistanceField, OfNothingIsNothing) {
    EXPECT_TRUE(distanceField(OpaqueVoxels{}).empty());
}

}  // namespace
}  // namespace voledit
