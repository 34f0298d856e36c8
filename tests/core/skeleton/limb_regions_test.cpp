#include "core/skeleton/limb_regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "elbow.h"
#include "tests/support/joint_gaps.h"

namespace voledit {
namespace {

using testing::HasSubstr;

TEST(BoneFrame, IsRightHandedAndFollowsWorldX) {
    Random random(1);
    for (int n = 0; n < 100; ++n) {
        const Vec3 d = glm::normalize(randomVector(random, 1));
        const double roll = randomNumber(random, -7, 7);
        const Mat3 straight = boneFrame(d, 0), rolled = boneFrame(d, roll);
        for (const Mat3& frame : {straight, rolled}) {
            EXPECT_LT(largest(glm::transpose(frame) * frame - Mat3(1)), 1e-14);
            EXPECT_NEAR(glm::determinant(frame), 1, 1e-14);
            EXPECT_EQ(frame[2], d);
        }
        EXPECT_GT(straight[0].x, 0);
        EXPECT_NEAR(straight[1].x, 0, 1e-15);
        EXPECT_LT(glm::length(rolled[0] - glm::angleAxis(roll, d) * straight[0]), 1e-14);
    }
    EXPECT_EQ(boneFrame({1, 0, 0}, 0)[0], Vec3(0, 1, 0));
    EXPECT_EQ(boneFrame({-1, 0, 0}, 0)[0], Vec3(0, 1, 0));
    EXPECT_EQ(boneFrame({0, 0, 1}, 0), Mat3(1));
}

TEST(LimbRegions, RestIsTheIdentityToTheBit) {
    Random random(2);
    for (int n = 0; n < 60; ++n) {
        const Skeleton skeleton = randomSkeleton(random, 12);
        const auto limbs = randomLimbs(random, skeleton);
        RegionOptions options;
        options.cells = {1 + n % 3, 1 + n % 4, 1 + n % 7};
        options.smooth = n % 2 == 0;
        options.preserveVolume = n % 3 == 0;
        options.miterLimit = n % 5 == 0 ? 1 : randomNumber(random, 1, 3);
        options.disjoint.assign(12, false);
        for (std::size_t j = 0; j < 12; ++j) options.disjoint[j] = n % 4 == 0 && j % 3 == 0;
        auto joints = posedJoints(skeleton, restPose(skeleton));
        if (n % 2)
            joints =
                laidInto(joints, Mat4(Vec4(2, 0.1, 0, 0), Vec4(0, 0.7, 0, 0), Vec4(0.3, 0, 1.5, 0), Vec4(1, 2, 3, 1)));
        const LimbRegions regions = limbRegions(limbs, joints, joints, options);
        EXPECT_TRUE(regions.cells.deformed == regions.cells.source);
        EXPECT_TRUE(regions.cells.jacobian == std::vector<Mat3>(regions.cells.source.size(), Mat3(1)));
    }
}

// ---- The shared quadrilateral, as definitions.md §6.3 says it.

/// A box's corners as lines along its bone: in the pose, by the rotation of its joint alone.
struct Lines {
    std::array<Vec3, 4> at;
    Vec3 direction;
};
Lines linesOf(const Limb& limb, const std::vector<PosedJoint>& rest, const std::vector<PosedJoint>& posed) {
    const std::size_t from = std::size_t(limb.from), to = std::size_t(limb.to);
    const Mat3 frame = boneFrame(glm::normalize(rest[to].position - rest[from].position), limb.roll);
    Lines lines;
    const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (std::size_t m = 0; m < 4; ++m) {
        const Vec2 corner = limb.offset + Vec2(signs[m][0], signs[m][1]) * limb.size / 2.0;
        lines.at[m] = posed[from].position + posed[from].linear * (corner.x * frame[0] + corner.y * frame[1]);
    }
    lines.direction = glm::normalize(posed[to].position - posed[from].position);
    return lines;
}
std::array<Vec3, 4> meeting(const Lines& lines, const Vec3& joint, const Vec3& normal) {
    std::array<Vec3, 4> points;
    for (std::size_t m = 0; m < 4; ++m) {
        const double s = glm::dot(joint - lines.at[m], normal) / glm::dot(lines.direction, normal);
        points[m] = lines.at[m] + s * lines.direction;
    }
    return points;
}
/// Corners of the face shared by two limbs, in the first one's order; `shift`: which corner of the second goes with the
/// first's corner 0.
std::array<Vec3, 4> sharedQuadrilateral(const Lines& a, const Lines& b, const Vec3& joint, std::size_t shift) {
    const Vec3 normal = a.direction + b.direction;
    const auto first = meeting(a, joint, normal), second = meeting(b, joint, normal);
    std::array<Vec3, 4> mean;
    for (std::size_t m = 0; m < 4; ++m) mean[m] = 0.5 * (first[m] + second[(m + shift) % 4]);
    return mean;
}
std::size_t nearestShift(const Lines& a, const Lines& b, const Vec3& joint) {
    const Vec3 normal = a.direction + b.direction;
    const auto first = meeting(a, joint, normal), second = meeting(b, joint, normal);
    std::size_t best = 0;
    double least = kInfinity;
    for (std::size_t shift = 0; shift < 4; ++shift) {
        double sum = 0;
        for (std::size_t m = 0; m < 4; ++m) sum += std::pow(glm::length(first[m] - second[(m + shift) % 4]), 2);
        if (sum < least) best = shift;
        least = std::min(least, sum);
    }
    return best;
}

/// The four corners of a limb's end (or start), cyclic as the grid has them.
std::array<Vec3, 4> cornersOf(const LimbRegions& regions, std::size_t limb, Index3 cells, bool atEnd) {
    const std::size_t nx = std::size_t(cells.x), layer = nx * std::size_t(cells.y);
    const std::size_t first = regions.firstCell[limb] + (atEnd ? layer * std::size_t(cells.z - 1) : 0);
    const std::size_t up = atEnd ? 4 : 0;
    const auto vertex = [&](std::size_t cell, std::size_t corner) {
        return regions.cells.deformed[regions.cells.hexahedra[first + cell][up + corner]];
    };
    return {vertex(0, 0), vertex(nx - 1, 1), vertex(layer - 1, 3), vertex(layer - nx, 2)};
}

TEST(LimbRegions, BoxesEndInTheSharedQuadrilateralOfTheDefinition) {
    Random random(3);
    for (int n = 0; n < 300; ++n) {
        Elbow elbow;
        elbow.options = {{3, 2, 4}, 1e3, n % 2 == 0, false, {}};
        // Bent at rest, too; sections, offsets and rolls of their own.
        const Quat restBend = glm::angleAxis(randomNumber(random, -1.5, 1.5), glm::normalize(randomVector(random, 1)));
        elbow.skeleton.joints[2].at = elbow.skeleton.joints[1].at + restBend * Vec3(0, 0, 3);
        for (Limb& limb : elbow.limbs) {
            limb.size = {randomNumber(random, 0.5, 1.5), randomNumber(random, 0.5, 1.5)};
            limb.offset = 0.2 * Vec2(randomNumber(random, -1, 1), randomNumber(random, -1, 1));
            limb.roll = randomNumber(random, -4, 4);
        }
        Pose pose = restPose(elbow.skeleton);
        pose.rotate[0] = randomRotation(random);
        pose.rotate[1] = glm::angleAxis(randomNumber(random, -1.4, 1.4), glm::normalize(randomVector(random, 1)));
        pose.translate[0] = randomVector(random, 2);
        const auto rest = elbow.rest(), posed = posedJoints(elbow.skeleton, pose);
        const LimbRegions regions = limbRegions(elbow.limbs, rest, posed, elbow.options);

        const std::size_t shift =
            nearestShift(linesOf(elbow.limbs[0], rest, rest), linesOf(elbow.limbs[1], rest, rest), rest[1].position);
        const auto expected = sharedQuadrilateral(linesOf(elbow.limbs[0], rest, posed),
                                                  linesOf(elbow.limbs[1], rest, posed), posed[1].position, shift);
        const auto end = cornersOf(regions, 0, elbow.options.cells, true);
        const auto start = cornersOf(regions, 1, elbow.options.cells, false);
        for (std::size_t m = 0; m < 4; ++m) {
            EXPECT_LT(glm::length(end[m] - expected[m]), 1e-12) << n;
            EXPECT_EQ(start[m], end[m]);
        }
        // The other ends are planes across the bones.
        const auto begin = cornersOf(regions, 0, elbow.options.cells, false);
        const auto lines = linesOf(elbow.limbs[0], rest, posed);
        for (std::size_t m = 0; m < 4; ++m) EXPECT_LT(glm::length(begin[m] - lines.at[m]), 1e-12);
    }
}

TEST(LimbRegions, FacesAreSharedByVertexAndSplitAlike) {
    // Rolls at which the second limb's x axis runs along any of the first's four.
    for (const double roll : {0.0, 1.5, 3.1, -1.6, 0.7}) {
        Elbow elbow;
        elbow.options.cells = {3, 2, 2};
        elbow.limbs[1].roll = roll;
        const LimbRegions regions = elbow.bent({40, 20, 10});
        for (std::size_t c = 0; c < 6; ++c)
            for (std::size_t corner = 0; corner < 4; ++corner)
                EXPECT_EQ(regions.cells.hexahedra[6 + c][4 + corner], regions.cells.hexahedra[12 + c][corner]);
        // At rest the face is not turned: its corners are those of the first limb.
        const LimbRegions rest = elbow.bent({0, 0, 0});
        if (roll == 0.7) continue;
        const auto end = cornersOf(rest, 0, elbow.options.cells, true);
        for (std::size_t m = 0; m < 4; ++m) {
            const Vec3 straight = cornersOf(rest, 0, elbow.options.cells, false)[m] + Vec3(0, 0, 3);
            EXPECT_LT(glm::length(end[m] - straight), 0.08) << roll;
        }
    }
}

TEST(LimbRegions, NoGapsAtAnyBendOrTwist) {
    for (const bool smooth : {false, true})
        for (const double miterLimit : {1.0, 1.3, 2.0, 20.0})
            for (int bend = -150; bend <= 150; bend += 30)
                for (const double twist : {-100.0, 0.0, 40.0, 100.0}) {
                    Elbow elbow;
                    elbow.limbs[0].size = {1, 0.7};
                    elbow.limbs[1].size = {0.6, 1};
                    elbow.limbs[1].offset = {0.1, 0.05};
                    elbow.options = {{3, 4, 5}, miterLimit, smooth, bend % 60 == 0, {}};
                    const LimbRegions regions =
                        elbow.bent(quatOfDegrees({double(bend), 0, 0}) * quatOfDegrees({0, 0, twist}));
                    const JointGaps gaps = gapsAtJoints(regions, elbow.limbs, elbow.rest(), elbow.options);
                    EXPECT_EQ(gaps.joints, 1u);
                    EXPECT_GT(gaps.points, 500u);
                    EXPECT_THAT(gaps.uncovered, testing::IsEmpty())
                        << bend << "° bend, " << twist << "° twist, limit " << miterLimit;
                }
}

TEST(LimbRegions, GapsAreFoundWhereThereAreGaps) {
    Elbow elbow;
    LimbRegions regions = elbow.bent({30, 0, 0});
    // The second limb with vertices of its own, a hair apart from the first.
    const std::size_t half = regions.firstCell[1], vertices = regions.cells.deformed.size();
    auto& cells = regions.cells;
    const auto deformed = cells.deformed, source = cells.source;
    const auto jacobian = cells.jacobian;
    cells.deformed.insert(cells.deformed.end(), deformed.begin(), deformed.end());
    cells.source.insert(cells.source.end(), source.begin(), source.end());
    cells.jacobian.insert(cells.jacobian.end(), jacobian.begin(), jacobian.end());
    for (std::size_t v = vertices; v < 2 * vertices; ++v) cells.deformed[v].z += 1e-3;
    for (std::size_t c = half; c < cells.hexahedra.size(); ++c)
        for (std::uint32_t& v : cells.hexahedra[c]) v += std::uint32_t(vertices);
    EXPECT_GT(gapsAtJoints(regions, elbow.limbs, elbow.rest(), elbow.options).uncovered.size(), 20u);
}

TEST(LimbRegions, ADisjointJointThatMovesAwayStretchesNothing) {
    Random random(41);
    const Skeleton skeleton = randomSkeleton(random, 9);
    const auto limbs = randomLimbs(random, skeleton);
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    Pose pose = randomPose(random, skeleton);
    for (Vec3& translate : pose.translate) translate = randomVector(random, 2);
    const auto posed = posedJoints(skeleton, pose);
    RegionOptions options;
    options.disjoint.assign(9, true);
    const LimbRegions regions = limbRegions(limbs, rest, posed, options);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const std::size_t from = std::size_t(limbs[l].from);
        const auto cells = cellsOf(regions, {int(l)});
        for (std::size_t v = 0; v < cells.source.size(); ++v) {
            const Vec3 carried = posed[from].position + posed[from].linear * (cells.source[v] - rest[from].position);
            EXPECT_LT(glm::length(cells.deformed[v] - carried), 1e-12);
        }
    }
}

TEST(LimbRegions, DisjointJointsLeaveRigidBoxes) {
    Random random(4);
    for (int n = 0; n < 40; ++n) {
        const Skeleton skeleton = randomSkeleton(random, 10);
        const auto limbs = randomLimbs(random, skeleton);
        RegionOptions options;
        options.preserveVolume = n % 2;
        options.disjoint.assign(10, true);
        const auto rest = posedJoints(skeleton, restPose(skeleton)),
                   posed = posedJoints(skeleton, randomPose(random, skeleton));
        const LimbRegions regions = limbRegions(limbs, rest, posed, options);
        for (std::size_t l = 0; l < limbs.size(); ++l) {
            const std::size_t from = std::size_t(limbs[l].from);
            const MappedCells::Data cells = cellsOf(regions, {int(l)});
            for (std::size_t v = 0; v < cells.source.size(); ++v) {
                const Vec3 rigid = posed[from].position + posed[from].linear * (cells.source[v] - rest[from].position);
                EXPECT_LT(glm::length(cells.deformed[v] - rigid), 1e-13);
                EXPECT_LT(largest(cells.jacobian[v] - glm::transpose(posed[from].linear)), 1e-12);
            }
            // With pads, and the sizes given.
            const double length = glm::length(rest[std::size_t(limbs[l].to)].position - rest[from].position);
            LimbRegions alone;
            alone.cells = cells;
            EXPECT_NEAR(volumeOf(alone), limbs[l].size.x * limbs[l].size.y * (length + limbs[l].pad.x + limbs[l].pad.y),
                        1e-12);
        }
    }
}

TEST(LimbRegions, RigidMotionOfAllMovesRegionsRigidly) {
    Random random(5);
    for (int n = 0; n < 20; ++n) {
        const Skeleton skeleton = randomSkeleton(random, 10);
        const auto limbs = randomLimbs(random, skeleton);
        const auto rest = posedJoints(skeleton, restPose(skeleton));
        const Mat3 turn = glm::mat3_cast(randomRotation(random));
        const Vec3 move = randomVector(random, 5);
        auto posed = rest;
        for (PosedJoint& joint : posed) joint = {turn, turn * joint.position + move};
        RegionOptions options;
        options.preserveVolume = n % 2;
        const LimbRegions regions = limbRegions(limbs, rest, posed, options);
        for (std::size_t v = 0; v < regions.cells.source.size(); ++v) {
            EXPECT_LT(glm::length(regions.cells.deformed[v] - (turn * regions.cells.source[v] + move)), 1e-12);
            EXPECT_LT(largest(regions.cells.jacobian[v] - glm::transpose(turn)), 1e-9);
        }
    }
}

TEST(LimbRegions, ScaledJointsScaleTheirBoxes) {
    // Laid in by scales that differ along the axes, a joint's map is no rotation; the box follows it.
    Random random(6);
    const Skeleton skeleton = randomSkeleton(random, 8);
    const Mat4 fit(Vec4(2, 0, 0, 0), Vec4(0, 0.5, 0, 0), Vec4(0, 0, 1, 0), Vec4(1, 2, 3, 1));
    const auto rest = laidInto(posedJoints(skeleton, restPose(skeleton)), fit);
    const auto posed = laidInto(posedJoints(skeleton, randomPose(random, skeleton)), fit);
    const auto limbs = randomLimbs(random, skeleton);
    RegionOptions options;
    options.disjoint.assign(8, true);
    const LimbRegions regions = limbRegions(limbs, rest, posed, options);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const std::size_t from = std::size_t(limbs[l].from);
        const MappedCells::Data cells = cellsOf(regions, {int(l)});
        for (std::size_t v = 0; v < cells.source.size(); ++v) {
            const Vec3 carried = posed[from].position + posed[from].linear * (cells.source[v] - rest[from].position);
            EXPECT_LT(glm::length(cells.deformed[v] - carried), 1e-12);
        }
    }
}

