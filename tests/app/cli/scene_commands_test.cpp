// render, voxelize, sample and convert on scenes, as a script calls them.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::run;

/// A folder with a 24³ ramp-and-ball volume and a scene that bends it by a lattice.
struct BentBall {
    fs::path folder = test::scratchFolder();
    IoClient io;

    BentBall() {
        constexpr int n = 24;
        std::vector<std::int16_t> values;
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const double r = std::hypot(i - 11.5, j - 11.5, k - 11.5);
                    values.push_back(static_cast<std::int16_t>(std::lround(1000 - 80 * r)));
                }
        VolumeGrid grid;
        grid.size = {n, n, n};
        io.writeVolume(*Volume::fromValues(grid, values), folder / "ball.nrrd");
    }

    std::string scene(const std::string& by) {
        std::ofstream(folder / "scene.voledit") << R"({"voledit":1,
            "assets":{"ball":{"kind":"volume","path":"ball.nrrd"}},
            "objects":{"ball":{"type":"volume","asset":"ball","appearance":{
                "color":[[0,0.9,0.3,0.2],[1000,1,0.9,0.7]],"opacity":[[300,0],[600,0.6]]}}},
            "root":{"type":"transfer","by":)" << by
                                                << R"(,"of":{"use":"ball"}}})";
        return (folder / "scene.voledit").string();
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
};

const char* const kBend = R"([{"type":"ffd","name":"bend","move":[{"point":[3,3,3],"by":[4,0,3]}]}])";

TEST(RenderCommand, BothRenderersDrawThePictureTheOtherDraws) {
    BentBall files;
    const std::string scene = files.scene(kBend);
    for (const std::string renderer : {"slices", "rays"}) {
        const auto result = run("voledit", {"render", scene, "-o", files.at(renderer + ".png"), "--size", "160x120",
                                            "--renderer", renderer, "--step", "0.2", "--stats",
                                            files.at(renderer + ".json"), "--time-frames", "2", "--time-edits", "2"});
        ASSERT_EQ(result.status, 0) << result.err;
        const json stats = json::parse(std::ifstream(files.at(renderer + ".json")));
        EXPECT_EQ(stats["renderer"], renderer);
        EXPECT_EQ(stats["frame_ms"].size(), 2u);
        EXPECT_EQ(stats["edit_ms"].size(), 2u);
        EXPECT_GT(stats["first_image_ms"].get<double>(), 0);
        EXPECT_GT(stats["peak_mib"].get<double>(), 1);
    }
    const Picture slices = files.io.readPicture(files.at("slices.png")),
                  rays = files.io.readPicture(files.at("rays.png"));
    ASSERT_EQ(slices.size, Index2(160, 120));
    EXPECT_GT(psnr(slices, rays), 40);
    double brightest = 0;
    for (const Vec4f& p : rays.pixels) brightest = std::max(brightest, double(p.r));
    EXPECT_GT(brightest, 0.4) << "the picture is empty or dark";
}

TEST(RenderCommand, CameraFileIsUsed) {
    BentBall files;
    std::ofstream(files.at("away.json")) << R"({"eye":[0,-100,0],"target":[0,-200,0],"up":[0,0,1],"fovY":30})";
    const auto result = run("voledit", {"render", files.scene(kBend), "-o", files.at("away.png"), "--size", "32x32",
                                        "--renderer", "rays", "--camera", files.at("away.json")});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const Vec4f& p : files.io.readPicture(files.at("away.png")).pixels) EXPECT_EQ(p.r, 0);
}

