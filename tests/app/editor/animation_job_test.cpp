#include "app/editor/animation_job.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "app/editor/session.h"
#include "core/base/error.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(AnimationRequest, PathMayHaveSpacesAndWordsStandBehindIt) {
    AnimationRequest plain;
    plain.out = "/a/my walk.mp4";
    EXPECT_EQ(parseAnimationRequest("/a/my walk.mp4"), plain);
    const AnimationRequest all = parseAnimationRequest("/a/my walk 2.mp4 64x48 -2-12 rays resume");
    EXPECT_EQ(all.out, "/a/my walk 2.mp4");
    EXPECT_EQ(all.size, Index2(64, 48));
    EXPECT_EQ(all.frames, "-2-12");
    EXPECT_EQ(all.renderer, "rays");
    EXPECT_TRUE(all.resume);
    EXPECT_EQ(parseAnimationRequest("f-%03d.png 0-4").frames, "0-4");
}

TEST(AnimationRequest, OtherWordsAreErrors) {
    for (const char* text :
         {"", "a.avi", "a.png", "a.mp4 fast", "a.mp4 0x48", "a.mp4 99999x48", "a.mp4 rays 64x48", "f%s.png", "resume"})
        EXPECT_THROW(parseAnimationRequest(text), Error) << text;
}

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A scene of a box that is twisted over three frames, opened headless.
struct AnimationSession : testing::Test {
    fs::path folder = test::scratchFolder();
    std::unique_ptr<Session> session;

    void SetUp() override {
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        std::ofstream(folder / "twist.voledit") << R"({"voledit":1,"root":{"type":"transfer","by":[{"type":"twist",
            "axis":"z","angle":{"keys":[[0,0],[1,90]]},"frame":{"min":[-1,-1,-1],"max":[1,1,1]}}],
            "of":{"type":"solid","shape":{"box":{"min":[-0.6,-0.6,-0.9],"max":[0.6,0.6,0.9]}},
            "color":[0.9,0.5,0.2],"opacity":1}},"timeline":{"fps":3,"start":0,"end":3}})";
        EditorOptions options;
        options.headless = true;
        options.file = folder / "twist.voledit";
        session = std::make_unique<Session>(options);
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }
    void play(const std::string& events) { replay(parseEvents(events, "test.ev"), "test.ev", *session); }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string lastNotice() const {
        const auto& notices = session->editor().workspace().notices;
        return notices.empty() ? "" : notices.back().text;
    }
};

TEST_F(AnimationSession, RendersWhatTheEditorShowsAsTheCommandDoes) {
    play("do file.render-animation " + at("e%d.png") + " 48x36 rays\nwait idle\n");
    EXPECT_THAT(lastNotice(), HasSubstr("Rendered"));
    play("do file.save-as " + at("saved.voledit") + "\n");
    const auto result = test::run(
        "voledit", {"animate", at("saved.voledit"), "-o", at("c%d.png"), "--size", "48x36", "--renderer", "rays"});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const std::string n : {"0", "1", "2"}) {
        EXPECT_GT(fs::file_size(at("e" + n + ".png")), 100u);
        EXPECT_EQ(bytesOf(at("e" + n + ".png")), bytesOf(at("c" + n + ".png"))) << n;
    }
    EXPECT_FALSE(fs::exists(at("e3.png")));
}

TEST_F(AnimationSession, EditsGoOnAndDoNotReachWhatIsRendered) {
    play("do file.render-animation " + at("before%d.png") + " 48x36 0-1 rays\ndo view.top\n");
    EXPECT_TRUE(session->editor().rendering());
    play("wait idle\ndo file.render-animation " + at("after%d.png") + " 48x36 0-1 rays\nwait idle\n");
    EXPECT_FALSE(session->editor().rendering());
    EXPECT_NE(bytesOf(at("before1.png")), bytesOf(at("after1.png"))) << "the view was turned in between";
}

TEST_F(AnimationSession, CancelStopsItAndResumeGoesOn) {
    play("do file.render-animation " + at("walk.mp4") + " 48x36 rays\ndo file.cancel-animation\nwait idle\n");
    EXPECT_THAT(lastNotice(), HasSubstr("stopped"));
    EXPECT_FALSE(fs::exists(at("walk.mp4")));
    play("do file.render-animation " + at("walk.mp4") + " 48x36 rays resume\nwait idle\n");
    EXPECT_TRUE(fs::exists(at("walk.mp4")));
}

TEST_F(AnimationSession, FailuresAreToldWithTheirCause) {
    std::ofstream(at("x.mp4.frames")) << "in the way";
    EXPECT_THROW(play("do file.render-animation " + at("x.mp4") + " 48x36\nwait idle\n"), Error);
    EXPECT_THAT(lastNotice(), HasSubstr("x.mp4.frames"));
    EXPECT_THROW(play("do file.render-animation " + at("x.avi") + "\n"), Error);
}

TEST_F(AnimationSession, DialogRendersWhatItSays) {
    const auto typed = [](const std::string& widget, const std::string& text) {
        return "doubleclick @widget(\"Render animation/" + widget + "\")\npress Ctrl+A\ntext \"" + text +
               "\"\nframe 2\npress Enter\nframe 2\n";
    };
    play("do file.render-animation\nframe 3\n" + typed("Width", "48") + typed("Height", "36") +
         typed("Path", at("d-%d.png")) + "click @widget(\"Render animation/Render\")\nframe 2\nwait idle\n");
    for (const std::string n : {"0", "1", "2"}) ASSERT_TRUE(fs::exists(at("d-" + n + ".png"))) << n;
    EXPECT_FALSE(fs::exists(at("d-3.png")));
    IoClient io;
    EXPECT_EQ(io.readPicture(at("d-0.png")).size, Index2(48, 36));
}

}  // namespace
}  // namespace voledit