TEST(LimbRegions, TheOrderOfLimbsDoesNotMatter) {
    Random random(7);
    const Skeleton skeleton = randomSkeleton(random, 15);
    auto limbs = randomLimbs(random, skeleton);
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    const auto posed = posedJoints(skeleton, randomPose(random, skeleton));
    RegionOptions options;
    options.preserveVolume = true;
    const LimbRegions forward = limbRegions(limbs, rest, posed, options);
    const int count = int(limbs.size());
    std::reverse(limbs.begin(), limbs.end());
    const LimbRegions backward = limbRegions(limbs, rest, posed, options);
    for (int l = 0; l < count; ++l) {
        const MappedCells::Data a = cellsOf(forward, {l}), b = cellsOf(backward, {count - 1 - l});
        EXPECT_TRUE(a.deformed == b.deformed);
        EXPECT_TRUE(a.source == b.source);
        EXPECT_TRUE(a.hexahedra == b.hexahedra);
        for (std::size_t v = 0; v < a.jacobian.size(); ++v)
            EXPECT_LT(largest(a.jacobian[v] - b.jacobian[v]), 1e-9 * (1 + largest(a.jacobian[v])));
    }
}

TEST(LimbRegions, AtAHubTheStraightestContinuesAndTheOthersOverlap) {
    Skeleton skeleton{{{"pelvis", Joint::kNoParent, Vec3(0), {}},
                       {"chest", 0, Vec3(0, 0, 2), {}},
                       {"left", 1, Vec3(1.5, 0, 2.5), {}},
                       {"neck", 1, Vec3(0.1, 0, 3.5), {}},
                       {"right", 1, Vec3(-1.5, 0, 2.5), {}}}};
    std::vector<Limb> limbs{limbBetween(0, 1), limbBetween(1, 2, Vec2(0.5)), limbBetween(1, 3, Vec2(0.6)),
                            limbBetween(1, 4, Vec2(0.5))};
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    EXPECT_EQ(continuationOf(limbs, rest, 0, {}), 2);
    for (const int l : {1, 2, 3}) EXPECT_EQ(continuationOf(limbs, rest, l, {}), -1);
    EXPECT_EQ(continuationOf(limbs, rest, 0, {false, true, false, false, false}), -1);
    EXPECT_EQ(continuationOf(limbs, rest, 0, {true, false, true, true, true}), 2);

    limbs[1].pad = limbs[3].pad = {0.3, 0};
    Pose pose = restPose(skeleton);
    pose.rotate[1] = quatOfDegrees({20, 30, 0});
    const auto posed = posedJoints(skeleton, pose);
    const MappedCells cells(limbRegions(limbs, rest, posed, {}).cells);
    EXPECT_TRUE(cells.mayOverlap());
    // The arms begin `pad` before the joint, in planes across them, so that they reach into the trunk.
    CellLocation at{};
    for (const int child : {2, 3, 4})
        for (double s = 0; s <= 0.99; s += 0.03) {
            const Vec3 to = posed[std::size_t(child)].position;
            EXPECT_TRUE(cells.locate(posed[1].position + s * (to - posed[1].position), at));
        }
    std::vector<CellLocation> found;
    const Vec3 left = posed[2].position - posed[1].position;
    cells.locateAll(posed[1].position - 0.1 * left, found);
    EXPECT_GE(found.size(), 2u);
}

