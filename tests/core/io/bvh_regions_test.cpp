// Regions about the bones of real motions: connected at every joint of every frame.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/io/bvh.h"
#include "core/skeleton/limb_regions.h"
#include "tests/support/fixtures.h"
#include "tests/support/joint_gaps.h"

namespace voledit {
namespace {

/// A limb for each bone that has a length, as thick as a body of that height would have it.
std::vector<Limb> limbsOf(const Skeleton& skeleton) {
    Vec3 low(kInfinity), high(-kInfinity);
    for (const Joint& joint : skeleton.joints) {
        low = glm::min(low, joint.at);
        high = glm::max(high, joint.at);
    }
    const double thick = 0.06 * std::max(high.y - low.y, high.z - low.z);
    std::vector<Limb> limbs;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const int parent = skeleton.joints[j].parent;
        if (parent < 0) continue;
        const double length = glm::length(skeleton.joints[j].at - skeleton.joints[std::size_t(parent)].at);
        if (!(length > 0)) continue;
        Limb limb;
        limb.name = skeleton.joints[j].name;
        limb.from = parent;
        limb.to = int(j);
        limb.size = std::min(thick, 0.4 * length) * Vec2(1, 0.8);
        limbs.push_back(limb);
    }
    return limbs;
}

class BvhRegions : public testing::TestWithParam<const char*> {};

TEST_P(BvhRegions, NoGapsAtAnyJointOfAnyFrame) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam() + ".bvh");
    const Motion motion = readBvh(path);
    const Skeleton skeleton = skeletonOf(motion);
    const std::vector<Limb> limbs = limbsOf(skeleton);
    const auto rest = posedJoints(skeleton, restPose(skeleton));
    RegionOptions options;
    options.cells = {2, 2, 6};
    std::size_t points = 0, folded = 0;
    // A long recording's neighbouring frames are alike.
    const std::size_t step = std::max<std::size_t>(1, motion.frames / 150);
    for (std::size_t frame = 0; frame < motion.frames; frame += step) {
        const auto posed = posedJoints(skeleton, poseOfFrame(motion, frame));
        const LimbRegions regions = limbRegions(limbs, rest, posed, options);
        const JointGaps gaps = gapsAtJoints(regions, limbs, rest, options);
        points += gaps.points;
        folded += gaps.folded;
        ASSERT_THAT(gaps.uncovered, testing::IsEmpty()) << "frame " << frame;
    }
    // About 140 points are looked at for each cell at a joint.
    EXPECT_GT(points, 100'000u);
    EXPECT_LT(folded, points / 140 / 20);
}

// Without rokoko_jesse_dance, whose rest pose lays every bone along x, one upon the other: no object has such a shape.
INSTANTIATE_TEST_SUITE_P(Motions, BvhRegions,
                         testing::Values("makehuman_zombie_walk", "cmu_jumping_jacks", "av_8walk", "fair_dab",
                                         "mocapbank_crlf"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace voledit
