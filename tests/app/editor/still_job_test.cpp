#include "app/editor/still_job.h"

#include <gmock/gmock.h>

#include <fstream>

#include "app/editor/session.h"
#include "core/base/error.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(StillRequest, PathMayHaveSpacesAndWordsStandBehindIt) {
    StillRequest plain;
    plain.out = "my picture.png";
    EXPECT_EQ(parseStillRequest("my picture.png"), plain);
    const StillRequest all = parseStillRequest("my picture 2.exr 64x48 3 transparent rays");
    EXPECT_EQ(all.out, "my picture 2.exr");
    EXPECT_EQ(all.size, Index2(64, 48));
    EXPECT_EQ(all.supersampling, 3);
    EXPECT_TRUE(all.transparent);
    EXPECT_EQ(all.renderer, "rays");
}

TEST(StillRequest, OtherWordsAreErrors) {
    for (const char* text : {"", "a.jpg", "a.png fast", "a.png 0x48", "a.png 9", "no such folder/a.png", "rays"})
        EXPECT_THROW(parseStillRequest(text), Error) << text;
}

// A ball before nothing, opened headless.
struct StillSession : testing::Test {
    fs::path folder = test::scratchFolder();
    std::unique_ptr<Session> session;

    void SetUp() override {
        std::ofstream(folder / "ball.voledit") << R"({"voledit":1,"root":{"type":"solid",
            "shape":{"box":{"min":[-0.6,-0.6,-0.9],"max":[0.6,0.6,0.9]}},"color":[0.9,0.5,0.2],"opacity":1}})";
        EditorOptions options;
        options.headless = true;
        options.file = folder / "ball.voledit";
        session = std::make_unique<Session>(options);
    }
    void play(const std::string& events) { replay(parseEvents(events, "test.ev"), "test.ev", *session); }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string lastNotice() const {
        const auto& notices = session->editor().workspace().notices;
        return notices.empty() ? "" : notices.back().text;
    }
};

TEST_F(StillSession, RendersWhatTheEditorShows) {
    play("do view.right\ndo file.render-still " + at("a.png") + " 48x36 rays\nwait idle\n");
    EXPECT_THAT(lastNotice(), HasSubstr("Saved"));
    play("do file.save-as " + at("saved.voledit") + "\n");
    const auto result = test::run(
        "voledit", {"render", at("saved.voledit"), "-o", at("b.png"), "--size", "48x36", "--renderer", "rays"});
    ASSERT_EQ(result.status, 0) << result.err;
    IoClient io;
    const Picture a = io.readPicture(at("a.png")), b = io.readPicture(at("b.png"));
    ASSERT_EQ(a.size, Index2(48, 36));
    EXPECT_EQ(a.pixels, b.pixels);
}

TEST_F(StillSession, EditsGoOnAndCancelStopsIt) {
    play("do file.render-still " + at("big.png") + " 4000x3000 rays\ndo view.top\n");
    EXPECT_TRUE(session->editor().rendering());
    play("do file.cancel-still\nwait idle\n");
    EXPECT_FALSE(session->editor().rendering());
    EXPECT_THAT(lastNotice(), HasSubstr("stopped"));
    EXPECT_FALSE(fs::exists(at("big.png")));
}

TEST_F(StillSession, DialogRendersWhatItSays) {
    const auto typed = [](const std::string& widget, const std::string& text) {
        return "doubleclick @widget(\"Render still/" + widget + "\")\npress Ctrl+A\ntext \"" + text +
               "\"\nframe 2\npress Enter\nframe 2\n";
    };
    play("do file.render-still\nframe 3\n" + typed("Width", "40") + typed("Height", "30") + typed("Path", at("d.png")) +
         "click @widget(\"Render still/Render\")\nframe 2\nwait idle\n");
    IoClient io;
    EXPECT_EQ(io.readPicture(at("d.png")).size, Index2(40, 30));
}

}  // namespace
}  // namespace voledit
