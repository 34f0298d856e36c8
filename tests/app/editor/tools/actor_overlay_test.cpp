#include "app/editor/tools/actor_overlay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/editor/theme.h"
#include "tests/app/editor/actor_rig.h"

namespace voledit {
namespace {

class ActorOverlayTest : public testing::Test {
protected:
    ActorOverlayTest() {
        test::openActor(workspace);
        look.camera = workspace.camera;
        look.size = workspace.viewSize;
    }
    const CompiledActor& actor() const { return *workspace.compiled.actors.at(0); }
    Workspace workspace;
    ActorLook look;
};

TEST_F(ActorOverlayTest, RegionsAreOutlinedOnlyWhereTheyAreWanted) {
    Overlay plain, regions, one;
    appendActor(actor(), look, plain);
    look.regions = true;
    appendActor(actor(), look, regions);
    look.regions = false;
    look.selected = {actor().skeleton.find("LeftArm")};
    appendActor(actor(), look, one);
    const std::size_t all = regions.lines.size() - plain.lines.size(), single = one.lines.size() - plain.lines.size();
    EXPECT_EQ(all, actor().limbs.size() * single);
    // Seven limbs of twelve edges, cut along their cells.
    EXPECT_GE(single, 12u);
    EXPECT_TRUE(std::all_of(one.lines.begin(), one.lines.begin() + std::ptrdiff_t(single),
                            [](const OverlayLine& line) { return Vec3f(line.color) == Vec3f(theme::kAccent); }));
}

TEST_F(ActorOverlayTest, RingsAreAsLargeOnTheScreenFromFarAsFromNear) {
    const int joint = actor().skeleton.find("LeftArm");
    const auto radiusFrom = [&](double distance) {
        look.camera.eye = look.camera.target - Vec3(0, distance, 0);
        Overlay overlay;
        appendRings(actor(), joint, std::nullopt, look, overlay);
        const Vec2 center(project(look.camera, look.size, shownJoint(actor(), joint)));
        double largest = 0;
        for (const OverlayLine& line : overlay.lines)
            largest = std::max(largest, glm::distance(Vec2(project(look.camera, look.size, line.from)), center));
        return largest;
    };
    EXPECT_NEAR(radiusFrom(8), radiusFrom(80), 2);
    EXPECT_NEAR(radiusFrom(8), 1.22 * 62, 2);
}

TEST_F(ActorOverlayTest, ARingIsTakenOnItsNearHalf) {
    const int joint = actor().skeleton.find("LeftArm");
    look.camera.eye = {0.4, -10, 1};
    look.camera.target = {0.4, 0, 1};
    const Vec2 center(project(look.camera, look.size, shownJoint(actor(), joint)));
    // About y, which points along the view: a whole circle.
    EXPECT_EQ(ringAt(actor(), joint, look, center + 62.0 * Vec2(0.6, 0.8), 4), RingHit{1});
    EXPECT_EQ(ringAt(actor(), joint, look, center + 62.0 * Vec2(-0.6, 0.8), 4), RingHit{1});
    // The view's own, further out.
    EXPECT_EQ(ringAt(actor(), joint, look, center + 1.22 * 62.0 * Vec2(0.6, -0.8), 4), RingHit{3});
    // About x: edge on, a line up and down through the joint.
    EXPECT_EQ(ringAt(actor(), joint, look, center + Vec2(1, 30), 4), RingHit{0});
    EXPECT_EQ(ringAt(actor(), joint, look, center + Vec2(30, 31), 4), std::nullopt);
}

TEST_F(ActorOverlayTest, VoxelsThatNoRegionHoldsAreRedAndThoseOfSeveralYellow) {
    ActorBody body;
    body.voxels.size = {4, 1, 1};
    body.voxels.opaque = {1, 1, 0, 1};
    Coverage coverage;
    coverage.opaque = 3;
    coverage.uncovered = 1;
    coverage.doubly = 1;
    coverage.regions = {0, 2, 0, 1};
    Overlay overlay;
    appendCoverage(actor(), body, coverage, 1, overlay);
    ASSERT_EQ(overlay.points.size(), 2u);
    EXPECT_EQ(overlay.points[0].at, Vec3(1, 0, 0));
    EXPECT_GT(overlay.points[0].color.y, 0.7);
    EXPECT_EQ(overlay.points[1].at, Vec3(0, 0, 0));
    EXPECT_EQ(Vec3f(overlay.points[1].color), Vec3f(theme::kProblem));
}

TEST_F(ActorOverlayTest, OfVeryManyVoxelsSomeAreShown) {
    ActorBody body;
    body.voxels.size = {100, 100, 100};
    body.voxels.opaque.assign(1'000'000, 1);
    Coverage coverage;
    coverage.opaque = coverage.uncovered = 1'000'000;
    coverage.regions.assign(1'000'000, 0);
    Overlay overlay;
    appendCoverage(actor(), body, coverage, 1, overlay);
    EXPECT_GT(overlay.points.size(), 5'000u);
    EXPECT_LT(overlay.points.size(), 20'000u);
}

}  // namespace
}  // namespace voledit
