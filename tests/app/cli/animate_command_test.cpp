// voledit animate, as a script calls it: frames, videos, stopping and going on.

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "app/animation/child_process.h"
#include "app/animation/whole_picture.h"
#include "core/base/paths.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::run;
using testing::HasSubstr;
using testing::Not;

constexpr int kFrames = 10;
const Index2 kSize(48, 36);

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A box that is twisted by ten degrees more each frame, ten frames a second, in a folder of its own.
class AnimateCommand : public testing::Test {
protected:
    void SetUp() override {
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        writeScene(100);
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    void writeScene(double angle, int frames = kFrames) const {
        std::ofstream(folder / "twist.voledit")
            << R"({"voledit":1,"root":{"type":"transfer","by":[{"type":"twist","axis":"z",
                "angle":{"keys":[[0,0],[1,)"
            << angle << R"(]]},"frame":{"min":[-1,-1,-1],"max":[1,1,1]}}],
                "of":{"type":"solid","shape":{"box":{"min":[-0.6,-0.6,-0.9],"max":[0.6,0.6,0.9]}},
                "color":[0.9,0.5,0.2],"opacity":1}},"timeline":{"fps":10,"start":0,"end":)"
            << frames << "}}";
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::vector<std::string> words(const std::string& out, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"animate", at("twist.voledit"), "-o",  at(out), "--size",
                                     "48x36",   "--renderer",        "rays"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    test::RunResult animate(const std::string& out, const std::vector<std::string>& more = {}) const {
        return run("voledit", words(out, more), 300);
    }
    fs::path frame(const std::string& prefix, int n) const { return at(prefix + std::to_string(n) + ".png"); }
    /// Starts it, sends `signal` once `frames` files of the folder are there, and waits. Its exit status.
    int stopped(const std::vector<std::string>& arguments, const fs::path& where, int frames, int signal,
                std::string* errors = nullptr) const {
        std::vector<std::string> command{(programFolder() / "voledit").string()};
        command.insert(command.end(), arguments.begin(), arguments.end());
        ChildProcess child({.command = command, .environment = {}, .keepErrors = true});
        while (!child.ended() && pictures(where) < frames) usleep(2000);
        child.signal(signal);
        const int status = child.wait();
        if (errors) *errors = child.errors();
        return status;
    }
    static int pictures(const fs::path& where) {
        int count = 0;
        std::error_code failed;
        for (const auto& entry : fs::directory_iterator(where, failed)) count += entry.path().extension() == ".png";
        return count;
    }
    /// Every picture of the folder is whole, and nothing half-written is beside them.
    static void expectWholeFramesOnly(const fs::path& where) {
        for (const auto& entry : fs::directory_iterator(where)) {
            if (entry.path().extension() == ".png" && entry.path().stem() != "palette") {
                EXPECT_TRUE(isWholePicture(entry.path(), kSize)) << entry.path();
            }
        }
    }

    const fs::path folder = test::scratchFolder();
};

// ---- Frames -------------------------------------------------------------------------------------------------------

TEST_F(AnimateCommand, FramesAreThePicturesThatRenderGives) {
    for (const std::string renderer : {"rays", "slices"}) {
        for (const std::string ending : {".png", ".exr"}) {
            const auto result = run("voledit", {"animate", at("twist.voledit"), "-o", at(renderer + "%03d" + ending),
                                                "--size", "48x36", "--renderer", renderer, "--frames", "2-5"});
            ASSERT_EQ(result.status, 0) << result.err;
            EXPECT_FALSE(fs::exists(at(renderer + "001" + ending)));
            EXPECT_FALSE(fs::exists(at(renderer + "006" + ending)));
            const auto single = run("voledit", {"render", at("twist.voledit"), "-o", at("single" + ending), "--size",
                                                "48x36", "--renderer", renderer, "--time", "0.5"});
            ASSERT_EQ(single.status, 0) << single.err;
            EXPECT_EQ(bytesOf(at(renderer + "005" + ending)), bytesOf(at("single" + ending))) << renderer << ending;
            EXPECT_NE(bytesOf(at(renderer + "004" + ending)), bytesOf(at("single" + ending)));
        }
    }
}

TEST_F(AnimateCommand, WholeTimelineAndNothingElse) {
    const fs::path place = folder / "frames";
    fs::create_directory(place);
    const auto result = animate("frames/f%d.png");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), kFrames);
    for (int n = 0; n < kFrames; ++n) EXPECT_TRUE(isWholePicture(place / ("f" + std::to_string(n) + ".png"), kSize));
}

TEST_F(AnimateCommand, AnyNumberOfWorkersGivesTheSameBytes) {
    ASSERT_EQ(animate("one%d.png", {"--workers", "1"}).status, 0);
    ASSERT_EQ(animate("two%d.png", {"--workers", "2"}).status, 0);
    ASSERT_EQ(animate("many%d.png", {"--workers", "7", "--frames", "3-5"}).status, 0);
    for (int n = 0; n < kFrames; ++n) {
        EXPECT_EQ(bytesOf(frame("one", n)), bytesOf(frame("two", n))) << n;
        if (n >= 3 && n <= 5) {
            EXPECT_EQ(bytesOf(frame("one", n)), bytesOf(frame("many", n))) << n;
        }
    }
    EXPECT_NE(bytesOf(frame("one", 1)), bytesOf(frame("one", 2)));
}

TEST_F(AnimateCommand, AnotherRateShowsTheSameTimes) {
    ASSERT_EQ(animate("slow%d.png", {"--fps", "10"}).status, 0);
    ASSERT_EQ(animate("fast%d.png", {"--fps", "20"}).status, 0);
    for (int n = 0; n < kFrames; ++n) EXPECT_EQ(bytesOf(frame("slow", n)), bytesOf(frame("fast", 2 * n))) << n;
    EXPECT_TRUE(fs::exists(frame("fast", 2 * kFrames - 1)));
    EXPECT_FALSE(fs::exists(frame("fast", 2 * kFrames)));
}

TEST_F(AnimateCommand, SceneThatDoesNotMoveIsDrawnToo) {
    std::ofstream(folder / "twist.voledit") << R"({"voledit":1,"root":{"type":"solid",
        "shape":{"sphere":{"center":[0,0,0],"radius":1}},"color":[1,1,1],"opacity":1}})";
    ASSERT_EQ(animate("still%d.png", {"--frames", "46-47"}).status, 0);
    EXPECT_EQ(bytesOf(frame("still", 46)), bytesOf(frame("still", 47)));
}

