#include "core/skeleton/limb_joints.h"

#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "elbow.h"

namespace voledit {
namespace {

/// Two limbs that meet at the origin, the first along z, the second turned about `axis`.
struct Pair {
    PlacedLimb first, second;
    Pair(double angle, const Vec3& axis, double twist = 0) {
        const Limb limb = limbBetween(0, 1);
        const PosedJoint joint{Mat3(1), Vec3(0)}, below{Mat3(1), Vec3(0, 0, -2)};
        first = placedLimb(limb, Mat3(1), 0, below, joint);
        const Mat3 turn = glm::mat3_cast(glm::angleAxis(angle, axis) * glm::angleAxis(twist, Vec3(0, 0, 1)));
        second = placedLimb(limb, Mat3(1), 0, {turn, Vec3(0)}, {turn, turn * Vec3(0, 0, 2)});
    }
};

double distance(const Quad& a, const Quad& b) {
    double most = 0;
    for (std::size_t m = 0; m < 4; ++m) most = std::max(most, glm::length(a[m] - b[m]));
    return most;
}

TEST(MiterLimit, TheCornerReachesAsFarAsItLets) {
    for (const double limit : {1.0, 1.2, 2.0, 5.0})
        for (double degrees = 0; degrees < 180; degrees += 5) {
            const double angle = degrees * kPi / 180;
            const JointFaces faces = jointFaces(Pair(angle, {1, 0, 0}).first, Pair(angle, {1, 0, 0}).second, limit);
            // The outer corners are as far from the axis of the bend as the mitre makes them, or the limit lets them.
            const double mitre = std::min(1 / std::cos(angle / 2), limit);
            double most = 0;
            for (const Vec3& corner : faces.end) most = std::max(most, std::hypot(corner.y, corner.z));
            EXPECT_NEAR(most, 0.5 * mitre, 1e-9);
            EXPECT_EQ(faces.wedge > 0, 1 / std::cos(angle / 2) > limit * (1 + 1e-12)) << degrees << " " << limit;
            EXPECT_NEAR(faces.wedge, std::max(0.0, angle - 2 * std::acos(1 / limit)), 1e-12);
        }
}

TEST(MiterLimit, FacesFollowTheBendContinuously) {
    Random random(1);
    for (int n = 0; n < 100; ++n) {
        const Vec3 axis = glm::normalize(Vec3(randomNumber(random, -1, 1), randomNumber(random, -1, 1), 0));
        const double limit = randomNumber(random, 1.05, 3), at = largestMitre(limit),
                     twist = randomNumber(random, -1, 1);
        const Pair before(at - 1e-9, axis, twist), after(at + 1e-9, axis, twist);
        const JointFaces a = jointFaces(before.first, before.second, limit),
                         b = jointFaces(after.first, after.second, limit);
        EXPECT_EQ(a.wedge, 0);
        EXPECT_NEAR(b.wedge, 1e-9, 1e-12);
        EXPECT_LT(distance(a.end, b.end), 1e-7);
        EXPECT_LT(distance(a.start, b.start), 1e-7);
        EXPECT_EQ(distance(a.end, a.start), 0);
    }
}

TEST(MiterLimit, BothFacesAreOneFaceTurnedAboutTheJoint) {
    Random random(2);
    for (int n = 0; n < 100; ++n) {
        const Vec3 axis = glm::normalize(Vec3(randomNumber(random, -1, 1), randomNumber(random, -1, 1), 0));
        const Pair pair(randomNumber(random, 2.2, 3.1), axis, randomNumber(random, -1, 1));
        const JointFaces faces = jointFaces(pair.first, pair.second, 2);
        // Each lies in a plane of its own through the joint, turned by the limit's half against its bone.
        const double half = largestMitre(2) / 2;
        for (const auto& [face, limb] : {std::pair(faces.end, pair.first), std::pair(faces.start, pair.second)}) {
            const Vec3 normal = glm::normalize(glm::cross(face[2] - face[0], face[3] - face[1]));
            for (const Vec3& corner : face) EXPECT_LT(std::abs(glm::dot(corner, normal)), 1e-14);
            EXPECT_NEAR(glm::dot(normal, limb.direction), std::cos(half), 1e-12);
        }
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b)
                EXPECT_NEAR(glm::length(faces.end[a] - faces.end[b]), glm::length(faces.start[a] - faces.start[b]),
                            1e-14);
    }
}

TEST(MiterLimit, StraightBackIsFinite) {
    for (const double limit : {1.0, 2.0, 1e300}) {
        for (const double less : {0.0, 1e-15, 1e-12, 1e-9}) {
            const Pair pair(kPi - less, {0, 1, 0});
            const JointFaces faces = jointFaces(pair.first, pair.second, limit);
            for (const Quad& face : {faces.end, faces.start})
                for (const Vec3& corner : face) EXPECT_LE(glm::length(corner), 0.5 * std::min(limit, 1e3) + 0.51);
        }
    }
}

/// All of an elbow's bevel cells' tetrahedra that hold p, with the volume that they turn inside out left out.
TEST(Bevel, ClosesTheWedgeUpToItsFlatOuterFaces) {
    for (const double limit : {1.0, 1.3, 2.0})
        for (const double degrees : {100.0, 130.0, 150.0, 170.0}) {
            Elbow elbow;
            elbow.options.miterLimit = limit;
            elbow.options.smooth = false;
            const MappedCells cells(elbow.bent({degrees, 0, 0}).cells);
            const Vec3 joint = elbow.skeleton.joints[1].at;
            const double wedge = degrees * kPi / 180 - largestMitre(limit);
            if (wedge <= 0) continue;
            // The bend turns +z to −y, so that its outside is +y. There the sections' side lies half a unit off the
            // axis, and in the tilted end face as much farther as the limit lets it.
            const double reach = 0.5 * limit, start = -largestMitre(limit) / 2;
            const int layers = int(std::ceil((kPi - largestMitre(limit)) / (kPi / 4) - 1e-9));
            const double inner = reach * std::cos(wedge / layers / 2);  // of the flat faces' middles
            CellLocation at{};
            for (double part = 0.01; part < 1; part += 0.07)
                for (const double r : {0.01, 0.3, 0.9, 0.999})
                    for (const double x : {-0.49, 0.0, 0.2, 0.49}) {
                        const double angle = -start + part * wedge;
                        const Vec3 p = joint + Vec3(x, r * inner * std::cos(angle), r * inner * std::sin(angle));
                        ASSERT_TRUE(cells.locate(p, at)) << limit << " " << degrees << " " << part << " " << r;
                        // Within it, the source is the face that both limbs share at rest.
                        EXPECT_NEAR(cells.sourceAt(at).z, joint.z, r < 0.02 ? 0.1 : 1e-12);
                    }
        }
}

TEST(Bevel, BelongsToTheLimbThatEndsThere) {
    Elbow elbow;
    EXPECT_EQ(elbow.bent({110, 0, 0}).firstCell, (std::vector<std::size_t>{0, 160, 320}));
    const LimbRegions past = elbow.bent({130, 0, 0});
    // Two layers of the outer half of the face.
    EXPECT_EQ(past.firstCell, (std::vector<std::size_t>{0, 160 + 2 * 8, 336}));
    EXPECT_EQ(cellsOf(past, {1}).hexahedra.size(), 160u);
}

TEST(Bevel, OfARestPosePastTheLimitOpensAndCloses) {
    Elbow elbow;
    elbow.skeleton.joints[2].at = elbow.skeleton.joints[1].at + quatOfDegrees({140, 0, 0}) * Vec3(0, 0, 3);
    const LimbRegions rest = elbow.bent({0, 0, 0});
    EXPECT_GT(rest.cells.hexahedra.size(), 320u);
    EXPECT_TRUE(rest.cells.deformed == rest.cells.source);
    // Every cell holds some of the rest space, none of it twice on the outside.
    const MappedCells cells(rest.cells);
    for (const double determinant : cells.determinants())
        EXPECT_TRUE(determinant == 0 || std::abs(determinant - 1) < 1e-9);
    // Stretched out, the wedge is gone, and the faces, each with a source of its own, lie upon each other.
    const LimbRegions straight = elbow.bent({-140, 0, 0});
    EXPECT_EQ(straight.cells.hexahedra.size(), 320u);
    for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 4; ++i) {
            const std::uint32_t a = gridVertex(straight, 0, elbow.options.cells, {i, j, 10});
            const std::uint32_t b = gridVertex(straight, 1, elbow.options.cells, {i, j, 0});
            EXPECT_NE(a, b);
            EXPECT_EQ(straight.cells.deformed[a], straight.cells.deformed[b]);
        }
}

TEST(Links, ChainsInOrder) {
    Elbow elbow;
    const LimbLinks links = linkedLimbs({limbBetween(1, 2), limbBetween(0, 1)}, elbow.rest(), {});
    EXPECT_EQ(links.next, (std::vector<int>{-1, 0}));
    EXPECT_EQ(links.previous, (std::vector<int>{1, -1}));
    EXPECT_EQ(links.order, (std::vector<int>{1, 0}));
}

TEST(Turns, TheNearestCornersGoTogether) {
    for (int quarters = -4; quarters <= 4; ++quarters)
        for (const double off : {-0.6, 0.0, 0.7}) {
            // The second section's frame lies quarters·90° + off ahead, so that many corners earlier in its order.
            const Pair pair(0.5, {1, 0, 0}, quarters * kPi / 2 + off);
            EXPECT_EQ(matchingTurns(pair.first, pair.second, 2), ((-quarters) % 4 + 4) % 4) << quarters << " " << off;
        }
}

}  // namespace
}  // namespace voledit