TEST(RenderCommand, SupersampledPixelsAreMeansOfFourTimesAsMany) {
    BentBall files;
    const std::string scene = files.scene(kBend);
    const auto draw = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> words{"render", scene, "-o", files.at(name), "--renderer", "rays"};
        words.insert(words.end(), more.begin(), more.end());
        const auto result = run("voledit", words);
        EXPECT_EQ(result.status, 0) << result.err;
        return files.io.readPicture(files.at(name));
    };
    const Picture fine = draw("fine.png", {"--size", "80x60"}),
                  means = draw("means.png", {"--size", "40x30", "--supersample", "2"});
    ASSERT_EQ(means.size, Index2(40, 30));
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            for (int c = 0; c < 3; ++c) {
                const std::array<float, 4> four{fine.at(2 * x, 2 * y)[c], fine.at(2 * x + 1, 2 * y)[c],
                                                fine.at(2 * x, 2 * y + 1)[c], fine.at(2 * x + 1, 2 * y + 1)[c]};
                // Highlights are cut off at white after the mean is taken: what they were before isn't known here.
                if (*std::max_element(four.begin(), four.end()) == 1) continue;
                const float sum = four[0] + four[1] + four[2] + four[3];
                EXPECT_NEAR(means.at(x, y)[c], sum / 4, 1.001 / 255);  // both are rounded to bytes
            }
    EXPECT_EQ(run("voledit", {"render", scene, "-o", files.at("no.png"), "--supersample", "0"}).status, 2);
    EXPECT_EQ(
        run("voledit", {"render", scene, "-o", files.at("no.png"), "--size", "9000x20", "--supersample", "2"}).status,
        2);
}

TEST(RenderCommand, ATransparentPictureOverItsBackgroundIsTheOpaqueOne) {
    BentBall files;
    const std::string scene = files.scene(kBend);
    json j = json::parse(std::ifstream(scene));
    const auto draw = [&](bool transparent) {
        j["render"] = {{"background", {0.2, 0.4, 0.6}}, {"transparent", transparent}};
        std::ofstream(scene) << j;
        const auto result =
            run("voledit", {"render", scene, "-o", files.at("a.png"), "--size", "80x60", "--renderer", "rays"});
        EXPECT_EQ(result.status, 0) << result.err;
        return files.io.readPicture(files.at("a.png"));
    };
    const Picture opaque = draw(false), cutOut = draw(true);
    const Vec3f background(0.2f, 0.4f, 0.6f);
    EXPECT_EQ(cutOut.at(0, 0), Vec4f(0));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const Vec4f p = cutOut.at(x, y);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(p.a * p[c] + (1 - p.a) * background[c], opaque.at(x, y)[c], 2.0 / 255);
        }
}