// ---- Videos -------------------------------------------------------------------------------------------------------

TEST_F(AnimateCommand, VideosAreTheSameBytesEveryTimeAndLeaveNothingElse) {
    for (const std::string ending : {".mp4", ".webm", ".gif"}) {
        fs::create_directory(folder / ("v" + ending));
        for (const std::string name : {"a", "b"}) {
            const auto result =
                animate("v" + ending + "/" + name + ending, {"--frames", "0-4", "--workers", name == "a" ? "1" : "2"});
            ASSERT_EQ(result.status, 0) << result.err;
        }
        EXPECT_EQ(bytesOf(at("v" + ending + "/a" + ending)), bytesOf(at("v" + ending + "/b" + ending)));
        EXPECT_GT(fs::file_size(at("v" + ending + "/a" + ending)), 300u);
        EXPECT_EQ(std::distance(fs::directory_iterator(folder / ("v" + ending)), {}), 2);
    }
}

TEST_F(AnimateCommand, OddSizesArePaddedByTheirLastColumnAndRow) {
    const auto result = run("voledit", {"animate", at("twist.voledit"), "-o", at("odd.mp4"), "--size", "63x47",
                                        "--renderer", "rays", "--frames", "6-7", "--crf", "0"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto single = run("voledit", {"render", at("twist.voledit"), "-o", at("odd.png"), "--size", "63x47",
                                        "--renderer", "rays", "--time", "0.6"});
    ASSERT_EQ(single.status, 0) << single.err;
    IoClient io;
    const Picture video = io.readPicture(at("odd.mp4")), picture = io.readPicture(at("odd.png"));
    ASSERT_EQ(video.size, Index2(64, 48));
    Picture padded(video.size);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) padded.at(x, y) = picture.at(std::min(x, 62), std::min(y, 46));
    // Half the resolution in colour and 8-bit YCbCr: 35 dB at an edge of saturated colour against black.
    EXPECT_GT(psnr(video, padded), 30);
}

TEST_F(AnimateCommand, QualityIsTheEncoders) {
    ASSERT_EQ(animate("good.mp4", {"--frames", "4-6", "--crf", "5"}).status, 0);
    ASSERT_EQ(animate("bad.mp4", {"--frames", "4-6", "--crf", "45"}).status, 0);
    EXPECT_GT(fs::file_size(at("good.mp4")), fs::file_size(at("bad.mp4")));
}

// ---- Stopping and going on ----------------------------------------------------------------------------------------

TEST_F(AnimateCommand, KilledVideoResumesToTheUnbrokenOnesBytes) {
    for (const std::string workers : {"1", "2"}) {
        const std::string name = "killed" + workers + ".mp4";
        ASSERT_EQ(stopped(words(name, {"--workers", workers}), at(name + ".frames"), 3, SIGKILL), 128 + SIGKILL);
        EXPECT_FALSE(fs::exists(at(name)));
        EXPECT_GE(pictures(at(name + ".frames")), 3);
        expectWholeFramesOnly(at(name + ".frames"));
        const auto resumed = animate(name, {"--resume", "--workers", workers});
        ASSERT_EQ(resumed.status, 0) << resumed.err;
    }
    ASSERT_EQ(animate("unbroken.mp4").status, 0);
    EXPECT_EQ(bytesOf(at("killed1.mp4")), bytesOf(at("unbroken.mp4")));
    EXPECT_EQ(bytesOf(at("killed2.mp4")), bytesOf(at("unbroken.mp4")));
}

TEST_F(AnimateCommand, KilledPicturesResumeAndFinishedOnesAreNotTouched) {
    fs::create_directory(folder / "k");
    ASSERT_EQ(stopped(words("k/%d.png"), folder / "k", 3, SIGKILL), 128 + SIGKILL);
    expectWholeFramesOnly(folder / "k");
    // One finished frame is damaged, one removed; the others are to keep their files.
    fs::resize_file(frame("k/", 0), fs::file_size(frame("k/", 0)) / 2);
    const auto before = fs::last_write_time(frame("k/", 1));
    const auto resumed = animate("k/%d.png", {"--resume"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(fs::last_write_time(frame("k/", 1)), before);
    fs::create_directory(folder / "u");
    ASSERT_EQ(animate("u/%d.png").status, 0);
    for (int n = 0; n < kFrames; ++n) EXPECT_EQ(bytesOf(frame("k/", n)), bytesOf(frame("u/", n))) << n;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "k"), {}), kFrames) << "pictures and nothing else";
}

