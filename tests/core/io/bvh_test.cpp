#include "core/io/bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include "core/base/error.h"
#include "tests/core/io/bvh_files.h"
#include "tests/core/io/files.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::replaced;
using test::smallBvh;
using enum MotionChannel;

constexpr const char* kSharedFiles[] = {"av_8walk",          "cmu_jumping_jacks",     "fair_dab",
                                        "mocapbank_crlf",    "makehuman_zombie_walk", "makehuman_tpose_allpos",
                                        "rokoko_jesse_dance"};

Motion parsed(const std::string& text) {
    std::vector<std::string> warnings;
    Motion motion = parseBvh(text, "file.bvh", &warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    return motion;
}

std::string everywhere(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

TEST(Bvh, ReadsHierarchyChannelsAndFrames) {
    const Motion m = parsed(smallBvh());
    ASSERT_EQ(m.joints.size(), 4u);
    EXPECT_EQ(m.joints[0], (MotionJoint{"Hips",
                                        Joint::kNoParent,
                                        Vec3(1, 2, 3),
                                        {Xposition, Yposition, Zposition, Zrotation, Xrotation, Yrotation},
                                        false}));
    EXPECT_EQ(m.joints[1], (MotionJoint{"Spine.01", 0, Vec3(0, 10, 0), {Yrotation, Xrotation, Zrotation}, false}));
    EXPECT_EQ(m.joints[2], (MotionJoint{"Head", 1, Vec3(0, 5, 0), {Xrotation}, false}));
    EXPECT_EQ(m.joints[3], (MotionJoint{"Head_End", 2, Vec3(0, 2, 0), {}, true}));
    EXPECT_EQ(m.frameTime, 0.025);
    EXPECT_EQ(m.frames, 2u);
    EXPECT_EQ(m.channelCount(), 10u);
    EXPECT_EQ(m.values, (std::vector<double>{4, 5, 6, 0, 0, 0, 0, 0, 0, 0, 1.5, -2, 30, 10, 20, 30, -40, 50, 60, 70}));
}

TEST(Bvh, WhiteSpaceCaseAndLineEndsDoNotMatter) {
    const Motion plain = parsed(smallBvh());
    EXPECT_EQ(parsed(everywhere(smallBvh(), "\n", "\r\n")), plain);
    EXPECT_EQ(parsed(everywhere(smallBvh(), "\n", "\r")), plain);
    EXPECT_EQ(parsed(everywhere(smallBvh(), " ", "\t")), plain);
    EXPECT_EQ(parsed(everywhere(smallBvh(), "\n", " \t\n\n")), plain);
    EXPECT_EQ(parsed(everywhere(smallBvh(), "\n{", "{")), plain);
    EXPECT_EQ(parsed("\xef\xbb\xbf\n" + smallBvh()), plain);
    EXPECT_EQ(parsed(smallBvh().substr(0, smallBvh().size() - 1)), plain);  // no newline at the end
    EXPECT_EQ(parsed(everywhere(everywhere(smallBvh(), "rotation", "ROTATION"), "JOINT", "joint")), plain);
    EXPECT_EQ(parsed(replaced(smallBvh(), "Frames: 2", "Frames :\t2")), plain);
}

TEST(Bvh, NumbersInAnyForm) {
    const Motion m =
        parsed(replaced(smallBvh(), "4 5 6 0 0 0 0 0 0 0", "+.5 -.5e1 5. 1E-3 -0 0.1 1e-310 2 3 12345678.875"));
    const double values[] = {0.5, -5, 5, 0.001, -0.0, 0.1, 1e-310, 2, 3, 12345678.875};
    EXPECT_EQ(std::memcmp(m.values.data(), values, sizeof values), 0);
}

TEST(Bvh, NamesKeepDotsAndInnerBlanks) {
    EXPECT_EQ(parsed(replaced(smallBvh(), "Spine.01", "  Lower spine.01 \t")).joints[1].name, "Lower spine.01");
    EXPECT_EQ(parsed(replaced(smallBvh(), "Spine.01",
                              "H\xc3\xbc"
                              "fte"))
                  .joints[1]
                  .name,
              "H\xc3\xbc"
              "fte");
}

TEST(Bvh, AFrameMayBeBrokenOverLines) {
    EXPECT_EQ(parsed(replaced(smallBvh(), "4 5 6 0 0", "4 5 6\n0\n0")), parsed(smallBvh()));
}

TEST(Bvh, SeveralRoots) {
    const Motion m = parsed(
        "HIERARCHY ROOT a\n{ OFFSET 1 0 0 CHANNELS 1 Xposition }\nROOT b\n{ OFFSET 2 0 0 CHANNELS 1 Yposition }\n"
        "MOTION Frames: 1 Frame Time: 1\n7 8");
    ASSERT_EQ(m.joints.size(), 2u);
    EXPECT_EQ(m.joints[1].parent, Joint::kNoParent);
    const Pose pose = poseOfFrame(m, 0);
    EXPECT_EQ(pose.translate[0], Vec3(6, 0, 0));
    EXPECT_EQ(pose.translate[1], Vec3(0, 8, 0));
}

TEST(Bvh, EndSitesHaveNamesOfTheirOwn) {
    const std::string site = "End Site\n{ OFFSET 0 1 0 }\n";
    const Motion m =
        parsed("HIERARCHY\nROOT a\n{ OFFSET 0 0 0\n" + site + site + "JOINT a_End\n{ OFFSET 1 0 0 CHANNELS 0\n" + site +
               "}}\nMOTION\nFrames: 0\nFrame Time: 1\n");
    ASSERT_EQ(m.joints.size(), 5u);
    EXPECT_EQ(m.joints[1].name, "a_End_2");
    EXPECT_EQ(m.joints[2].name, "a_End_3");
    EXPECT_EQ(m.joints[3].name, "a_End");
    EXPECT_EQ(m.joints[4].name, "a_End_End");
    EXPECT_EQ(parsed(bvhText(m)), m);
}

void expectRepaired(const std::string& text, const Motion& expected, const std::string& said) {
    std::vector<std::string> warnings;
    EXPECT_EQ(parseBvh(text, "file.bvh", &warnings), expected);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(warnings[0].starts_with("file.bvh")) << warnings[0];
    EXPECT_NE(warnings[0].find(said), std::string::npos) << warnings[0];
    EXPECT_EQ(parseBvh(text, "file.bvh"), expected);
}

TEST(Bvh, FewerFramesThanClaimedAreAWarning) {
    expectRepaired(replaced(smallBvh(), "Frames: 2", "Frames: 500000"), parsed(smallBvh()), "500000");
}

TEST(Bvh, WhatStandsBehindTheLastFrameIsLeftOut) {
    expectRepaired(smallBvh() + "1 2 3 4 5 6 7 8 9 10\n", parsed(smallBvh()), "left out");
    expectRepaired(smallBvh() + "rubbish\n", parsed(smallBvh()), "left out");
}

TEST(Bvh, NamesGivenTwiceAreNumbered) {
    Motion expected = parsed(smallBvh());
    expected.joints[1].name = "Hips_2";
    expectRepaired(replaced(smallBvh(), "Spine.01", "Hips"), expected, "Hips_2");
}

TEST(Bvh, NamesInLatin1BecomeUtf8) {
    Motion expected = parsed(smallBvh());
    expected.joints[1].name =
        "H\xc3\xbc"
        "fte";
    expectRepaired(replaced(smallBvh(), "Spine.01",
                            "H\xfc"
                            "fte"),
                   expected, "Latin-1");
}

TEST(Bvh, AStillPoseNeedsNoFrameTime) {
    const std::string still =
        replaced(replaced(smallBvh(), "Frames: 2", "Frames: 1"), "1.5 -2 3e1 10 20 30 -40 50 60 70\n", "");
    Motion expected = parsed(still);
    expected.frameTime = 1.0 / 30;
    expectRepaired(replaced(still, "0.025", "0.000"), expected, "frame time");
}

TEST(Bvh, WritingAndReadingGivesTheSameBits) {
    Motion m = parsed(smallBvh());
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-300, 11);
    m.frames = 50;
    m.values.resize(500);
    for (double& v : m.values) v = mantissa(random) * std::pow(10.0, exponent(random));
    m.values[7] = -0.0;
    m.values[8] = 5e-324;
    for (MotionJoint& joint : m.joints) joint.offset = Vec3(mantissa(random), mantissa(random), mantissa(random));
    m.frameTime = 1.0 / 30;
    const Motion again = parsed(bvhText(m));
    EXPECT_EQ(again, m);
    EXPECT_EQ(std::memcmp(again.values.data(), m.values.data(), 500 * sizeof(double)), 0);
}

TEST(Bvh, JointsInAnyOrderAreWrittenDepthFirst) {
    Motion m;
    m.joints = {{"a", Joint::kNoParent, Vec3(0), {Xrotation}, false},
                {"b", 0, Vec3(1, 0, 0), {Yrotation}, false},
                {"c", 0, Vec3(2, 0, 0), {Zrotation}, false},
                {"d", 1, Vec3(3, 0, 0), {Xrotation}, false}};
    m.frames = 1;
    m.values = {1, 2, 3, 4};
    const Motion again = parsed(bvhText(m));
    EXPECT_EQ(again.joints[2].name, "d");
    EXPECT_EQ(again.joints[2].parent, 1);
    EXPECT_EQ(again.values, (std::vector<double>{1, 2, 4, 3}));
}

TEST(Bvh, NamesThatAFileCannotHoldAreWrittenOtherwise) {
    Motion m = parsed(smallBvh());
    m.joints[1].name = "a{b}\n";
    EXPECT_EQ(parsed(bvhText(m)).joints[1].name, "a_b__");
}

TEST(Bvh, FilesAppearWhole) {
    const fs::path path = test::scratchFolder() / "out.bvh";
    const Motion m = parsed(smallBvh());
    writeBvh(m, path);
    EXPECT_EQ(readBvh(path), m);
    EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
    EXPECT_THROW(writeBvh(m, path.parent_path() / "missing" / "out.bvh"), Error);
}

TEST(Bvh, EverySharedFileIsWrittenAndReadTheSame) {
    for (const char* name : kSharedFiles) {
        VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + name + ".bvh");
        const Motion m = readBvh(path);
        EXPECT_GT(m.frames, 0u) << name;
        EXPECT_EQ(parsed(bvhText(m)), m) << name;
    }
}

}  // namespace
}  // namespace voledit
