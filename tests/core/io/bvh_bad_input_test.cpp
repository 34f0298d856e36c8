// BVH files that must be refused, or at least do no harm.

#include <gtest/gtest.h>

#include <random>

#include "core/base/error.h"
#include "core/io/bvh.h"
#include "tests/core/io/bvh_files.h"
#include "tests/core/io/files.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::replaced;
using test::smallBvh;

void expectRefused(const std::string& text, const std::string& place, const std::string& cause) {
    try {
        parseBvh(text, "file.bvh");
        ADD_FAILURE() << "not refused: " << cause;
    } catch (const Error& error) {
        const std::string said = error.what();
        EXPECT_TRUE(said.starts_with(place)) << said;
        EXPECT_NE(said.find(cause), std::string::npos) << said;
        EXPECT_NE(said.find("; "), std::string::npos) << "no remedy: " << said;
        EXPECT_LT(said.size(), 400u) << said;
    }
}

void expectRefused(const std::string& from, const std::string& to, int line, const std::string& cause) {
    const std::string text = replaced(smallBvh(), from, to);
    ASSERT_FALSE(text.empty());
    expectRefused(text, "file.bvh, line " + std::to_string(line) + ":", cause);
}

TEST(BvhBadInput, NotBvhAtAll) {
    expectRefused("", "file.bvh", "empty");
    expectRefused(" \r\n\t", "file.bvh", "empty");
    expectRefused(std::string(4000, '\0'), "file.bvh, line 1", "HIERARCHY");
    expectRefused("\x89PNG\r\n\x1a\n", "file.bvh, line 1", "HIERARCHY");
    expectRefused("{\"voledit\": 1}", "file.bvh, line 1", "HIERARCHY");
    expectRefused("HIERARCHY\nMOTION\nFrames: 0\nFrame Time: 1\n", "file.bvh, line 2", "no joints");
}

TEST(BvhBadInput, BrokenHierarchies) {
    expectRefused("ROOT Hips", "ROOT", 2, "no name");
    expectRefused("ROOT Hips\n{", "ROOT Hips\n", 4, "where { is expected");
    expectRefused("OFFSET 1 2 3", "OFFSET 1 2", 5, "\"CHANNELS\" is no number");
    expectRefused("OFFSET 1 2 3", "OFFSET 1 2 3 4", 4, "\"4\"");
    expectRefused("OFFSET 1 2 3", "OFFSET nan 2 3", 4, "not finite");
    expectRefused("OFFSET 1 2 3", "OFFSET 1e999 2 3", 4, "not finite");
    expectRefused("OFFSET 1 2 3", "OFFSET -inf 2 3", 4, "not finite");
    expectRefused("OFFSET 1 2 3", "OFFSET 1e30 2 3", 4, "out of range");
    expectRefused("OFFSET 1 2 3", "OFFSET 1,5 2 3", 4, "\"1,5\" is no number");
    expectRefused("OFFSET 1 2 3", "OFFSET 0x1 2 3", 4, "is no number");
    expectRefused("OFFSET 1 2 3\n", "OFFSET 1 2 3\n OFFSET 1 2 3", 5, "twice");
    expectRefused("  OFFSET 1 2 3\n", "", 19, "no OFFSET");
    expectRefused("        OFFSET 0 2 0\n", "", 16, "End Site has no OFFSET");
    expectRefused("MOTION", "", 22, "\"Frames:\" stands where ROOT or MOTION is expected");
    expectRefused("}\nMOTION", "MOTION", 20, "\"MOTION\" stands where");
    expectRefused("End Site", "End Sight", 14, "\"End\"");
}

TEST(BvhBadInput, BrokenChannels) {
    expectRefused("CHANNELS 6", "CHANNELS -6", 5, "number of channels");
    expectRefused("CHANNELS 6", "CHANNELS 2.5", 5, "number of channels");
    expectRefused("CHANNELS 6", "CHANNELS 1000000000", 5, "number of channels");
    expectRefused("CHANNELS 6", "CHANNELS 5", 5, "\"Yrotation\" stands where");
    expectRefused("CHANNELS 6", "CHANNELS 7", 6, "\"JOINT\" is no channel");
    expectRefused("Yposition", "Wposition", 5, "\"Wposition\" is no channel");
    expectRefused("Yposition", "Xposition", 5, "Xposition twice");
    expectRefused("HIERARCHY ROOT a\n{ OFFSET 0 0 0 JOINT b\n { OFFSET 0 0 0 } CHANNELS 1 Xrotation }\nMOTION",
                  "file.bvh, line 3", "behind a joint");
}

TEST(BvhBadInput, BrokenFrameTables) {
    expectRefused("Frames: 2", "Frames: -2", 22, "number of frames");
    expectRefused("Frames: 2", "Frames: 1.5", 22, "number of frames");
    expectRefused("Frames: 2", "Frames: many", 22, "\"many\" is no number");
    expectRefused("Frames: 2", "Frames: 1000000000", 22, "more than 10000000 frames");
    expectRefused("Frames: 2", "Frame: 2", 22, "Frames: is expected");
    for (const char* time : {"0", "-0.1", "1e-9", "1e9"}) expectRefused("0.025", time, 23, "frame time");
    expectRefused("0.025", "nan", 23, "not finite");
    expectRefused("Frame Time: 0.025\n", "", 23, "Frame Time:");
}