TEST_F(AnimateCommand, CtrlCLeavesWholeFramesAndSaysHowToGoOn) {
    fs::create_directory(folder / "c");
    std::string errors;
    EXPECT_EQ(stopped(words("c/%d.png", {"--workers", "2"}), folder / "c", 2, SIGINT, &errors), 1);
    EXPECT_THAT(errors, HasSubstr("--resume"));
    const int there = pictures(folder / "c");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "c"), {}), there) << "pictures and nothing else";
    expectWholeFramesOnly(folder / "c");
    usleep(300000);
    EXPECT_EQ(pictures(folder / "c"), there) << "something still draws";
    EXPECT_EQ(animate("c/%d.png", {"--resume"}).status, 0);
    EXPECT_EQ(pictures(folder / "c"), kFrames);
}

TEST_F(AnimateCommand, ResumeDrawsAnewWhatChangedAndSaysWhat) {
    const auto expectAnew = [&](const std::string& why, const std::vector<std::string>& more) {
        std::vector<std::string> with = more, without = more;
        with.push_back("--resume");
        const auto resumed = animate("r%d.png", with);
        ASSERT_EQ(resumed.status, 0) << resumed.err;
        EXPECT_THAT(resumed.err, HasSubstr(why));
        ASSERT_EQ(animate("fresh%d.png", without).status, 0);
        for (int n = 2; n <= 4; ++n) EXPECT_EQ(bytesOf(frame("r", n)), bytesOf(frame("fresh", n))) << why << n;
    };
    ASSERT_EQ(animate("r%d.png", {"--frames", "2-4"}).status, 0);
    EXPECT_THAT(animate("r%d.png", {"--frames", "2-4", "--resume"}).err, Not(HasSubstr("anew")));
    writeScene(70);
    expectAnew("the scene", {"--frames", "2-4"});
    expectAnew("rate", {"--frames", "2-4", "--fps", "7"});
    expectAnew("step", {"--frames", "2-4", "--fps", "7", "--step", "3"});
    std::ofstream(folder / "camera.json") << R"({"eye":[0,-9,0],"target":[0,0,0],"up":[0,0,1],"fovY":30})";
    expectAnew("camera", {"--frames", "2-4", "--fps", "7", "--step", "3", "--camera", at("camera.json")});
}

