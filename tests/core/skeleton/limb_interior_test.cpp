#include "core/skeleton/limb_interior.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "elbow.h"

namespace voledit {
namespace {

/// One-sided derivatives at a grid point along w, second order, and along u and v: p and q as columns.
Mat3 mapAt(const LimbRegions& regions, std::size_t limb, Index3 cells, Index3 at, int side) {
    const auto derivatives = [&](const std::vector<Vec3>& of) {
        const auto x = [&](int i, int j, int k) { return of[gridVertex(regions, limb, cells, {i, j, k})]; };
        const double s = side;
        return Mat3(
            x(at.x + 1, at.y, at.z) - x(at.x - 1, at.y, at.z), x(at.x, at.y + 1, at.z) - x(at.x, at.y - 1, at.z),
            s * (-3.0 * x(at.x, at.y, at.z) + 4.0 * x(at.x, at.y, at.z + side) - x(at.x, at.y, at.z + 2 * side)));
    };
    return derivatives(regions.cells.deformed) * glm::inverse(derivatives(regions.cells.source));
}

/// How far the map's derivative jumps across the elbow, at most.
double jumpOf(const Elbow& elbow, const LimbRegions& regions) {
    const Index3 cells = elbow.options.cells;
    double jump = 0;
    for (int j = 1; j < cells.y; ++j)
        for (int i = 1; i < cells.x; ++i)
            jump = std::max(
                jump, largest(mapAt(regions, 0, cells, {i, j, cells.z}, -1) - mapAt(regions, 1, cells, {i, j, 0}, 1)));
    return jump;
}

/// Bent and twisted, from a rest pose that may be bent itself.
Elbow randomElbow(Random& random, double restBend) {
    Elbow elbow;
    const Quat rest = glm::angleAxis(restBend, glm::normalize(randomVector(random, 1)));
    elbow.skeleton.joints[2].at = elbow.skeleton.joints[1].at + rest * Vec3(0, 0, 2.5);
    for (Limb& limb : elbow.limbs) limb.size = {randomNumber(random, 0.6, 1.2), randomNumber(random, 0.6, 1.2)};
    return elbow;
}

TEST(SmoothBends, TheDerivativeIsTheSameOnBothSides) {
    Random random(1);
    for (int n = 0; n < 30; ++n) {
        Elbow elbow = randomElbow(random, n % 2 ? 0.5 : 0);
        const Vec3 across(randomNumber(random, -1, 1), randomNumber(random, -1, 1), randomNumber(random, -0.2, 0.2));
        const Quat bend = glm::angleAxis(randomNumber(random, 0.5, 1.2), glm::normalize(across));
        double smooth[2];
        for (const int refined : {0, 1}) {
            elbow.options.cells = {4, 4, refined ? 400 : 100};
            smooth[refined] = jumpOf(elbow, elbow.bent(bend));
        }
        // What is left is the differences' error, of second order in the cells' length.
        EXPECT_LT(smooth[1], 1e-3);
        EXPECT_LT(smooth[1], smooth[0] / 10);
        elbow.options.smooth = false;
        EXPECT_GT(jumpOf(elbow, elbow.bent(bend)), 0.15);
    }
}

TEST(SmoothBends, OnlyHalfOfEachLimbIsBent) {
    Elbow elbow;
    elbow.options.cells = {2, 2, 8};
    const LimbRegions smooth = elbow.bent({80, 0, 30});
    elbow.options.smooth = false;
    const LimbRegions straight = elbow.bent({80, 0, 30});
    double most = 0;
    for (int k = 0; k <= 8; ++k)
        for (int j = 0; j <= 2; ++j)
            for (int i = 0; i <= 2; ++i)
                for (const std::size_t limb : {std::size_t(0), std::size_t(1)}) {
                    const std::uint32_t v =
                        gridVertex(smooth, limb, elbow.options.cells, {i, j, limb == 0 ? 8 - k : k});
                    const double moved = glm::length(smooth.cells.deformed[v] - straight.cells.deformed[v]);
                    EXPECT_TRUE(moved == 0 || (k > 0 && k < 4)) << k;
                    most = std::max(most, moved);
                }
    EXPECT_GT(most, 0.05);
}

TEST(SmoothBends, NothingFoldsUpTo120Degrees) {
    for (const double length : {1.0, 1.5, 3.0})
        for (const bool smooth : {false, true})
            for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)})
                for (int degrees = -120; degrees <= 120; degrees += 15) {
                    Elbow elbow;
                    elbow.options.smooth = smooth;
                    elbow.skeleton.joints[2].at = elbow.skeleton.joints[1].at + Vec3(0, 0, length);
                    elbow.skeleton.joints[0].at = elbow.skeleton.joints[1].at - Vec3(0, 0, 1);
                    // The corner of a section lies farther out than its side, by √2 about a diagonal axis.
                    const double reach = axis == Vec3(1, 1, 0) ? std::sqrt(0.5) : 1;
                    for (Limb& limb : elbow.limbs) limb.size = Vec2(reach);
                    const MappedCells cells(
                        elbow.bent(glm::angleAxis(degrees * kPi / 180, glm::normalize(axis))).cells);
                    for (const double determinant : cells.determinants())
                        ASSERT_GT(determinant, 0.01) << length << " long, " << degrees << "°, smooth " << smooth;
                }
}

