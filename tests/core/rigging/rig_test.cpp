#include "core/rigging/rig.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "tests/core/rigging/solids.h"

namespace voledit {
namespace {

constexpr double kStep = 0.12;

Vec3 jointOf(const Rig& rig, const std::string& name) {
    const int j = rig.skeleton.find(name);
    EXPECT_GE(j, 0) << name;
    return j < 0 ? Vec3(0) : rig.skeleton.joints[std::size_t(j)].at;
}

std::vector<PosedJoint> restOf(const Rig& rig) {
    return posedJoints(rig.skeleton, restPose(rig.skeleton));
}

void expectSound(const Rig& rig, const OpaqueVoxels& voxels) {
    std::set<std::string> names;
    for (const Limb& limb : rig.limbs) {
        EXPECT_TRUE(names.insert(limb.name).second) << limb.name << " stands twice";
        EXPECT_EQ(rig.skeleton.joints[std::size_t(limb.to)].parent, limb.from);
        EXPECT_GT(std::min(limb.size.x, limb.size.y), 0) << limb.name;
    }
    const Coverage c = coverageOf(voxels, rig.limbs, restOf(rig), {});
    EXPECT_GE(c.covered(), 0.9999);
    EXPECT_LT(double(c.doubly), 0.4 * double(c.opaque));
}

TEST(Biped, HasTwentyFourLimbs) {
    const OpaqueVoxels voxels = test::voxelsOf(test::Person().capsules, 0.2);
    const Rig rig = fittedRig(voxels, RigTemplate::Biped);
    EXPECT_EQ(rig.limbs.size(), 24u);
    EXPECT_EQ(rig.skeleton.joints.size(), 27u);
    EXPECT_EQ(rig.skeleton.joints.front().name, "Hips");
    for (const char* name : {"Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End", "LeftUpLeg", "RightToeBase_End",
                             "LeftShoulder", "RightHand_End"})
        EXPECT_GE(rig.skeleton.find(name), 0) << name;
    expectSound(rig, voxels);
}

class BipedArms : public testing::TestWithParam<double> {};

TEST_P(BipedArms, JointsStandWhereTheBodyBends) {
    const test::Person person(GetParam());
    const OpaqueVoxels voxels = test::voxelsOf(person.capsules, kStep);
    const Rig rig = fittedRig(voxels, RigTemplate::Biped);
    // Tolerances in units of the body, which is 17 high: a twentieth of the height at soft places, less at bends.
    for (const double side : {1.0, -1.0}) {
        const std::string s = side > 0 ? "Left" : "Right";
        const auto m = [&](Vec3 p) { return p.x *= side, p; };
        EXPECT_LT(glm::length(jointOf(rig, s + "Leg") - m(person.knee)), 0.6) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "Foot") - m(person.ankle)), 0.5) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "UpLeg") - m(person.hip)), 1.0) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "Arm") - m(person.shoulder)), 0.7) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "ForeArm") - m(person.elbow)), 0.6) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "Hand") - m(person.wrist)), 0.6) << s;
        EXPECT_LT(glm::length(jointOf(rig, s + "Hand_End") - m(person.finger)), 0.6) << s;
        EXPECT_NEAR(jointOf(rig, s + "ToeBase_End").z, person.toe.z + 0.38, 0.25);
        // The body is its own mirror image, and so is the rig.
        EXPECT_LT(glm::length(jointOf(rig, s + "ForeArm") -
                              jointOf(rig, (side > 0 ? "Right" : "Left") + std::string("ForeArm")) * Vec3(-1, 1, 1)),
                  kStep);
    }
    EXPECT_NEAR(jointOf(rig, "Head_End").y, 16.95, 0.15);
    EXPECT_NEAR(jointOf(rig, "Neck").y, 14.1, 0.6);
    EXPECT_NEAR(jointOf(rig, "Head").y, 15.1, 0.5);
    for (const char* name : {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head"})
        EXPECT_NEAR(jointOf(rig, name).x, 0, kStep) << name;
    expectSound(rig, voxels);
}

INSTANTIATE_TEST_SUITE_P(Poses, BipedArms, testing::Values(0.5, 0.75, 1.1, 1.5));

TEST(Biped, LiesInABodyThatLies) {
    const test::Person person;
    auto capsules = person.capsules;
    // z up, facing −y, as in scenes of medical data; its left is then +x.
    const Mat3 turn(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
    for (auto& c : capsules) c.a = turn * c.a + Vec3(100, 0, -50), c.b = turn * c.b + Vec3(100, 0, -50);
    const OpaqueVoxels voxels = test::voxelsOf(capsules, kStep);
    const Rig rig = fittedRig(voxels, RigTemplate::Biped);
    EXPECT_LT(glm::length(jointOf(rig, "LeftLeg") - (turn * person.knee + Vec3(100, 0, -50))), 0.6);
    EXPECT_LT(glm::length(jointOf(rig, "LeftArm") - (turn * person.shoulder + Vec3(100, 0, -50))), 0.7);
    expectSound(rig, voxels);
}

TEST(Biped, StandsByItsProportionsWhereNoLimbsShow) {
    const OpaqueVoxels pillar = test::voxelsOf({{Vec3(0), Vec3(0, 10, 0), 1.5, 1}}, 0.2);
    const Rig rig = fittedRig(pillar, RigTemplate::Biped);
    EXPECT_EQ(rig.limbs.size(), 24u);
    for (const Joint& joint : rig.skeleton.joints) EXPECT_TRUE(isDefined(joint.at)) << joint.name;
    EXPECT_NO_THROW(limbRegions(rig.limbs, restOf(rig), restOf(rig), {}));
}

/// A body on four legs, facing +z, y up: trunk, neck, head, tail.
struct Beast {
    Vec3 hind{0.7, 3.4, -3}, fore{0.7, 3.4, 3};
    std::vector<test::TaperedCapsule> capsules;
    Beast() {
        capsules = {{{0, 4, -3}, {0, 4, 3}, 1.2, 1.3},
                    {{0, 4.6, 3.2}, {0, 6.6, 4.8}, 0.8, 0.6},
                    {{0, 6.7, 4.9}, {0, 6.3, 6.3}, 0.75, 0.4},
                    {{0, 4.3, -3.8}, {0, 3.2, -6.5}, 0.4, 0.15}};
        for (const double side : {1.0, -1.0})
            for (const Vec3& top : {hind, fore}) {
                const Vec3 hip(side * top.x, top.y, top.z);
                const Vec3 knee = hip + Vec3(0, -1.7, 0.15);
                capsules.push_back({hip, knee, 0.6, 0.42});
                capsules.push_back({knee, hip - Vec3(0, 3.1, 0), 0.42, 0.3});
            }
    }
};

TEST(Quadruped, StandsOnFourLegs) {
    const Beast beast;
    const OpaqueVoxels voxels = test::voxelsOf(beast.capsules, kStep);
    const Rig rig = fittedRig(voxels, RigTemplate::Quadruped);
    EXPECT_LT(glm::length(jointOf(rig, "LeftUpLeg") - beast.hind), 0.7);
    EXPECT_LT(glm::length(jointOf(rig, "RightUpLeg") - beast.hind * Vec3(-1, 1, 1)), 0.7);
    EXPECT_LT(glm::length(jointOf(rig, "LeftArm") - beast.fore), 0.7);
    EXPECT_NEAR(jointOf(rig, "LeftFoot_End").y, 0, 0.3);
    EXPECT_NEAR(jointOf(rig, "LeftLeg").y, 1.8, 0.5);
    EXPECT_NEAR(jointOf(rig, "Hips").y, 4, 0.6);
    EXPECT_LT(glm::length(jointOf(rig, "Head_End") - Vec3(0, 6.2, 6.6)), 0.8);
    EXPECT_LT(glm::length(jointOf(rig, "Tail_End") - Vec3(0, 3.2, -6.5)), 0.8);
    expectSound(rig, voxels);
}

TEST(Quadruped, RefusesABodyWithoutFourLegs) {
    const OpaqueVoxels voxels = test::voxelsOf(test::Person().capsules, 0.2);
    EXPECT_THROW(fittedRig(voxels, RigTemplate::Quadruped), Error);
}

TEST(Chain, FollowsABentTube) {
    std::vector<test::TaperedCapsule> tube;
    const auto at = [](double i) { return 5.0 * Vec3(std::cos(i * kPi / 32), std::sin(i * kPi / 32), 0); };
    for (int i = 0; i < 24; ++i) tube.push_back({at(i), at(i + 1), 0.7, 0.7});
    const OpaqueVoxels voxels = test::voxelsOf(tube, 0.1);
    for (const int bones : {1, 3, 8, 20}) {
        RigOptions options;
        options.chain = bones;
        const Rig rig = fittedRig(voxels, RigTemplate::Chain, options);
        ASSERT_EQ(rig.limbs.size(), std::size_t(bones));
        for (const Joint& joint : rig.skeleton.joints) {
            const double r = glm::length(Vec3(joint.at.x, joint.at.y, 0));
            EXPECT_NEAR(r, 5, 0.35) << bones;
            EXPECT_NEAR(joint.at.z, 0, 0.2);
        }
        // The ends reach the surface.
        const double reach = glm::length(rig.skeleton.joints.back().at - rig.skeleton.joints.front().at);
        EXPECT_GT(reach, glm::length(at(24) - at(0)) + 0.6);
        EXPECT_GE(coverageOf(voxels, rig.limbs, restOf(rig), {}).covered(), 0.9999) << bones;
    }
}

TEST(Chain, LiesInABall) {
    const OpaqueVoxels ball = test::voxelsOf({{Vec3(3), Vec3(3), 1, 1}}, 0.1);
    const Rig rig = fittedRig(ball, RigTemplate::Chain);
    EXPECT_EQ(rig.limbs.size(), 8u);
    EXPECT_GE(coverageOf(ball, rig.limbs, restOf(rig), {}).covered(), 0.9999);
}

TEST(SuitedTemplate, IsTheOneOfTheShape) {
    EXPECT_EQ(suitedTemplate(test::voxelsOf(test::Person(0.6).capsules, 0.2)), RigTemplate::Biped);
    EXPECT_EQ(suitedTemplate(test::voxelsOf(test::Person(1.5).capsules, 0.2)), RigTemplate::Biped);
    EXPECT_EQ(suitedTemplate(test::voxelsOf(Beast().capsules, 0.2)), RigTemplate::Quadruped);
    EXPECT_EQ(suitedTemplate(test::voxelsOf({{Vec3(0), Vec3(0, 10, 0), 1.5, 1}}, 0.2)), RigTemplate::Chain);
    EXPECT_EQ(suitedTemplate(test::randomVoxels({20, 30, 10}, Vec3(1), 0.6, 4)), RigTemplate::Chain);
}

TEST(Rig, NeedsSomethingOpaque) {
    const OpaqueVoxels nothing{{3, 3, 3}, Vec3(0), Vec3(1), std::vector<std::uint8_t>(27, 0)};
    for (const auto rig : {RigTemplate::Biped, RigTemplate::Quadruped, RigTemplate::Chain})
        EXPECT_THROW(fittedRig(nothing, rig), Error);
    EXPECT_THROW(suitedTemplate(nothing), Error);
}

TEST(Rig, SpecksGiveFiniteRigsOrErrors) {
    for (const Index3& size : {Index3(1, 1, 1), Index3(2, 1, 1), Index3(3, 3, 3), Index3(1, 9, 1), Index3(7, 7, 1)}) {
        OpaqueVoxels voxels{size, Vec3(0), Vec3(1), {}};
        voxels.opaque.assign(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 1);
        for (const auto like : {RigTemplate::Biped, RigTemplate::Chain}) {
            try {
                const Rig rig = fittedRig(voxels, like);
                for (const Joint& joint : rig.skeleton.joints) EXPECT_TRUE(isDefined(joint.at));
            } catch (const Error& error) {
                EXPECT_STRNE(error.what(), "");
            }
        }
    }
}

TEST(Rig, WordsOfTemplates) {
    for (const auto rig : {RigTemplate::Biped, RigTemplate::Quadruped, RigTemplate::Chain})
        EXPECT_EQ(rigTemplateOf(nameOf(rig)), rig);
    EXPECT_THROW(rigTemplateOf("centaur"), Error);
}

}  // namespace
}  // namespace voledit
