// Places of all joints against another reader's (data/mocap/*.ref.json, by three.js).

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/io/bvh.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

class BvhReference : public testing::TestWithParam<const char*> {};

double heightOf(const Skeleton& skeleton) {
    Vec3 low(kInfinity), high(-kInfinity);
    for (const Joint& joint : skeleton.joints) {
        low = glm::min(low, joint.at);
        high = glm::max(high, joint.at);
    }
    return std::max(high.y - low.y, high.z - low.z);
}

TEST_P(BvhReference, JointsStandWhereTheOtherReaderPutsThem) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam() + ".bvh");
    VOLEDIT_SHARED_OR_SKIP(referencePath, std::string("data/mocap/") + GetParam() + ".ref.json");
    const auto reference = nlohmann::json::parse(std::ifstream(referencePath));
    std::vector<std::string> warnings;
    const Motion motion = readBvh(path, &warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();

    const auto& hierarchy = reference["hierarchy"];
    ASSERT_EQ(motion.joints.size(), hierarchy.size());
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
        const MotionJoint& joint = motion.joints[j];
        EXPECT_EQ(joint.name, hierarchy[j][0]);
        if (hierarchy[j][1].is_null())
            EXPECT_EQ(joint.parent, Joint::kNoParent);
        else
            EXPECT_EQ(motion.joints[std::size_t(joint.parent)].name, hierarchy[j][1]);
    }
    EXPECT_EQ(motion.frames, reference["frames_total"]);
    EXPECT_NEAR(motion.frameTime, double(reference["frame_time"]), 1e-12);

    const char* const replacing = "frames_root_position_replaces_offset";
    const auto& frames = reference[reference.contains(replacing) ? replacing : "frames"];
    ASSERT_GE(frames.size(), 1u);
    const Skeleton skeleton = skeletonOf(motion);
    double largest = 0;
    for (const auto& [frame, places] : frames.items()) {
        const auto posed = posedJoints(skeleton, poseOfFrame(motion, std::stoul(frame)));
        ASSERT_EQ(places.size(), posed.size());
        for (std::size_t j = 0; j < posed.size(); ++j) {
            ASSERT_EQ(places[j][0], motion.joints[j].name);
            for (int a = 0; a < 3; ++a)
                largest = std::max(largest, std::abs(posed[j].position[a] - double(places[j][std::size_t(a) + 1])));
        }
    }
    std::ostringstream shown;
    shown << largest / heightOf(skeleton);
    RecordProperty("largest_difference_in_heights", shown.str());
    EXPECT_LE(largest, 1e-5 * heightOf(skeleton));
}

INSTANTIATE_TEST_SUITE_P(, BvhReference,
                         testing::Values("av_8walk", "cmu_jumping_jacks", "fair_dab", "mocapbank_crlf",
                                         "makehuman_zombie_walk", "makehuman_tpose_allpos", "rokoko_jesse_dance"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace voledit
