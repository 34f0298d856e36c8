#include <gtest/gtest.h>

#include <random>

#include "core/rigging/rig.h"
#include "tests/core/rigging/solids.h"

namespace voledit {
namespace {

/// Joints at these places, each below the one before.
std::vector<PosedJoint> jointsAt(const std::vector<Vec3>& places) {
    std::vector<PosedJoint> joints;
    for (const Vec3& p : places) joints.push_back({Mat3(1.0), p});
    return joints;
}

Limb limb(int from, int to, Vec2 size, Vec2 pad = Vec2(0)) {
    return {"limb" + std::to_string(to), from, to, size, Vec2(0), 0, pad};
}

OpaqueVoxels fullGrid(const Index3& size, const Vec3& origin, double step) {
    OpaqueVoxels voxels{size, origin, Vec3(step), {}};
    voxels.opaque.assign(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 1);
    return voxels;
}

TEST(Coverage, OfOneBoxIsItsVoxels) {
    // A box of 2 × 4 about a bone along z from 0 to 3, reaching half a unit on.
    const auto joints = jointsAt({{0, 0, 0}, {0, 0, 3}});
    const std::vector<Limb> limbs{limb(0, 1, {2, 4}, {0.5, 0.5})};
    const auto voxels = fullGrid({12, 13, 14}, Vec3(-2.9, -3.1, -2.05), 0.5);
    const Coverage c = coverageOf(voxels, limbs, joints, {});
    std::size_t inside = 0;
    for (Index3 k(0); k.z < 14; ++k.z)
        for (k.y = 0; k.y < 13; ++k.y)
            for (k.x = 0; k.x < 12; ++k.x) {
                const Vec3 p = voxels.centre(k);
                const bool in = std::abs(p.x) <= 1 && std::abs(p.y) <= 2 && p.z >= -0.5 && p.z <= 3.5;
                EXPECT_EQ(c.regions[voxels.indexOf(k)], in ? 1 : 0);
                inside += in ? 1 : 0;
            }
    EXPECT_EQ(c.opaque, voxels.count());
    EXPECT_EQ(c.uncovered, c.opaque - inside);
    EXPECT_EQ(c.doubly, 0u);
    EXPECT_EQ(c.ofLimb, std::vector<std::size_t>{inside});
    EXPECT_DOUBLE_EQ(c.covered(), double(inside) / double(c.opaque));
}

TEST(Coverage, CountsVoxelsOnASharedFaceOnce) {
    // Voxel centres stand exactly in the plane z = 3 in which the two straight limbs meet.
    const auto joints = jointsAt({{0, 0, 0}, {0, 0, 3}, {0, 0, 6}});
    const std::vector<Limb> limbs{limb(0, 1, {4, 4}), limb(1, 2, {4, 4})};
    const auto voxels = fullGrid({3, 3, 7}, Vec3(-1, -1, 0), 1);
    const Coverage c = coverageOf(voxels, limbs, joints, {});
    EXPECT_EQ(c.uncovered, 0u);
    EXPECT_EQ(c.doubly, 0u);
    EXPECT_EQ(c.ofLimb[0] + c.ofLimb[1], c.opaque);
}

TEST(Coverage, OverlapsCountTwice) {
    // Two limbs begin at one joint and cross.
    const auto joints = jointsAt({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    std::vector<Limb> limbs{limb(0, 1, {2, 2}, {1, 0}), limb(0, 2, {2, 2}, {1, 0})};
    const auto voxels = fullGrid({20, 20, 4}, Vec3(-1.9, -1.9, -0.7), 0.4);
    RegionOptions options;
    options.disjoint = {true, true, true};
    const Coverage c = coverageOf(voxels, limbs, joints, options);
    std::size_t doubly = 0, none = 0;
    for (Index3 k(0); k.z < 4; ++k.z)
        for (k.y = 0; k.y < 20; ++k.y)
            for (k.x = 0; k.x < 20; ++k.x) {
                const Vec3 p = voxels.centre(k);
                const bool a = p.x >= -1 && p.x <= 4 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1;
                const bool b = p.y >= -1 && p.y <= 4 && std::abs(p.x) <= 1 && std::abs(p.z) <= 1;
                doubly += a && b ? 1 : 0;
                none += a || b ? 0 : 1;
                EXPECT_EQ(c.regions[voxels.indexOf(k)], int(a) + int(b));
            }
    EXPECT_GT(doubly, 0u);
    EXPECT_EQ(c.doubly, doubly);
    EXPECT_EQ(c.uncovered, none);
}

TEST(Coverage, AgreesWithTheCellsOneByOne) {
    const test::Person person;
    OpaqueVoxels voxels = test::voxelsOf(person.capsules, 0.3);
    const auto joints = jointsAt({{0, 9, 0}, {0, 11, 0.1}, {0, 13, -0.1}, {0, 15, 0}, {1, 8.7, 0}, {1.5, 4.9, 0.2}});
    const std::vector<Limb> limbs{limb(0, 1, {2, 2.4}, {0.4, 0}), limb(1, 2, {2.6, 2}), limb(2, 3, {1, 1.4}, {0, 2}),
                                  limb(0, 4, {2, 2}, {0.3, 0}), limb(4, 5, {1.5, 1.8}, {0, 0.6})};
    const Coverage c = coverageOf(voxels, limbs, joints, {});
    const LimbRegions regions = limbRegions(limbs, joints, joints, {});
    std::vector<std::unique_ptr<MappedCells>> cells;
    for (int l = 0; l < 5; ++l) cells.push_back(std::make_unique<MappedCells>(cellsOf(regions, {l})));
    std::size_t uncovered = 0;
    for (Index3 k(0); k.z < voxels.size.z; ++k.z)
        for (k.y = 0; k.y < voxels.size.y; ++k.y)
            for (k.x = 0; k.x < voxels.size.x; ++k.x) {
                const std::size_t i = voxels.indexOf(k);
                int holders = 0;
                CellLocation at;
                for (const auto& limbCells : cells) holders += limbCells->locate(voxels.centre(k), at) ? 1 : 0;
                if (!voxels.opaque[i]) {
                    EXPECT_EQ(c.regions[i], 0);
                    continue;
                }
                EXPECT_EQ(c.regions[i], holders);
                uncovered += holders == 0 ? 1 : 0;
            }
    EXPECT_EQ(c.uncovered, uncovered);
}

TEST(Coverage, OfNothingIsWhole) {
    const OpaqueVoxels voxels{{2, 2, 2}, Vec3(0), Vec3(1), std::vector<std::uint8_t>(8, 0)};
    const Coverage c = coverageOf(voxels, {limb(0, 1, {1, 1})}, jointsAt({{0, 0, 0}, {1, 0, 0}}), {});
    EXPECT_EQ(c.opaque, 0u);
    EXPECT_EQ(c.covered(), 1);
}

}  // namespace
}  // namespace voledit
