// A body rigged by itself, moved by other skeletons' motions: no gap at any joint of any frame.

#include <gtest/gtest.h>

#include "tests/support/joint_gaps.h"
#include "tests/support/rigged_body.h"

namespace voledit {
namespace {

/// How many of the deformed points have something of the body at or beside them, an eighth of a voxel off. (Rims of
/// blended regions bend, so that a ray through a joint may pass beside one, in the air.)
int visibleAt(const CompiledActor& actor, const std::vector<Vec3>& points) {
    const MappedCells cells(actor.regions->cells);
    int visible = 0;
    std::vector<CellLocation> found;
    for (const Vec3& p : points) {
        found.clear();
        for (const Vec3& beside : {Vec3(0), Vec3(0.01, 0, 0), Vec3(-0.01, 0, 0), Vec3(0, 0.01, 0), Vec3(0, -0.01, 0),
                                   Vec3(0, 0, 0.01), Vec3(0, 0, -0.01)})
            cells.locateAll(p + beside, found);
        for (const CellLocation& at : found) {
            const Vec3 q = cells.sourceAt(at);
            ObjectSample seen;
            sample(*actor.of, {&q, 1}, {&seen, 1}, false);
            visible += seen.opacity > 0.02;
        }
    }
    return visible;
}

class ActorGaps : public testing::TestWithParam<const char*> {};

TEST_P(ActorGaps, NoneAtAnyJointOfAnyFrame) {
    const Body body = rigged(GetParam());
    EXPECT_GE(body.covered, 0.99);
    CompiledScene compiled;
    std::size_t points = 0, folded = 0;
    for (int frame = body.scene.timeline.start; frame < body.scene.timeline.end; ++frame) {
        compiled = compile(body.scene, body.assets, frame / body.scene.timeline.fps, &compiled);
        const CompiledActor& actor = *compiled.actors.at(0);
        ASSERT_EQ(actor.limbs.size(), 24u);
        const JointGaps gaps = gapsAtJoints(*actor.regions, actor.limbs, actor.rest, actor.options);
        EXPECT_EQ(gaps.joints, 19u);  // 24 limbs in five chains
        points += gaps.points;
        folded += gaps.folded;
        EXPECT_EQ(visibleAt(actor, gaps.uncovered), 0) << "frame " << frame;
        EXPECT_LT(gaps.uncovered.size(), gaps.points / 10'000) << "frame " << frame;
        // What is drawn leaves cells out that others hold, too; at their rims only air may be lost.
        JointRays drawn(*actor.regions, actor.options, joinedCells(*actor.regions));
        const JointGaps left = drawn.across(actor.limbs, actor.rest, actor.options.disjoint);
        EXPECT_EQ(visibleAt(actor, left.uncovered), 0) << "frame " << frame << ", of " << left.uncovered.size();
    }
    EXPECT_GT(points, 100'000u);
    EXPECT_LT(folded, points / 140 / 20);
}

INSTANTIATE_TEST_SUITE_P(Motions, ActorGaps, testing::Values("makehuman_zombie_walk", "cmu_jumping_jacks"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace voledit
