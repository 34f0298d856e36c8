// A body rigged by itself, moved by other skeletons' motions: no gap at any joint of any frame.

#include <gtest/gtest.h>

#include "core/base/paths.h"
#include "core/io/bvh.h"
#include "core/io/io_client.h"
#include "core/rigging/rig.h"
#include "core/scene/actor_edits.h"
#include "core/scene/edits.h"
#include "tests/support/joint_gaps.h"

namespace voledit {
namespace {

struct Body {
    Scene scene;
    LoadedAssets assets;
    double covered = 0;
};

/// The person of resources, rigged, with a motion of resources.
Body rigged(const std::string& motion) {
    Body body;
    IoClient io;
    body.scene = sceneOfVolume("human_body.mhd", "body", "");
    body.assets.volumes["body"] = io.readVolume(resourceFolder() / "volumes/human_body.mhd").volume;
    const OpaqueVoxels voxels = opaqueVoxels(*compile(body.scene, body.assets, 0, nullptr).root, 0.02);
    const Rig rig = fittedRig(voxels, RigTemplate::Biped);
    const NodePath actor = addActor(body.scene, kRootPath, "actor", rig);
    const auto read = std::make_shared<const Motion>(readBvh(resourceFolder() / "motions" / (motion + ".bvh")));
    const std::string asset = addMotionAsset(body.scene, motion, motion + ".bvh");
    setMotion(body.scene, actor, asset, *read);
    body.assets.motions[asset] = read;
    const auto rest = posedJoints(rig.skeleton, restPose(rig.skeleton));
    body.covered = coverageOf(voxels, rig.limbs, rest, {}).covered();
    return body;
}

/// How many of the deformed points show something of the body.
int visibleAt(const CompiledActor& actor, const std::vector<Vec3>& points) {
    const MappedCells cells(actor.regions->cells);
    int visible = 0;
    std::vector<CellLocation> found;
    for (const Vec3& p : points) {
        found.clear();
        cells.locateAll(p, found);
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
        ASSERT_EQ(gaps.uncovered.size(), 0u) << "frame " << frame;
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
