#include "app/editor/tools/region_handles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/app/editor/actor_rig.h"

namespace voledit {
namespace {

class RegionHandlesTest : public testing::Test {
protected:
    RegionHandlesTest() { test::openActor(workspace); }
    const CompiledActor& actor() const { return *workspace.compiled.actors.at(0); }
    void pullFace(int limb, int face, double distance) {
        const ActorPtr before = workspace.compiled.actors.at(0);
        const Limb& was = before->limbs[std::size_t(limb)];
        workspace.document.apply("Pull", [&](Scene& scene) {
            editLimb(
                scene, "/root", was.name, [&](SceneLimb& changed) { pull(changed, was, face, distance); }, *before);
        });
        test::recompile(workspace);
    }
    Workspace workspace;
};

TEST_F(RegionHandlesTest, APulledFaceGoesOutAndTheOppositeOneStays) {
    for (int face = 0; face < 6; ++face) {
        std::array<Vec3, 6> before;
        for (int f = 0; f < 6; ++f) before[std::size_t(f)] = placeOf(actor(), {2, f}).at;
        const Vec3 out = placeOf(actor(), {2, face}).out;
        EXPECT_NEAR(glm::length(out), 1, 1e-12);
        pullFace(2, face, 0.125);
        EXPECT_LT(glm::distance(placeOf(actor(), {2, face}).at, before[std::size_t(face)] + 0.125 * out), 1e-12);
        const int opposite = face ^ 1;
        EXPECT_LT(glm::distance(placeOf(actor(), {2, opposite}).at, before[std::size_t(opposite)]), 1e-12) << face;
    }
}

TEST_F(RegionHandlesTest, ABoxCannotBePushedThroughItself) {
    pullFace(2, 1, -100);
    EXPECT_GT(actor().limbs[2].size.x, 0);
    EXPECT_LT(actor().limbs[2].size.x, 0.01);
    EXPECT_TRUE(workspace.compiled.actors.at(0)->regions);
}

TEST_F(RegionHandlesTest, TheHandleFollowsThePointerOnTheScreen) {
    // The upper face of the left forearm, seen from the front.
    for (int face = 0; face < 4; ++face) {
        const HandlePlace place = placeOf(actor(), {2, face});
        const Vec2 start(project(workspace.camera, workspace.viewSize, place.at));
        if (std::abs(place.out.z) < 0.5) continue;
        const double by = pulledBy(place, workspace.camera, workspace.viewSize, Vec2(0, -20));
        EXPECT_GT(by * place.out.z, 0);
        const Vec2 end(project(workspace.camera, workspace.viewSize, place.at + by * place.out));
        EXPECT_LT(glm::distance(end, start + Vec2(0, -20)), 0.5);
        EXPECT_EQ(handleAt(actor(), {2}, workspace.camera, workspace.viewSize, start + Vec2(3, 0), 9),
                  (RegionHandle{2, face}));
    }
    EXPECT_FALSE(handleAt(actor(), {2}, workspace.camera, workspace.viewSize, {5, 5}, 9));
}

TEST_F(RegionHandlesTest, AFaceSeenFromTheFrontIsNotPulled) {
    for (int face = 0; face < 4; ++face)
        if (HandlePlace place = placeOf(actor(), {2, face}); std::abs(place.out.y) > 0.5) {
            workspace.camera.eye = place.at - Vec3(0, 10, 0);
            workspace.camera.target = place.at;
            EXPECT_EQ(pulledBy(place, workspace.camera, workspace.viewSize, Vec2(0, -20)), 0);
        }
}

}  // namespace
}  // namespace voledit
