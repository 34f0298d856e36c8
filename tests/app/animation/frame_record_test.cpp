#include "app/animation/frame_record.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/animation/animation_files.h"
#include "core/base/error.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

struct Video {
    AnimationOutput output{test::scratchFolder() / "walk.mp4"};
    FrameSettings settings{.scene = "abc", .camera = "", .renderer = "rays", .size = {8, 6}, .fps = 24, .step = -1};

    Video() { makeFrameFolder(output); }
    fs::path writeFrame(int n, const std::string& text) const {
        std::ofstream(output.frameFile(n)) << text;
        return output.frameFile(n);
    }
};

TEST(FrameRecord, HoldsTheFramesThatAreTheVerySame) {
    Video video;
    {
        FrameRecord record(video.output);
        EXPECT_FALSE(record.known());
        record.begin(video.settings, false);
        for (int n = 0; n < 4; ++n) record.add(finishedFrame(n, video.writeFrame(n, "frame " + std::to_string(n))));
    }
    fs::remove(video.output.frameFile(1));
    video.writeFrame(2, "other 2");  // of the same length
    video.writeFrame(4, "never recorded");
    FrameRecord record(video.output);
    EXPECT_TRUE(record.known());
    EXPECT_EQ(record.mismatch(video.settings), "");
    record.begin(video.settings, true);
    const auto held = [&](int n) { return record.holds(n, video.output.frameFile(n)); };
    EXPECT_TRUE(held(0));
    EXPECT_FALSE(held(1)) << "removed";
    EXPECT_FALSE(held(2)) << "changed";
    EXPECT_TRUE(held(3));
    EXPECT_FALSE(held(4)) << "not recorded";
}

TEST(FrameRecord, SaysWhatIsAnother) {
    Video video;
    {
        FrameRecord record(video.output);
        record.begin(video.settings, false);
    }
    const FrameRecord record(video.output);
    const auto mismatch = [&](auto change) {
        FrameSettings settings = video.settings;
        change(settings);
        return record.mismatch(settings);
    };
    EXPECT_NE(mismatch([](auto& s) { s.scene = "x"; }).find("scene"), std::string::npos);
    EXPECT_NE(mismatch([](auto& s) { s.size.x = 9; }).find("size"), std::string::npos);
    EXPECT_NE(mismatch([](auto& s) { s.fps = 25; }).find("rate"), std::string::npos);
    EXPECT_NE(mismatch([](auto& s) { s.camera = "x"; }).find("camera"), std::string::npos);
    EXPECT_NE(mismatch([](auto& s) { s.renderer = ""; }).find("renderer"), std::string::npos);
    EXPECT_NE(mismatch([](auto& s) { s.step = 2; }).find("step"), std::string::npos);
}

TEST(FrameRecord, StartingAnewForgets) {
    Video video;
    {
        FrameRecord record(video.output);
        record.begin(video.settings, false);
        record.add(finishedFrame(0, video.writeFrame(0, "zero")));
    }
    {
        FrameRecord record(video.output);
        record.begin(video.settings, false);
        EXPECT_FALSE(record.holds(0, video.output.frameFile(0)));
    }
    FrameRecord record(video.output);
    EXPECT_FALSE(record.holds(0, video.output.frameFile(0)));
}

TEST(FrameRecord, LineThatWasCutCostsOneFrame) {
    Video video;
    {
        FrameRecord record(video.output);
        record.begin(video.settings, false);
        for (int n = 0; n < 3; ++n) record.add(finishedFrame(n, video.writeFrame(n, "frame " + std::to_string(n))));
    }
    fs::resize_file(video.output.recordFile(), fs::file_size(video.output.recordFile()) - 9);
    {
        FrameRecord record(video.output);
        record.begin(video.settings, true);
        EXPECT_TRUE(record.holds(1, video.output.frameFile(1)));
        EXPECT_FALSE(record.holds(2, video.output.frameFile(2)));
        record.add(finishedFrame(2, video.output.frameFile(2)));
    }
    const FrameRecord record(video.output);
    for (int n = 0; n < 3; ++n) EXPECT_TRUE(record.holds(n, video.output.frameFile(n))) << n;
}

TEST(FrameRecord, WhatIsNoRecordIsNone) {
    Video video;
    for (const char* text : {"", "\n\n", "{", "[1,2]", "{\"voledit-frames\":9}", "{\"voledit-frames\":1}",
                             "{\"voledit-frames\":1,\"scene\":7,\"camera\":\"\"}", "null\n{\"frame\":1}"}) {
        std::ofstream(video.output.recordFile()) << text;
        const FrameRecord record(video.output);
        EXPECT_FALSE(record.known()) << text;
    }
}

TEST(FrameRecord, TwoProgramsCannotDrawTheSame) {
    Video video;
    const FrameRecord one(video.output);
    EXPECT_THROW(FrameRecord{video.output}, Error);
}

TEST(AnimationFiles, RemovesItsOwnFilesOnly) {
    Video video;
    {
        FrameRecord record(video.output);
        record.begin(video.settings, false);
        record.add(finishedFrame(0, video.writeFrame(0, "zero")));
    }
    const fs::path folder = video.output.frameFolder();
    fs::create_directory(folder / ".voledit-a1b2c3");
    std::ofstream(folder / ".voledit-a1b2c3" / "frame-000007.png") << "half";
    std::ofstream(folder / "notes.txt") << "mine";
    removeFrames(video.output);
    EXPECT_TRUE(fs::exists(folder / "notes.txt"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    fs::remove(folder / "notes.txt");
    removeFrames(video.output);
    EXPECT_FALSE(fs::exists(folder));
}

TEST(AnimationFiles, LeftoversBesidePicturesAreToldByWhatIsInThem) {
    const fs::path folder = test::scratchFolder();
    const AnimationOutput output(folder / "a%03d.png");
    for (const char* name : {".voledit-111111", ".voledit-222222", ".voledit-333333", "other"})
        fs::create_directory(folder / name);
    std::ofstream(folder / ".voledit-111111" / "a004.png") << "half";
    std::ofstream(folder / ".voledit-222222" / "scan.nrrd") << "another program's";
    std::ofstream(folder / "other" / "a004.png") << "whole";
    removeLeftovers(output);
    EXPECT_FALSE(fs::exists(folder / ".voledit-111111"));
    for (const char* name : {".voledit-222222", ".voledit-333333", "other"}) EXPECT_TRUE(fs::exists(folder / name));
}

}  // namespace
}  // namespace voledit
