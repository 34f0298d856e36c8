#include "core/rigging/curve_skeleton.h"

#include <gtest/gtest.h>

#include <set>

#include "core/rigging/grid_steps.h"
#include "tests/core/rigging/solids.h"

namespace voledit {
namespace {

/// A quarter of a ring of radius 5 in the x–y plane, a tube of radius 1.
std::vector<test::TaperedCapsule> bentTube() {
    std::vector<test::TaperedCapsule> tube;
    const auto at = [](int i) { return 5.0 * Vec3(std::cos(i * kPi / 32), std::sin(i * kPi / 32), 0); };
    for (int i = 0; i < 16; ++i) tube.push_back({at(i), at(i + 1), 1, 1});
    return tube;
}

double offAxis(const Vec3& p) {
    const Vec3 inPlane(p.x, p.y, 0);
    return std::hypot(glm::length(inPlane) - 5, p.z);
}

std::size_t componentsOf(const CurveSkeleton& tree) {
    std::vector<bool> seen(tree.nodes.size());
    std::size_t parts = 0;
    for (std::size_t start = 0; start < tree.nodes.size(); ++start) {
        if (seen[start]) continue;
        ++parts;
        std::vector<std::size_t> open{start};
        seen[start] = true;
        while (!open.empty()) {
            const std::size_t i = open.back();
            open.pop_back();
            for (const int j : tree.nodes[i].neighbours)
                if (!seen[std::size_t(j)]) {
                    seen[std::size_t(j)] = true;
                    open.push_back(std::size_t(j));
                }
        }
    }
    return parts;
}

std::size_t edgesOf(const CurveSkeleton& tree) {
    std::size_t ends = 0;
    for (const auto& node : tree.nodes) ends += node.neighbours.size();
    return ends / 2;
}

std::size_t leavesOf(const CurveSkeleton& tree) {
    return std::size_t(std::count_if(tree.nodes.begin(), tree.nodes.end(),
                                     [](const auto& node) { return node.neighbours.size() == 1; }));
}

TEST(Thinning, KeepsATubesMiddle) {
    const OpaqueVoxels voxels = test::voxelsOf(bentTube(), 0.1);
    const auto distance = distanceField(voxels);
    const auto kept = thinned(voxels, distance, 0.6);
    // Single cells that stand out of the surface are maxima of their own, one deep.
    std::set<int> eighths;
    std::size_t bumps = 0;
    for (const Index3& c : kept) {
        if (distance[voxels.indexOf(c)] <= 0.15F && ++bumps) continue;
        EXPECT_LT(offAxis(voxels.centre(c)), 0.25) << voxels.centre(c).x << " " << voxels.centre(c).y;
        eighths.insert(int(std::atan2(voxels.centre(c).y, voxels.centre(c).x) / (kPi / 16)));
    }
    EXPECT_EQ(eighths.size() >= 8, true) << "of the whole length, not of a part";
    EXPECT_LE(bumps, 8u);
}

TEST(Thinning, LargerThinnessKeepsASubset) {
    const OpaqueVoxels voxels = test::voxelsOf(test::Person().capsules, 0.2);
    const auto distance = distanceField(voxels);
    std::size_t before = voxels.count();
    std::set<std::size_t> kept;
    for (const double thinness : {0.0, 0.3, 0.6, 0.9}) {
        std::set<std::size_t> now;
        for (const Index3& c : thinned(voxels, distance, thinness)) now.insert(voxels.indexOf(c));
        EXPECT_LT(now.size(), before) << thinness;
        if (!kept.empty()) {
            EXPECT_TRUE(std::includes(kept.begin(), kept.end(), now.begin(), now.end()));
        }
        before = now.size();
        kept = now;
    }
}

TEST(CurveSkeleton, OfATubeIsOneLineThroughItsMiddle) {
    const OpaqueVoxels voxels = test::voxelsOf(bentTube(), 0.1);
    const auto tree = curveSkeleton(voxels, distanceField(voxels), 0.6);
    EXPECT_EQ(leavesOf(tree), 2u);
    EXPECT_EQ(edgesOf(tree) + 1, tree.nodes.size());
    double length = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        EXPECT_LT(offAxis(tree.nodes[i].at), 0.3);
        EXPECT_NEAR(tree.nodes[i].radius, 1, 0.3);
        for (const int j : tree.nodes[i].neighbours)
            if (std::size_t(j) > i) length += glm::length(tree.nodes[std::size_t(j)].at - tree.nodes[i].at);
    }
    // The arc is 7.85 long, and its ends may be a radius short; steps between cells are longer than their line.
    EXPECT_GT(length, 6.8);
    EXPECT_LT(length, 11.0);
}

TEST(CurveSkeleton, IsATreeInsideTheObject) {
    const OpaqueVoxels voxels = test::voxelsOf(test::Person().capsules, 0.15);
    for (const double thinness : {0.4, 0.6, 0.8}) {
        const auto tree = curveSkeleton(voxels, distanceField(voxels), thinness);
        ASSERT_GT(tree.nodes.size(), 100u);
        EXPECT_EQ(componentsOf(tree), 1u);
        EXPECT_EQ(edgesOf(tree) + 1, tree.nodes.size()) << "a tree has one edge less than nodes";
        for (const auto& node : tree.nodes) EXPECT_EQ(voxels.opaque[voxels.indexOf(cellAt(voxels, node.at))], 1);
    }
}

TEST(CurveSkeleton, OfAPersonEndsInHeadHandsAndFeet) {
    const test::Person person;
    const OpaqueVoxels voxels = test::voxelsOf(person.capsules, 0.12);
    const auto tree = curveSkeleton(voxels, distanceField(voxels), 0.6);
    for (const double side : {1.0, -1.0})
        for (const Vec3& tip : {person.wrist, person.toe}) {
            const Vec3 there(side * tip.x, tip.y, tip.z);
            const bool isReached = std::any_of(tree.nodes.begin(), tree.nodes.end(), [&](const auto& node) {
                return node.neighbours.size() == 1 && glm::length(node.at - there) < 1.8;
            });
            EXPECT_TRUE(isReached) << there.x << " " << there.y << " " << there.z;
        }
    // The head is a ball on the neck: the line through the neck reaches into it.
    EXPECT_TRUE(std::any_of(tree.nodes.begin(), tree.nodes.end(),
                            [](const auto& node) { return glm::length(node.at - Vec3(0, 15.8, 0.2)) < 0.4; }));
}

TEST(CurveSkeleton, OfABallOrACellIsAPoint) {
    const auto ball = test::voxelsOf({{Vec3(0), Vec3(0), 1, 1}}, 0.1);
    const auto tree = curveSkeleton(ball, distanceField(ball), 0.6);
    ASSERT_FALSE(tree.nodes.empty());
    for (const auto& node : tree.nodes) EXPECT_LT(glm::length(node.at), 0.35);
    OpaqueVoxels cell{{1, 1, 1}, Vec3(0), Vec3(1), {1}};
    EXPECT_EQ(curveSkeleton(cell, distanceField(cell), 100).nodes.size(), 1u);
    cell.opaque = {0};
    EXPECT_TRUE(curveSkeleton(cell, distanceField(cell), 0.6).nodes.empty());
}

TEST(MedialAxis, PointsSnapToTheMiddle) {
    const OpaqueVoxels voxels = test::voxelsOf(bentTube(), 0.1);
    const auto distance = distanceField(voxels);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(0.2, kPi / 2 - 0.2), turn(0, 2 * kPi), off(0, 0.85);
    for (int i = 0; i < 200; ++i) {
        const double a = angle(random), t = turn(random), r = off(random);
        const Vec3 out(std::cos(a), std::sin(a), 0);
        const Vec3 p = (5 + r * std::cos(t)) * out + Vec3(0, 0, r * std::sin(t));
        const Vec3 snapped = snappedToMedialAxis(voxels, distance, p, 2);
        EXPECT_LT(offAxis(snapped), 0.16);
        // Across the tube, not along it.
        EXPECT_LT(glm::length(snapped - 5.0 * out), 0.5);
    }
}

TEST(MedialAxis, PointsOutsideStayAndReachIsKept) {
    const OpaqueVoxels voxels = test::voxelsOf(bentTube(), 0.1);
    const auto distance = distanceField(voxels);
    for (const Vec3& p : {Vec3(0), Vec3(100, 0, 0), Vec3(-5, -5, 7)})
        EXPECT_EQ(snappedToMedialAxis(voxels, distance, p, 3), p);
    const Vec3 p(5 + 0.8, 0.5, 0);
    EXPECT_LT(glm::length(snappedToMedialAxis(voxels, distance, p, 0.3) - p), 0.45);
}

}  // namespace
}  // namespace voledit