TEST(BvhBadInput, BrokenFrames) {
    expectRefused("4 5 6 0 0", "4 5 6 0", 24, "frame 0 does not have the 10 numbers");
    expectRefused("4 5 6 0 0", "4 5 6 0 0 0", 24, "frame 0 does not have the 10 numbers");
    expectRefused("-40 50 60 70", "-40 50 60", 25, "it ends within frame 1, which has 9 of 10");
    expectRefused("-40 50 60 70", "-40 nan 60 70", 25, "\"nan\" is not finite");
    expectRefused("-40 50 60 70", "-40 50 inf 70", 25, "\"inf\" is not finite");
    expectRefused("-40 50 60 70", "-40 x 60 70", 25, "\"x\" is no number");
    const std::string text = smallBvh();
    expectRefused(text.substr(0, text.find("4 5 6")), "file.bvh", "holds none");
}

TEST(BvhBadInput, NoCutFileDoesHarm) {
    const std::string text = smallBvh();
    const std::size_t whole = text.find("1.5 -2");  // from here on a frame is there
    for (std::size_t n = 0; n < text.size() - 1; ++n) {
        std::vector<std::string> warnings;
        try {
            const Motion m = parseBvh(text.substr(0, n), "file.bvh", &warnings);
            EXPECT_GE(n + 1, whole);
            EXPECT_EQ(m.values.size(), m.frames * m.channelCount());
            EXPECT_TRUE(m.frames == 2 || !warnings.empty()) << n;
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("file.bvh"));
        }
    }
}

std::string chainOf(std::size_t joints) {
    std::string text = "HIERARCHY\nROOT j\n{ OFFSET 0 0 0\n";
    for (std::size_t j = 1; j < joints; ++j) text += "JOINT j" + std::to_string(j) + "\n{ OFFSET 0 1 0\n";
    for (std::size_t j = 0; j < joints; ++j) text += "}";
    return text + "\nMOTION\nFrames: 1\nFrame Time: 1\n";
}

TEST(BvhBadInput, EndlessHierarchies) {
    EXPECT_EQ(parseBvh(chainOf(1000), "file.bvh").joints.size(), 1000u);
    expectRefused(chainOf(1001), "file.bvh, line ", "deeper than 1000");
    expectRefused(chainOf(100'000), "file.bvh, line ", "deeper than 1000");
    std::string wide = "HIERARCHY\nROOT j\n{ OFFSET 0 0 0\n";
    for (int j = 0; j < 20'000; ++j) wide += "JOINT j\n{ OFFSET 0 1 0 }\n";
    expectRefused(wide, "file.bvh, line ", "more than 10000 joints");
    expectRefused(std::string(100'000, '{'), "file.bvh, line 1", "HIERARCHY");
    expectRefused("HIERARCHY ROOT a\n" + std::string(100'000, '{'), "file.bvh, line 2", "stands where");
}

TEST(BvhBadInput, TenThousandEqualNames) {
    std::string wide = "HIERARCHY\nROOT j\n{ OFFSET 0 0 0\n";
    for (std::size_t j = 1; j < kMostJoints; ++j) wide += "JOINT j\n{ OFFSET 0 1 0 }\n";
    std::vector<std::string> warnings;
    const Motion m = parseBvh(wide + "}\nMOTION\nFrames: 0\nFrame Time: 1\n", "file.bvh", &warnings);
    EXPECT_EQ(m.joints.back().name, "j_10000");
    EXPECT_EQ(warnings.size(), 10u);
}

TEST(BvhBadInput, HostileNames) {
    expectRefused("Spine.01", std::string("a\0b", 3), 6, "is no text");
    expectRefused("Spine.01", "a\x1b[31m", 6, "is no text");
    expectRefused("Spine.01", std::string(100'000, 'n'), 6, "longer than 200 bytes");
}

TEST(BvhBadInput, FilesThatAreNone) {
    const fs::path folder = test::scratchFolder();
    EXPECT_THROW(readBvh(folder), Error);
    EXPECT_THROW(readBvh(folder / "missing.bvh"), Error);
    EXPECT_THROW(readBvh("/dev/zero"), Error);
    test::writeFile(folder / "empty.bvh", "");
    EXPECT_THROW(readBvh(folder / "empty.bvh"), Error);
    // Longer than may be, though it takes no room.
    test::writeFile(folder / "long.bvh", smallBvh());
    fs::resize_file(folder / "long.bvh", BvhLimits::fileBytes + 1);
    EXPECT_THROW(readBvh(folder / "long.bvh"), Error);
}

/// One to three bytes or words replaced, dropped or doubled.
std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const char* const words[] = {
        "{", "}", "nan", "-1", "1e999", "JOINT", "End Site", "CHANNELS 3", "MOTION", "Frames: 99999999", "\n"};
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) {
        const std::size_t at = below(text.size());
        switch (below(5)) {
            case 0:
                text[at] = char(below(256));
                break;
            case 1:
                text.insert(at, words[below(std::size(words))]);
                break;
            case 2:
                text.erase(at, 1 + below(8));
                break;
            case 3:
                text.resize(at);
                break;
            default:
                text.insert(at, text.substr(at, 1 + below(40)));
        }
    }
    return text;
}

TEST(BvhBadInput, MutilatedCopiesDoNoHarm) {
    std::mt19937 random(4);
    int read = 0, refused = 0;
    for (int n = 0; n < 20'000; ++n) {
        try {
            const Motion m = parseBvh(mutated(smallBvh(), random), "file.bvh");
            EXPECT_EQ(m.values.size(), m.frames * m.channelCount());
            const Motion again = parseBvh(bvhText(m), "again.bvh");
            EXPECT_EQ(again, m);
            ++read;
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("file.bvh")) << error.what();
            ++refused;
        }
    }
    // Both ways out are met often.
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace voledit