TEST_F(AnimateCommand, WithoutResumeLeftoversAreDrawnAnew) {
    ASSERT_EQ(animate("w%d.png", {"--frames", "0-1"}).status, 0);
    const std::string right = bytesOf(frame("w", 1));
    std::ofstream(frame("w", 1)) << "something else";
    ASSERT_EQ(animate("w%d.png", {"--frames", "0-1"}).status, 0);
    EXPECT_EQ(bytesOf(frame("w", 1)), right);
}

TEST_F(AnimateCommand, PicturesOfUnknownOriginAreKeptWhereTheyAreWhole) {
    ASSERT_EQ(animate("o%d.png", {"--frames", "0-3"}).status, 0);
    fs::remove_all(folder / "cache");
    const std::string whole = bytesOf(frame("o", 0)), second = bytesOf(frame("o", 1)), third = bytesOf(frame("o", 2));
    std::ofstream(frame("o", 1)) << whole;                             // another frame, but whole
    fs::resize_file(frame("o", 2), fs::file_size(frame("o", 2)) - 1);  // cut
    const auto resumed = animate("o%d.png", {"--frames", "0-3", "--resume"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("3 frames were there already"));
    EXPECT_EQ(bytesOf(frame("o", 1)), whole);
    EXPECT_EQ(bytesOf(frame("o", 2)), third);
}

TEST_F(AnimateCommand, TwoRunsDoNotDrawTheSameAtOnce) {
    std::vector<std::string> command{(programFolder() / "voledit").string()};
    const auto more = words("twice.mp4");
    command.insert(command.end(), more.begin(), more.end());
    ChildProcess first({.command = command, .environment = {}, .keepErrors = true});
    while (!first.ended() && pictures(at("twice.mp4.frames")) < 1) usleep(2000);
    const auto second = animate("twice.mp4", {"--resume"});
    EXPECT_EQ(second.status, 1);
    EXPECT_THAT(second.err, HasSubstr("another voledit"));
    EXPECT_EQ(first.wait(), 0) << first.errors();
}

// ---- What fails ---------------------------------------------------------------------------------------------------

TEST_F(AnimateCommand, WrongFlagsAreExitStatusTwo) {
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{"--frames", "5-4"},
                                                                                      {"--frames", "a-b"},
                                                                                      {"--frames", "0-9999999"},
                                                                                      {"--fps", "0"},
                                                                                      {"--fps", "nan"},
                                                                                      {"--crf", "99"},
                                                                                      {"--workers", "-1"},
                                                                                      {"--workers", "1000"},
                                                                                      {"--size", "0x7"},
                                                                                      {"--step", "0"},
                                                                                      {"--gl", "glide"},
                                                                                      {"--no-such-flag"}}) {
        const auto result = animate("x.mp4", more);
        EXPECT_EQ(result.status, 2) << more.front() << result.err;
    }
    for (const char* out : {"x.png", "x%d%d.png", "x%s.png", "x%n.png", "x.avi", "x"})
        EXPECT_EQ(animate(out).status, 2) << out;
    EXPECT_EQ(animate("x%d.png", {"--crf", "20"}).status, 2) << "pictures have no such quality";
    EXPECT_EQ(animate("x%d.png", {"--renderer", "magic"}).status, 2);
    for (const auto& entry : fs::directory_iterator(folder)) EXPECT_NE(entry.path().filename().string()[0], 'x');
}

TEST_F(AnimateCommand, PlacesThatCannotBeWrittenAreErrors) {
    EXPECT_EQ(animate("absent/x.mp4").status, 1);
    EXPECT_EQ(animate("absent/%d.png").status, 1);
    std::ofstream(at("y.mp4.frames")) << "a file where the folder is to be";
    const auto result = animate("y.mp4");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("y.mp4.frames"));
    EXPECT_EQ(run("voledit", {"animate", at("absent.voledit"), "-o", at("z.mp4")}).status, 1);
    EXPECT_FALSE(fs::exists(at("z.mp4.frames")));
}

TEST_F(AnimateCommand, MissingFfmpegIsSaidBeforeAnythingIsDrawn) {
    std::vector<std::string> command{"env", "PATH=/nowhere", (programFolder() / "voledit").string()};
    const auto more = words("x.mp4");
    command.insert(command.end(), more.begin(), more.end());
    ChildProcess child({.command = command, .environment = {}, .keepErrors = true});
    EXPECT_EQ(child.wait(), 1);
    EXPECT_THAT(child.errors(), HasSubstr("install the package ffmpeg"));
    EXPECT_FALSE(fs::exists(at("x.mp4.frames")));
}