TEST(VoxelizeCommand, UnmovedLatticeKeepsEveryVoxelAndTheSourcesType) {
    BentBall files;
    const auto result = run("voledit", {"voxelize", files.scene(R"([{"type":"ffd"}])"), "-o", files.at("same.nrrd"),
                                        "--what", "scalar", "--like", files.at("ball.nrrd"), "--fill", "-7"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto before = files.io.readVolume(files.at("ball.nrrd")).volume;
    const auto after = files.io.readVolume(files.at("same.nrrd")).volume;
    EXPECT_EQ(after->type(), VoxelType::Int16);
    EXPECT_EQ(after->grid(), before->grid());
    EXPECT_TRUE(std::equal(before->voxels().begin(), before->voxels().end(), after->voxels().begin()));
}

TEST(VoxelizeCommand, DisplacementOfAMoveIsThatMoveBack) {
    BentBall files;
    const auto result =
        run("voledit", {"voxelize",
                        files.scene(R"([{"type":"affine","translate":[1,2,3]},{"type":"affine","translate":[4,0,0]}])"),
                        "-o", files.at("d.nrrd"), "--what", "displacement", "--size", "3x4x5"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto volume = files.io.readVolume(files.at("d.nrrd")).volume;
    EXPECT_EQ(volume->grid().size, Index3(3, 4, 5));
    ASSERT_EQ(volume->grid().channels, 3);
    const Vec3 wanted(-5, -2, -3);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(volume->at({1, 2, 3}, c), wanted[c], 1e-5);
}

TEST(SampleCommand, TellsThePathThroughTheSceneOutermostFirst) {
    BentBall files;
    const auto result = run(
        "voledit",
        {"sample",
         files.scene(
             R"([{"type":"affine","name":"first","translate":[1,0,0]},{"type":"affine","name":"last","translate":[0,2,0]}])"),
         "--at", "11,12,13", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json sample = json::parse(result.out)["samples"][0];
    EXPECT_EQ(sample["path"][0], json({{"name", "last"}, {"point", {11, 10, 13}}}));
    EXPECT_EQ(sample["path"][1], json({{"name", "first"}, {"point", {10, 10, 13}}}));
    EXPECT_NEAR(sample["opacity"].get<double>(), 0.6, 1e-9);
    EXPECT_EQ(sample["color"].size(), 3u);
}

const char* const kRising = R"([{"type":"affine","translate":[0,0,{"keys":[[0,1],[2,5]]}]}])";

TEST(SampleCommand, ShowsTheSceneAtATimeOrAtTheTimelinesStart) {
    BentBall files;
    const std::string scene = files.scene(kRising);
    const auto zAt = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"sample", scene, "--at", "11,12,13", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto result = run("voledit", arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out)["samples"][0]["path"][0]["point"][2].get<double>();
    };
    EXPECT_EQ(zAt({}), 12);
    EXPECT_EQ(zAt({"--time", "0.5"}), 11);
    EXPECT_EQ(zAt({"--time", "99"}), 8);
}

TEST(VoxelizeCommand, ShowsTheSceneAtATime) {
    BentBall files;
    const auto result = run("voledit", {"voxelize", files.scene(kRising), "-o", files.at("later.nrrd"), "--what",
                                        "scalar", "--like", files.at("ball.nrrd"), "--time", "2", "--fill", "-7"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto before = files.io.readVolume(files.at("ball.nrrd")).volume;
    const auto after = files.io.readVolume(files.at("later.nrrd")).volume;
    for (int k = 0; k < 24; ++k) EXPECT_EQ(after->at({7, 9, k}), k < 5 ? -7 : before->at({7, 9, k - 5})) << k;
}

TEST(SceneCommands, ReadFormulaFilesBesideTheScene) {
    BentBall files;
    std::ofstream(files.at("lift.stf")) << "title: Lift\ndescription: Up.\nsource: a test\n\n"
                                           "parameter by number suggested 0.1 \"How far\"\n\n"
                                           "[map]\nq = replace(u, 2, u[2] - by)\n";
    const std::string scene = files.scene(R"({"type":{"file":"lift.stf"},"by":0.5,"name":"up"})");
    const auto result = run("voledit", {"sample", scene, "--at", "11,12,13", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json entry = json::parse(result.out)["samples"][0]["path"][0];
    EXPECT_EQ(entry["name"], "up");
    EXPECT_NEAR(entry["point"][2].get<double>(), 13 - 0.5 * 23, 1e-12) << "half of the ball's frame";

    std::ofstream(files.at("lift.stf")) << "title: Lift\ndescription: Up.\nsource: a test\n[map]\nq = u +\n";
    const auto wrong = run("voledit", {"sample", scene, "--at", "11,12,13"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("lift.stf"), std::string::npos) << wrong.err;
    EXPECT_NE(wrong.err.find("^"), std::string::npos) << wrong.err;
}

TEST(SceneCommands, WarnOfWhatIsAllowedButOdd) {
    BentBall files;
    const std::string deflect = R"({"type":"deflect","center":[11,11,11],"radius":4,"translate":[9,0,0]})";
    const auto result = run("voledit", {"sample", files.scene(deflect), "--at", "11,12,13"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find("warning: /root/by/0"), std::string::npos) << result.err;
}

TEST(ConvertCommand, RoundTripsThroughEveryFormatKeepVoxelsAndGrid) {
    BentBall files;
    std::string from = files.at("ball.nrrd");
    for (const std::string name : {"a.nii.gz", "b.mha", "c.nii", "d.mhd", "e.nhdr", "f.nrrd"}) {
        const auto result = run("voledit", {"convert", from, files.at(name)});
        ASSERT_EQ(result.status, 0) << result.err;
        from = files.at(name);
    }
    const auto before = files.io.readVolume(files.at("ball.nrrd")).volume, after = files.io.readVolume(from).volume;
    EXPECT_EQ(after->grid(), before->grid());
    EXPECT_TRUE(std::equal(before->voxels().begin(), before->voxels().end(), after->voxels().begin()));
}

}  // namespace
}  // namespace voledit
