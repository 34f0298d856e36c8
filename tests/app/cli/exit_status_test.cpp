// What goes wrong on the command line ends with the status and the message that the contract promises, soon, in little
// memory, and with nothing written.

#include <fstream>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::run;
using testing::Test;

constexpr std::size_t kTwoGigabytes = std::size_t(2) << 30;

std::string write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

TEST(ExitStatus, WrongFlagsAreTwo) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"render"},
             {"render", "a.voledit", "-o", "a.png", "--nonsense"},
             {"render", "a.voledit", "-o", "a.png", "--size", "0x10"},
             {"render", "a.voledit", "-o", "a.png", "--renderer", "magic"},
             {"render", "a.voledit", "-o", "a.jpeg"},
             {"voxelize", "a.voledit", "-o", "a.nrrd"},
             {"voxelize", "a.voledit", "-o", "a.nrrd", "--size", "4x4x4", "--what", "soul"},
             {"render", "a.voledit", "-o", "a.png", "--step", "0"},
             {"sample", "a.nrrd", "--at", "1,2"},
             {"sample", "a.nrrd", "--at", "1,2,x"},
             {"info", "a.nrrd", "--memory-limit", "lots"},
             {"edit", "--scale", "99"}}) {
        const auto result = run("voledit", arguments);
        EXPECT_EQ(result.status, 2) << testing::PrintToString(arguments) << result.err;
        EXPECT_FALSE(result.err.empty());
        EXPECT_TRUE(result.out.empty());
    }
}

TEST(ExitStatus, HelpAndVersionAreZero) {
    for (const char* flag : {"--help", "--version"}) EXPECT_EQ(run("voledit", {flag}).status, 0) << flag;
    EXPECT_EQ(run("voledit", {"render", "--help"}).status, 0);
}

TEST(ExitStatus, MissingFilesAreOneAndNamed) {
    for (const char* name : {"gone.nrrd", "gone.voledit", "gone.mhd", "gone_folder/", "gone.xyz"})
        for (const char* command : {"info", "sample"}) {
            std::vector<std::string> arguments{command, name};
            if (std::string(command) == "sample") arguments.insert(arguments.end(), {"--at", "0,0,0"});
            const auto result = run("voledit", arguments);
            EXPECT_EQ(result.status, 1) << command << name;
            EXPECT_NE(result.err.find("gone"), std::string::npos) << result.err;
        }
}

TEST(ExitStatus, RawFileWithoutRawIsOne) {
    const auto folder = test::scratchFolder();
    const auto result = run("voledit", {"info", write(folder / "voxels.raw", std::string(4096, 'x'))});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("--raw"), std::string::npos) << result.err;
}

TEST(ExitStatus, AWordThatIsNeitherCommandNorFileIsNamed) {
    const auto result = run("voledit", {"rendre"});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("rendre: there is no such file"), std::string::npos) << result.err;
}

/// A volume of 2 × 2 × 2 ones in `folder`.
std::string smallVolume(const fs::path& folder) {
    return write(folder / "v.nrrd",
                 "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" + std::string(8, '\x01'));
}

TEST(CommonFlags, StandBeforeAndBehindTheCommand) {
    const std::string volume = smallVolume(test::scratchFolder());
    const std::vector<std::string> plain{"info", volume, "--json"};
    const auto expected = run("voledit", plain);
    ASSERT_EQ(expected.status, 0) << expected.err;
    for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{
             {"--quiet"}, {"--threads", "1"}, {"--memory-limit=1G", "--quiet"}, {"--memory-limit", "1G"}}) {
        std::vector<std::string> before = flags, behind = plain;
        before.insert(before.end(), plain.begin(), plain.end());
        behind.insert(behind.end(), flags.begin(), flags.end());
        for (const auto& arguments : {before, behind}) {
            const auto result = run("voledit", arguments);
            EXPECT_EQ(result.status, 0) << testing::PrintToString(arguments) << result.err;
            EXPECT_EQ(result.out, expected.out);
            EXPECT_EQ(result.err, "");
        }
    }
    const auto verbose = run("voledit", {"--verbose", "info", volume, "--json"});
    EXPECT_EQ(verbose.out, expected.out);
    EXPECT_NE(verbose.err.find(" ms"), std::string::npos) << verbose.err;
}

TEST(CommonFlags, MemoryLimitHoldsForEveryCommand) {
    const auto folder = test::scratchFolder();
    // More than what a parser needs for itself, less than the volume.
    const std::string volume =
        write(folder / "big.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 256 256 256\nencoding: raw\n\n" +
                                       std::string(std::size_t(1) << 24, '\x01'));
    const std::string picture = (folder / "out.png").string(), grid = (folder / "out.nrrd").string();
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"info", volume},
             {"sample", volume, "--at", "0,0,0"},
             {"convert", volume, grid},
             {"voxelize", volume, "-o", grid, "--size", "2x2x2"},
             {"voxelize", smallVolume(folder), "-o", grid, "--like", volume},
             {"voxelize", smallVolume(folder), "-o", grid, "--size", "900x900x900"}}) {
        std::vector<std::string> limited = arguments;
        limited.insert(limited.end(), {"--memory-limit", "8M"});
        const auto result = run("voledit", limited);
        EXPECT_EQ(result.status, 1) << testing::PrintToString(arguments);
        EXPECT_NE(result.err.find("--memory-limit"), std::string::npos) << result.err;
        EXPECT_FALSE(fs::exists(picture) || fs::exists(grid)) << testing::PrintToString(arguments);
    }
}

