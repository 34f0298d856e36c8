#include "core/stf/source_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/stf/affine.h"

namespace voledit {
namespace {

/// A grid over the frame, bent where it is deformed, its sources moved by `move`.
template <class Move>
MappedCells::Data grid(const Frame& frame, const Move& move) {
    MappedCells::Data data = gridCells(frame, {5, 4, 3});
    for (Vec3& q : data.source) q = move(q);
    for (Vec3& p : data.deformed) p += Vec3(0.2 * p.y * p.y, 0, 0.1 * p.x);
    return data;
}

std::vector<Vec4> facesOf(MappedCells::Data data) {
    const MappedCells cells(std::move(data));
    return {cells.sourceFaces().begin(), cells.sourceFaces().end()};
}

Vec3 unmoved(const Vec3& q) {
    return q;
}

const Frame kBox = frameOf({Vec3(-1, 0, 2), Vec3(3, 2, 3)});
const Frame kOblique{Vec3(1, 2, 3), {Vec3(2, 0.5, 0), Vec3(-1, 2, 0.3), Vec3(0, 0.4, 1.5)}};

void expectFaces(const std::vector<Vec4>& faces, const Frame& frame) {
    ASSERT_EQ(faces.size(), 6u);
    for (const Vec4& face : faces) {
        EXPECT_NEAR(glm::length(Vec3(face)), 1, 1e-12);
        // Each holds four corners of the frame and has the other four within.
        int on = 0, inside = 0;
        for (int c = 0; c < 8; ++c) {
            const Vec3 corner = transformPoint(worldFromNormalised(frame), Box3{Vec3(0), Vec3(1)}.corner(c));
            const double distance = glm::dot(Vec3(face), corner) + face.w;
            on += std::abs(distance) < 1e-9;
            inside += distance > 1e-9;
        }
        EXPECT_EQ(on, 4);
        EXPECT_EQ(inside, 4);
    }
    for (std::size_t n = 0; n < 6; ++n)
        for (std::size_t m = 0; m < n; ++m) EXPECT_GT(glm::length(faces[n] - faces[m]), 0.1);
}

TEST(SourceSolid, OfAGridAreTheFacesOfItsFrame) {
    expectFaces(facesOf(grid(kBox, unmoved)), kBox);
    expectFaces(facesOf(grid(kOblique, unmoved)), kOblique);
}

TEST(SourceSolid, OfAMitredLimbAreItsSixPlanes) {
    // One end is slanted.
    const auto slanted = [](const Vec3& q) { return Vec3(q.x * (1 + 0.1 * q.y), q.y, q.z); };
    EXPECT_EQ(facesOf(grid(frameOf({Vec3(0), Vec3(2, 1, 1)}), slanted)).size(), 6u);
}

TEST(SourceSolid, ThereIsNoneOfWhatIsNotConvexOrCoveredTwice) {
    const auto round = [](const Vec3& q) { return Vec3(q.x + 0.1 * std::sin(q.y), q.y, q.z); };
    EXPECT_TRUE(facesOf(grid(kBox, round)).empty());
    // Six flat faces, but one that is bent inwards.
    const auto dented = [](const Vec3& q) { return Vec3(q.x < 0 ? q.x - 0.2 * std::abs(q.y - 1) : q.x, q.y, q.z); };
    EXPECT_TRUE(facesOf(grid(kBox, dented)).empty());
    for (const Frame& frame : {kBox, kOblique}) {
        MappedCells::Data twice = grid(frame, unmoved), again = grid(frame, unmoved);
        const auto base = std::uint32_t(twice.source.size());
        for (std::size_t v = 0; v < again.source.size(); ++v) {
            twice.source.push_back(again.source[v]);
            twice.deformed.push_back(again.deformed[v] + Vec3(20, 0, 0));
        }
        for (auto cell : again.hexahedra) {
            for (auto& v : cell) v += base;
            twice.hexahedra.push_back(cell);
        }
        EXPECT_TRUE(facesOf(twice).empty());
    }
    EXPECT_TRUE(facesOf({}).empty());
}

TEST(SourceSolid, OnlyFacesThatCutABoxAreThroughIt) {
    const MappedCells cells(grid(kBox, unmoved));
    const Mat4 move = placementMatrix(Vec3(5, 0, 0), Vec3(0, 0, std::numbers::pi / 2), Vec3(2));
    EXPECT_TRUE(facesThrough(sourceFacesIn(cells, Mat4(1)), {Vec3(-1, 0, 2), Vec3(3, 2, 3)}).empty());
    const auto one = facesThrough(sourceFacesIn(cells, Mat4(1)), {Vec3(0, 0, 2), Vec3(4, 2, 3)});
    ASSERT_EQ(one.size(), 1u);
    EXPECT_LT(glm::length(one[0] - Vec4(-1, 0, 0, 3)), 1e-12);
    // Wherever the space is moved to.
    const auto moved = facesThrough(sourceFacesIn(cells, move), transformed({Vec3(0, 0, 2), Vec3(4, 2, 3)}, move));
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_NEAR(glm::dot(Vec3(moved[0]), transformPoint(move, Vec3(3, 1, 2.5))) + moved[0].w, 0, 1e-9);
    EXPECT_NEAR(glm::dot(Vec3(moved[0]), transformPoint(move, Vec3(2, 1, 2.5))) + moved[0].w, 2, 1e-9);
}

}  // namespace
}  // namespace voledit
