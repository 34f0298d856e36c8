#include "app/animation/animation_output.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

TEST(AnimationOutput, KnowsKindsByEnding) {
    EXPECT_EQ(AnimationOutput("walk.mp4").kind(), AnimationKind::Mp4);
    EXPECT_EQ(AnimationOutput("walk.WEBM").kind(), AnimationKind::Webm);
    EXPECT_EQ(AnimationOutput("walk.gif").kind(), AnimationKind::Gif);
    EXPECT_EQ(AnimationOutput("f%d.png").kind(), AnimationKind::PngFrames);
    EXPECT_EQ(AnimationOutput("f%d.exr").kind(), AnimationKind::ExrFrames);
    EXPECT_TRUE(AnimationOutput("walk.gif").isVideo());
    EXPECT_FALSE(AnimationOutput("f%d.exr").isVideo());
}

TEST(AnimationOutput, NumbersFramesAsPrintfDoes) {
    EXPECT_EQ(AnimationOutput("/a/frame-%04d.png").frameFile(12), "/a/frame-0012.png");
    EXPECT_EQ(AnimationOutput("/a/frame-%04d.png").frameFile(123456), "/a/frame-123456.png");
    EXPECT_EQ(AnimationOutput("/a/frame-%04d.png").frameFile(-7), "/a/frame--007.png");
    EXPECT_EQ(AnimationOutput("/a/%d_x.exr").frameFile(12), "/a/12_x.exr");
    EXPECT_EQ(AnimationOutput("/a/%012d.png").frameFile(1), "/a/000000000001.png");
    // Only the name is a pattern.
    EXPECT_EQ(AnimationOutput("/50%s/f%02d.png").frameFile(3), "/50%s/f03.png");
}

TEST(AnimationOutput, RefusesEveryOtherPattern) {
    for (const char* out :
         {"frame.png", "f%s.png",   "f%n.png",   "f%d%d.png",  "f%04d-%n.png", "f%%d.png",  "f%.png",
          "f%4d.png",  "f%0d.png",  "f%00d.png", "f%013d.png", "f%0100d.png",  "f%-4d.png", "f%ld.png",
          "f%x.png",   "f%1$d.png", "f%04d.jpg", "f%04d",      "walk.avi",     "",          "%d"})
        EXPECT_THROW(AnimationOutput{out}, std::invalid_argument) << out;
}

TEST(AnimationOutput, KnowsItsFramesNames) {
    const AnimationOutput output("a-%03d.png");
    EXPECT_TRUE(output.isFrameName("a-004.png"));
    EXPECT_TRUE(output.isFrameName("a--04.png"));
    EXPECT_TRUE(output.isFrameName("a-1234.png"));
    for (const char* name : {"a-.png", "a-x.png", "a-004.jpg", "b-004.png", "a-0 4.png", "a-004.png.part"})
        EXPECT_FALSE(output.isFrameName(name)) << name;
}

TEST(AnimationOutput, VideosFramesLieBesideIt) {
    const AnimationOutput output("/films/walk.mp4");
    EXPECT_EQ(output.frameFolder(), "/films/walk.mp4.frames");
    EXPECT_EQ(output.frameFile(3), "/films/walk.mp4.frames/frame-000003.png");
    EXPECT_EQ(output.recordFile().parent_path(), output.frameFolder());
}

TEST(AnimationOutput, RecordOfPicturesIsAmongTheCachedFiles) {
    const fs::path cache = test::scratchFolder();
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    const fs::path one = AnimationOutput("/films/a%d.png").recordFile();
    EXPECT_EQ(one.parent_path(), cache / "voledit" / "animations");
    EXPECT_EQ(AnimationOutput("/films/../films/a%d.png").recordFile(), one);
    EXPECT_NE(AnimationOutput("/films/b%d.png").recordFile(), one);
    unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace voledit