TEST(CommonFlags, BeyondTheMemoryLimitVolumesAreShownReduced) {
    const auto folder = test::scratchFolder();
    const std::string volume =
        write(folder / "big.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 256 256 256\nencoding: raw\n\n" +
                                       std::string(std::size_t(1) << 24, '\x01'));
    const std::string picture = (folder / "out.png").string(), state = (folder / "state.json").string();
    const auto rendered = run(
        "voledit", {"render", volume, "-o", picture, "--renderer", "rays", "--size", "40x30", "--memory-limit", "8M"});
    EXPECT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_NE(rendered.err.find("reduced resolution, 128x128x128"), std::string::npos) << rendered.err;
    EXPECT_TRUE(fs::exists(picture));
    const std::string events = write(folder / "events", "wait idle\nstate " + state + "\n");
    const auto edited = run("voledit", {"edit", volume, "--headless", "--play", events, "--memory-limit", "8M"});
    EXPECT_EQ(edited.status, 0) << edited.err;
    std::ifstream file(state);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(text.find("reduced resolution, 128x128x128"), std::string::npos) << text;
}

TEST(RawFiles, TakeTheirSpacingFromEitherFlag) {
    const auto folder = test::scratchFolder();
    const std::string raw = write(folder / "voxels.raw", std::string(8, 'x'));
    const auto one = run("voledit", {"info", raw, "--json", "--raw", "2x2x2,uint8,1x2x3"});
    const auto other = run("voledit", {"info", raw, "--json", "--raw", "2x2x2,uint8", "--spacing", "1,2,3"});
    EXPECT_EQ(one.status, 0) << one.err;
    EXPECT_EQ(one.out, other.out);
}

TEST(ExitStatus, BadScenesWriteNothing) {
    const auto folder = test::scratchFolder();
    const std::string volume = R"("assets":{"v":{"kind":"volume","path":"v.nrrd"}},)";
    const std::string root = R"("root":{"type":"volume","asset":"v"})";
    write(folder / "v.nrrd",
          "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" + std::string(8, '\x01'));
    const std::vector<std::pair<std::string, std::string>> bad{
        {"", "empty"},
        {"{", ""},
        {R"({"voledit":2,)" + volume + root + "}", "voledit"},
        {R"({"voledit":1,)" + volume + R"("surprise":1,)" + root + "}", "surprise"},
        {R"({"voledit":1,"assets":{"v":{"kind":"volume","path":"gone.nrrd"}},)" + root + "}", "gone.nrrd"},
        {R"({"voledit":1,"assets":{"v":{"kind":"volume","path":"../v.nrrd"}},)" + root + "}", "--allow-outside"},
        {R"({"voledit":1,)" + volume + R"("root":{"type":"volume","asset":"w"}})", "w"},
        {R"({"voledit":1,)" + volume + R"("objects":{"a":{"use":"b"},"b":{"use":"a"}},"root":{"use":"a"}})", "cycle"},
        {R"({"voledit":1,)" + volume + R"("opacityDistance":1e999,)" + root + "}", ""},
        {R"({"voledit":1,)" + volume +
             R"("root":{"type":"transfer","by":{"type":"ffd","cells":[1000,1000,1000]},"of":{"type":"volume","asset":"v"}}})",
         "cells"},
        {R"({"voledit":1,)" + volume +
             R"("root":{"type":"transfer","by":{"type":"ffd","move":[{"point":[9,0,0],"by":[1,0,0]}]},"of":{"type":"volume","asset":"v"}}})",
         "point"},
        {R"({"voledit":1,)" + volume + R"("root":{"type":"volume","asset":"v","channel":1}})", "channel 1"}};
    for (const auto& [text, word] : bad) {
        const std::string path = write(folder / "scene.voledit", text);
        const auto result = run("voledit", {"render", path, "-o", (folder / "out.png").string(), "--renderer", "rays"});
        EXPECT_EQ(result.status, 1) << text;
        EXPECT_NE(result.err.find("scene.voledit"), std::string::npos) << text << "\n" << result.err;
        EXPECT_NE(result.err.find(word), std::string::npos) << text << "\n" << result.err;
        EXPECT_LT(result.seconds, 10) << text;
        EXPECT_LT(result.peakBytes, kTwoGigabytes) << text;
        EXPECT_FALSE(fs::exists(folder / "out.png")) << text;
    }
}

TEST(ExitStatus, UnwritableOutputIsFoundBeforeTheWork) {
    const auto folder = test::scratchFolder();
    const auto unknown = run("voledit", {"voxelize", "gone.voledit", "-o", "a.xyz", "--size", "2x2x2"});
    EXPECT_EQ(unknown.status, 1);
    EXPECT_NE(unknown.err.find("a.xyz: its ending"), std::string::npos) << unknown.err;
    const auto result = run("voledit", {"convert", "gone.nrrd", (folder / "no" / "such" / "folder.nrrd").string()});
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("folder"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace voledit