TEST(LimbRegions, OneLimbIsContinuedByOneOnly) {
    // Two limbs end where one begins: the straighter of them is joined to it.
    Skeleton skeleton{{{"a", Joint::kNoParent, Vec3(0), {}},
                       {"b", 0, Vec3(1, 0, 1), {}},
                       {"c", 1, Vec3(0, 0, 2), {}},
                       {"d", 2, Vec3(0, 0, 4), {}}}};
    const std::vector<Limb> limbs{limbBetween(1, 2), limbBetween(0, 2), limbBetween(2, 3)};
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    EXPECT_EQ(continuationOf(limbs, rest, 0, {}), -1);
    EXPECT_EQ(continuationOf(limbs, rest, 1, {}), 2);
    EXPECT_EQ(limbRegions(limbs, rest, rest, {}).firstCell, (std::vector<std::size_t>{0, 288, 576, 864}));
}

TEST(LimbRegions, CellsOfSomeLimbs) {
    Random random(8);
    const Skeleton skeleton = randomSkeleton(random, 8);
    const auto limbs = randomLimbs(random, skeleton);
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    const LimbRegions regions = limbRegions(limbs, rest, posedJoints(skeleton, randomPose(random, skeleton)), {});
    const MappedCells::Data some = cellsOf(regions, {1, 4, 5});
    std::size_t cell = 0;
    for (const std::size_t limb : {1, 4, 5})
        for (std::size_t c = regions.firstCell[limb]; c < regions.firstCell[limb + 1]; ++c, ++cell)
            for (std::size_t n = 0; n < 8; ++n) {
                const std::uint32_t a = regions.cells.hexahedra[c][n], b = some.hexahedra[cell][n];
                EXPECT_EQ(regions.cells.deformed[a], some.deformed[b]);
                EXPECT_EQ(regions.cells.source[a], some.source[b]);
                EXPECT_EQ(regions.cells.jacobian[a], some.jacobian[b]);
            }
    EXPECT_EQ(cell, some.hexahedra.size());
    EXPECT_TRUE(cellsOf(regions, {}).hexahedra.empty());
    // No vertex is left over.
    std::vector<bool> used(some.deformed.size(), false);
    for (const auto& h : some.hexahedra)
        for (const std::uint32_t v : h) used[v] = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST(LimbRegions, OutlinesAreTheTwelveEdges) {
    Elbow elbow;
    elbow.options.cells = {3, 2, 5};
    const LimbRegions regions = elbow.bent({70, 0, 20});
    for (const int limb : {0, 1}) {
        const auto edges = outlineOf(regions, limb, elbow.options);
        ASSERT_EQ(edges.size(), 12u);
        const auto start = cornersOf(regions, std::size_t(limb), elbow.options.cells, false);
        const auto end = cornersOf(regions, std::size_t(limb), elbow.options.cells, true);
        std::size_t points = 0;
        for (const auto& edge : edges) {
            points += edge.size();
            for (const Vec3& corner : {edge.front(), edge.back()})
                EXPECT_TRUE(std::count(start.begin(), start.end(), corner) +
                            std::count(end.begin(), end.end(), corner));
        }
        EXPECT_EQ(points, 4u * (4 + 3 + 6));
    }
}

TEST(LimbRegions, RefusalsNameTheLimb) {
    const Elbow elbow;
    const auto message = [&](auto change) {
        Elbow changed = elbow;
        auto rest = changed.rest(), posed = rest;
        change(changed, rest, posed);
        try {
            limbRegions(changed.limbs, rest, posed, changed.options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Joints = std::vector<PosedJoint>;
    EXPECT_EQ(message([](Elbow&, Joints&, Joints&) {}), "");
    EXPECT_THAT(message([](Elbow&, Joints& rest, Joints&) { rest[2] = rest[1]; }),
                HasSubstr("'limb 1': it has no length at rest"));
    EXPECT_THAT(message([](Elbow&, Joints&, Joints& posed) { posed[0] = posed[1]; }),
                HasSubstr("'limb 0': it has no length in the pose"));
    EXPECT_THAT(message([](Elbow&, Joints&, Joints& posed) { posed[2].position.y = kNaN; }),
                HasSubstr("'limb 1': a joint of it is nowhere in the pose"));
    EXPECT_THAT(message([](Elbow&, Joints&, Joints& posed) { posed[1].linear = Mat3(0); }),
                HasSubstr("'limb 1': a joint of it flattens space"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[1].to = 3; }),
                HasSubstr("'limb 1': a joint of it does not exist"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[1].from = -1; }),
                HasSubstr("'limb 1': a joint of it does not exist"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[0].size.y = 0; }),
                HasSubstr("'limb 0': its size is not positive"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[0].size.x = kNaN; }),
                HasSubstr("'limb 0': its size is not positive"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[0].pad.x = kInfinity; }),
                HasSubstr("'limb 0': its offset, pad or roll"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) {
                    e.limbs[0].pad = {-2, -1.5};
                }),
                HasSubstr("'limb 0': its pads leave nothing"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) {
                    e.limbs[0].name.clear();
                    e.limbs[0].roll = kNaN;
                }),
                HasSubstr("limb 0: its offset"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.limbs[1] = limbBetween(1, 0); }),
                HasSubstr("limbs continue it in a circle"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.options.cells.y = 0; }), HasSubstr("a limb has no cells"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.options.miterLimit = 0.5; }), HasSubstr("miter limit"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.options.miterLimit = kNaN; }), HasSubstr("miter limit"));
    EXPECT_THAT(message([](Elbow& e, Joints&, Joints&) { e.options.cells = Index3(2'000'000'000); }),
                HasSubstr("are too many"));
    EXPECT_THAT(message([](Elbow&, Joints&, Joints& posed) { posed.pop_back(); }),
                HasSubstr("3 joints at rest but 2 posed"));
}

}  // namespace
}  // namespace voledit