TEST(SmoothBends, DampedWhereTheyWouldFold) {
    // A short stiff limb between long ones, bent hard on both sides: the full correction turns cells inside out.
    Skeleton skeleton{{{"a", Joint::kNoParent, Vec3(0), {}},
                       {"b", 0, Vec3(0, 0, 6), {}},
                       {"c", 1, Vec3(0, 0, 6.8), {}},
                       {"d", 2, Vec3(0, 0, 14), {}}}};
    const std::vector<Limb> limbs{limbBetween(0, 1), limbBetween(1, 2), limbBetween(2, 3)};
    Pose pose = restPose(skeleton);
    pose.rotate[1] = quatOfDegrees({85, 0, 0});
    pose.rotate[2] = quatOfDegrees({-80, 0, 0});
    const auto rest = posedJoints(skeleton, restPose(skeleton)), posed = posedJoints(skeleton, pose);
    RegionOptions options;
    const auto worst = [&] {
        const MappedCells cells(limbRegions(limbs, rest, posed, options).cells);
        return *std::min_element(cells.determinants().begin(), cells.determinants().end());
    };
    const double damped = worst();
    options.smooth = false;
    const double straight = worst();
    EXPECT_GT(straight, 0);
    EXPECT_GE(damped, 0.099 * straight);
}

TEST(SmoothBends, DampingLeavesATenth) {
    // One cell in a unit cube, its upper face pulled down through the lower one.
    const LimbGrid grid{{1, 1, 4}};
    LimbShape shape;
    shape.start = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    for (std::size_t m = 0; m < 4; ++m) shape.end[m] = shape.start[m] + Vec3(0, 0, 1);
    std::vector<Vec3> positions(grid.size());
    EndCorrection correction;
    for (const double pull : {0.0, -0.5, -50.0}) {
        fillTrilinear(shape, grid, positions);
        correction.at.assign(grid.layerSize(), Vec3(0, 0, pull));
        correction.atBone = Vec3(0, 0, pull);
        addCorrection(grid, correction, false, positions);
        double least = kInfinity;
        for (int k = 0; k < 4; ++k)
            least = std::min(least, positions[4 * std::size_t(k + 1)].z - positions[4 * std::size_t(k)].z);
        EXPECT_TRUE(pull < -1 || correction.at[0].z == pull);
        EXPECT_EQ(correction.at[0], correction.atBone);
        EXPECT_GE(least, 0.1 * 0.25);
        // And takes no more than it must.
        EXPECT_TRUE(pull > -1 || least < 0.1 * 0.25 + 2e-2) << least;
    }
}

TEST(Volume, OfBentLimbsIsThatOfStraightOnes) {
    // A prism cut by planes has its area times the length of the line through its middle, however the planes lean.
    Random random(2);
    for (int n = 0; n < 50; ++n) {
        Elbow elbow;
        for (Limb& limb : elbow.limbs) limb.size = {1, 0.8};
        elbow.options.smooth = false;
        elbow.options.preserveVolume = n % 2;
        const Vec3 across = glm::normalize(Vec3(randomNumber(random, -1, 1), randomNumber(random, -1, 1), 0));
        const LimbRegions regions = elbow.bent(glm::angleAxis(randomNumber(random, -2, 2), across));
        EXPECT_NEAR(volumeOf(regions), 2 * 3 * 0.8, 1e-12);
    }
}

