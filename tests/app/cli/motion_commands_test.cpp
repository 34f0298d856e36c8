// `voledit pose`, `info` and `convert` on motions.

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/core/io/bvh_files.h"
#include "tests/core/io/model_files.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::run;

std::string write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

class SharedPoses : public testing::TestWithParam<const char*> {};

TEST_P(SharedPoses, AgreeWithAnotherReader) {
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/mocap/") + GetParam() + ".bvh");
    VOLEDIT_SHARED_OR_SKIP(referencePath, std::string("data/mocap/") + GetParam() + ".ref.json");
    const json reference = json::parse(std::ifstream(referencePath));
    const char* const replacing = "frames_root_position_replaces_offset";
    const json& frames = reference[reference.contains(replacing) ? replacing : "frames"];
    for (const auto& [frame, places] : frames.items()) {
        const auto result = run("voledit", {"pose", path.string(), "--frame", frame, "--json"});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(result.err.empty()) << result.err;
        const json joints = json::parse(result.out)["joints"];
        ASSERT_EQ(joints.size(), places.size());
        double low = 1e30, high = -1e30, largest = 0;
        for (const json& place : places)
            for (std::size_t a = 0; a < 3; ++a) {
                const double found = joints[place[0].get<std::string>()][a], wanted = place[a + 1];
                largest = std::max(largest, std::abs(found - wanted));
                if (a > 0) low = std::min(low, wanted), high = std::max(high, wanted);
            }
        EXPECT_LE(largest, 1e-6 * (high - low)) << "frame " << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(, SharedPoses,
                         testing::Values("av_8walk", "cmu_jumping_jacks", "fair_dab", "mocapbank_crlf",
                                         "makehuman_zombie_walk", "makehuman_tpose_allpos", "rokoko_jesse_dance"),
                         [](const auto& test) { return std::string(test.param); });

TEST(PoseCommand, JointsByNameAndTheirTable) {
    const std::string path = write(test::scratchFolder() / "small.bvh", test::smallBvh());
    const auto asJson = run("voledit", {"pose", path, "--json"});
    ASSERT_EQ(asJson.status, 0) << asJson.err;
    EXPECT_EQ(json::parse(asJson.out), json::parse(R"({"joints": {"Hips": [4, 5, 6], "Spine.01": [4, 15, 6],
                                                       "Head": [4, 20, 6], "Head_End": [4, 22, 6]}})"));
    const auto table = run("voledit", {"pose", path, "--frame", "0"});
    ASSERT_EQ(table.status, 0);
    std::istringstream lines(table.out);
    std::string name;
    double x = 0, y = 0, z = 0;
    for (int row = 0; row < 4; ++row) ASSERT_TRUE(lines >> name >> x >> y >> z) << table.out;
    EXPECT_EQ(name, "Head_End");
    EXPECT_EQ(y, 22);
}

TEST(PoseCommand, FramesThatAreNotThere) {
    const std::string path = write(test::scratchFolder() / "small.bvh", test::smallBvh());
    const auto past = run("voledit", {"pose", path, "--frame", "2"});
    EXPECT_EQ(past.status, 1);
    EXPECT_NE(past.err.find("0 to 1"), std::string::npos) << past.err;
    EXPECT_EQ(run("voledit", {"pose", path, "--frame", "99999999999999"}).status, 1);
    EXPECT_EQ(run("voledit", {"pose", path, "--frame=-1"}).status, 2);
    EXPECT_EQ(run("voledit", {"pose", path, "--frame", "x"}).status, 2);
    EXPECT_EQ(run("voledit", {"pose"}).status, 2);
    EXPECT_EQ(run("voledit", {"pose", path + ".missing"}).status, 1);
}

TEST(PoseCommand, WhatIsRepairedIsSaid) {
    const std::string path =
        write(test::scratchFolder() / "few.bvh", test::replaced(test::smallBvh(), "Frames: 2", "Frames: 7"));
    const auto result = run("voledit", {"pose", path, "--frame", "1", "--json"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find("claims 7 frames and holds 2"), std::string::npos) << result.err;
    EXPECT_NO_THROW(json::parse(result.out));
}

TEST(PoseCommand, HostileFilesAreErrors) {
    const fs::path folder = test::scratchFolder();
    for (const std::string& text :
         {std::string(), std::string("\x89PNG"), test::replaced(test::smallBvh(), "-40 50", "nan 50"),
          test::replaced(test::smallBvh(), "Frames: 2", "Frames: 1000000000")}) {
        const auto result = run("voledit", {"pose", write(folder / "bad.bvh", text), "--json"});
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("bad.bvh"), std::string::npos) << result.err;
        EXPECT_TRUE(result.out.empty());
    }
}

TEST(InfoCommand, OfAMotion) {
    const std::string path = write(test::scratchFolder() / "small.bvh", test::smallBvh());
    const auto result = run("voledit", {"info", path, "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["kind"], "motion");
    EXPECT_EQ(info["format"], "bvh");
    EXPECT_EQ(info["joints"], 3);
    EXPECT_EQ(info["endSites"], 1);
    EXPECT_EQ(info["channels"], 10);
    EXPECT_EQ(info["frames"], 2);
    EXPECT_EQ(info["frameTime"], 0.025);
    EXPECT_EQ(info["fps"], 40.0);
    EXPECT_EQ(info["height"], 17.0);
    EXPECT_EQ(info["up"], "y");
    ASSERT_EQ(info["hierarchy"].size(), 4u);
    EXPECT_TRUE(info["hierarchy"][0]["parent"].is_null());
    EXPECT_EQ(info["hierarchy"][1]["name"], "Spine.01");
    EXPECT_EQ(info["hierarchy"][1]["parent"], "Hips");
    EXPECT_EQ(info["hierarchy"][1]["channels"], json::parse(R"(["Yrotation", "Xrotation", "Zrotation"])"));
    EXPECT_EQ(info["hierarchy"][3]["endSite"], true);
    const auto table = run("voledit", {"info", path});
    EXPECT_NE(table.out.find("    Spine.01"), std::string::npos) << table.out;
}

TEST(ConvertCommand, AnyMotionToBvh) {
    const fs::path folder = test::scratchFolder();
    const std::string bvh = write(folder / "small.bvh", test::smallBvh()),
                      gltf = write(folder / "arm.gltf", test::embeddedGltf());
    for (const std::string& from : {bvh, gltf}) {
        const std::string to = (folder / "out.bvh").string(), again = (folder / "again.bvh").string();
        ASSERT_EQ(run("voledit", {"convert", from, to}).status, 0);
        EXPECT_EQ(run("voledit", {"pose", to, "--frame", "1", "--json"}).out,
                  run("voledit", {"pose", from, "--frame", "1", "--json"}).out);
        ASSERT_EQ(run("voledit", {"convert", to, again}).status, 0);
        std::ostringstream first, second;
        first << std::ifstream(to).rdbuf();
        second << std::ifstream(again).rdbuf();
        EXPECT_EQ(first.str(), second.str());
    }
    const auto result = run("voledit", {"convert", bvh, (folder / "out.nrrd").string()});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find(".bvh"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "out.nrrd"));
}

TEST(MotionFiles, AreNoVolumesAndNoScenes) {
    const std::string path = write(test::scratchFolder() / "small.bvh", test::smallBvh());
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"sample", path, "--at", "0,0,0"}, {"render", path, "-o", path + ".png"}}) {
        const auto result = run("voledit", arguments);
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("holds a motion"), std::string::npos) << result.err;
    }
}

}  // namespace
}  // namespace voledit