/// Runs `script` in a shell with the program and `arguments` as "$@"; its exit status and errors.
std::pair<int, std::string> shell(const std::string& script, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{"sh", "-c", script, "sh", (programFolder() / "voledit").string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ChildProcess child({.command = command, .environment = {}, .keepErrors = true});
    const int status = child.wait();
    return {status, child.errors()};
}

TEST_F(AnimateCommand, VideoThatCannotBeWrittenKeepsTheFrames) {
    // An ffmpeg that passes the trial and then fails: all frames are there, and no video.
    fs::create_directory(folder / "bin");
    std::ofstream(folder / "bin" / "ffmpeg") << "#!/bin/sh\ncase \"$*\" in *lavfi*color=*) exit 0;; esac\n"
                                                "cat > /dev/null\necho out of ink >&2\nexit 1\n";
    fs::permissions(folder / "bin" / "ffmpeg", fs::perms::owner_all);
    const auto [failed, why] = shell("PATH=" + at("bin") + ":$PATH; exec \"$@\"", words("part.gif"));
    EXPECT_EQ(failed, 1);
    EXPECT_THAT(why, testing::AllOf(HasSubstr("part.gif"), HasSubstr("out of ink"), HasSubstr("--resume")));
    // Files may have no more than three blocks of 512 bytes, so the video does not fit.
    const auto [full, cause] = shell("ulimit -f 3; exec \"$@\"", words("part.gif", {"--resume"}));
    EXPECT_EQ(full, 1);
    EXPECT_THAT(cause, testing::AllOf(HasSubstr("part.gif"), HasSubstr("larger than"), HasSubstr("--resume")));
    EXPECT_FALSE(fs::exists(at("part.gif")));
    EXPECT_EQ(pictures(at("part.gif.frames")), kFrames + 1) << "the frames and the palette";
    expectWholeFramesOnly(at("part.gif.frames"));
    ASSERT_EQ(animate("part.gif", {"--resume"}).status, 0);
    ASSERT_EQ(animate("whole.gif").status, 0);
    EXPECT_EQ(bytesOf(at("part.gif")), bytesOf(at("whole.gif")));
}

TEST_F(AnimateCommand, FullDiskLeavesWholeFramesOnly) {
    if (shell("exec unshare -rm mount -t tmpfs none /mnt", {}).first != 0)
        GTEST_SKIP() << "no small disk can be made here (user namespaces are off)";
    // A disk for the first frames alone; what is on it is copied out before it goes.
    const fs::path kept = folder / "kept";
    fs::create_directory(kept);
    const std::string script =
        "exec unshare -rm sh -c 'mount -t tmpfs -o size=16k none /mnt; \"$@\"; status=$?; cp -a "
        "/mnt/. \"" +
        kept.string() + "\"; exit $status' sh \"$@\"";
    auto arguments = words("full", {"--workers", "1"});
    arguments[3] = "/mnt/%d.png";
    arguments[5] = "96x72";
    const auto [status, errors] = shell(script, arguments);
    EXPECT_EQ(status, 1);
    EXPECT_THAT(errors, testing::AllOf(HasSubstr("/mnt/"), HasSubstr("No space left"), HasSubstr("--resume")));
    const int there = pictures(kept);
    EXPECT_GT(there, 0);
    EXPECT_LT(there, kFrames);
    EXPECT_EQ(std::distance(fs::directory_iterator(kept), {}), there) << "pictures and nothing else";
    for (int n = 0; n < there; ++n) EXPECT_TRUE(isWholePicture(kept / (std::to_string(n) + ".png"), {96, 72})) << n;
}

TEST_F(AnimateCommand, SceneThatFailsAtSomeFrameKeepsTheFramesBefore) {
    // The scale goes through 0 between its keys.
    std::ofstream(folder / "twist.voledit") << R"({"voledit":1,"root":{"type":"place",
        "scale":{"keys":[[0,1],[1,-1]]},"of":{"type":"solid","shape":{"sphere":{"center":[0,0,0],"radius":1}},
        "color":[1,1,1],"opacity":1}},"timeline":{"fps":10,"start":0,"end":10},
        "camera":{"eye":[0,-9,0],"target":[0,0,0],"up":[0,0,1],"fovY":30}})";
    const auto result = animate("s%d.png", {"--workers", "1"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("frame 5: "));
    for (int n = 0; n < 5; ++n) EXPECT_TRUE(isWholePicture(frame("s", n), kSize)) << n;
    EXPECT_FALSE(fs::exists(frame("s", 5)));
}

}  // namespace
}  // namespace voledit