TEST(Volume, IsKeptByTwistsWhereAsked) {
    for (const double twist : {30.0, 70.0, 120.0}) {
        Elbow elbow;
        elbow.options.cells.z = 60;
        const double shrunk = volumeOf(elbow.bent({0, 0, twist}));
        elbow.options.preserveVolume = true;
        const LimbRegions kept = elbow.bent({0, 0, twist});
        // Layers keep their area exactly; the twisted cells' faces bulge a little between them.
        EXPECT_NEAR(volumeOf(kept), 6, 6 * 1e-3) << twist;
        // Untreated, the mean of both sections is smaller by the cosine of half the twist.
        EXPECT_LT(shrunk, 6 * (1 - 0.2 * std::pow(std::sin(twist * kPi / 360), 2)));
        const auto corner = [&](std::size_t limb, int k) {
            return kept.cells.deformed[gridVertex(kept, limb, elbow.options.cells, {0, 0, k})];
        };
        for (int k = 0; k <= 60; k += 5) {
            const Vec3 out = corner(0, k) - Vec3(0.3, 0.2, 0.1);
            EXPECT_NEAR(std::hypot(out.x, out.y), std::sqrt(0.5), 1e-12);
        }
    }
}

TEST(Volume, OfASmoothBendIsNearlyKept) {
    for (const double bend : {30.0, 60.0, 90.0}) {
        Elbow elbow;
        elbow.options.cells.z = 40;
        EXPECT_NEAR(volumeOf(elbow.bent({bend, 0, 0})), 6, 6 * 0.03);
        elbow.options.preserveVolume = true;
        EXPECT_NEAR(volumeOf(elbow.bent({bend, 0, 0})), 6, 6 * 0.02);
    }
}

TEST(Volume, AStretchedBoneGetsThinner) {
    Elbow elbow;
    elbow.options.preserveVolume = true;
    Pose pose = restPose(elbow.skeleton);
    pose.translate[2] = {0, 0, 1.5};
    const LimbRegions regions =
        limbRegions(elbow.limbs, elbow.rest(), posedJoints(elbow.skeleton, pose), elbow.options);
    const std::uint32_t end = gridVertex(regions, 1, elbow.options.cells, {0, 0, 10});
    EXPECT_NEAR(glm::length(Vec2(regions.cells.deformed[end]) - Vec2(0.3, 0.2)), std::sqrt(0.5 / 1.5), 1e-12);
}

TEST(LimbJacobians, AgreeWithTheMap) {
    // Against differences of the map itself, on grids of which one is finer by a half.
    double error[2];
    for (const int refined : {0, 1}) {
        Elbow elbow;
        const int n = refined ? 12 : 6;
        elbow.options.cells = {n, n, 10 * n};
        const LimbRegions regions = elbow.bent({60, 20, 30});
        const MappedCells exact({regions.cells.deformed, regions.cells.source, {}, regions.cells.hexahedra, {}});
        error[refined] = 0;
        for (std::size_t v = 0; v < regions.cells.jacobian.size(); ++v)
            error[refined] = std::max(error[refined], largest(regions.cells.jacobian[v] - exact.jacobians()[v]));
    }
    // The tetrahedra's own mean is of first order at the faces.
    EXPECT_LT(error[0], 0.25);
    EXPECT_LT(error[1], 0.6 * error[0]);
}

TEST(LimbJacobians, AreFiniteWhereRegionsCollapse) {
    // Twisted by half a turn, the mean of both sections is a line or a point.
    for (const bool preserve : {false, true})
        for (const Vec3& degrees :
             {Vec3(0, 0, 180), Vec3(180, 0, 0), Vec3(0, 180, 0), Vec3(179.999, 0, 90), Vec3(90, 0, 180)}) {
            Elbow elbow;
            elbow.options.preserveVolume = preserve;
            const LimbRegions regions = elbow.bent(degrees);
            for (const Vec3& p : regions.cells.deformed) {
                ASSERT_TRUE(isDefined(p));
                ASSERT_LT(glm::length(p), 20);
            }
            for (const Mat3& jacobian : regions.cells.jacobian) ASSERT_LT(largest(jacobian), 1e4);
        }
}

}  // namespace
}  // namespace voledit
