// Sessions that build and change terms: what a user does with the tree, the Add menu and the inspector.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/editor/session.h"
#include "app/editor/state_json.h"
#include "core/base/error.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

constexpr const char* kBall = R"({ "voledit": 1,
  "objects": { "ball": { "type": "solid", "shape": { "sphere": { "center": [0,0,0], "radius": 1 } },
                         "color": [0.9, 0.7, 0.4], "opacity": 0.8 } },
  "root": { "use": "ball" } })";

struct AlgebraSessionTest : testing::Test {
    fs::path folder = test::scratchFolder();
    EditorOptions options;

    AlgebraSessionTest() {
        options.headless = true;
        options.file = folder / "ball.voledit";
        std::ofstream(options.file) << kBall;
    }
    void play(Session& session, const std::string& events) {
        replay(parseEvents(events, "test.ev"), "test.ev", session);
    }
    Json state(Session& session) { return Json::parse(stateJson(session.editor())); }
    void writeRipple(const std::string& formula, int seconds) {
        const fs::path file = folder / "ripple.stf";
        std::ofstream(file) << "title: Ripple\ndescription: Waves along x.\n"
                               "parameter height number = 0.1 slider [0, 1] \"How high the waves are\"\n\n[map]\nz = "
                            << formula << "\n";
        fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
    }
};

TEST_F(AlgebraSessionTest, ATwistIsAddedByTheMenuDraggedAndUndone) {
    Session session(options);
    play(session,
         "click @widget(\"Menu/Add\")\nclick @widget(\"Add/Transfers\")\nclick @widget(\"Add/Transfers/Twist\")\nframe "
         "3\n");
    const Json added = state(session);
    EXPECT_EQ(added["undo"], Json::parse(R"(["Add twist"])"));
    EXPECT_EQ(added["selection"]["node"], "/root/by/0");
    EXPECT_EQ(added["scene"]["transfers"]["twist"]["angle"], 90);
    EXPECT_EQ(added["scene"]["transfers"]["twist"]["frame"]["min"], Json::parse("[-1, -1, -1]"));

    play(session, "drag @widget(\"Inspector/Angle\") to @widget(\"Inspector/Angle\")+30,0\nframe\n");
    const Json dragged = state(session);
    EXPECT_EQ(dragged["undo"], Json::parse(R"(["Add twist", "Change angle"])"));
    EXPECT_GT(dragged["scene"]["transfers"]["twist"]["angle"], 95);

    play(session, "press Ctrl+Z\npress Ctrl+Z\nframe\n");
    const Json undone = state(session);
    EXPECT_FALSE(undone["scene"].contains("transfers"));
    EXPECT_EQ(undone["selection"]["node"], "");
    EXPECT_EQ(undone["redo"].size(), 2u);
    EXPECT_TRUE(undone["messages"].empty());
}

TEST_F(AlgebraSessionTest, ShiftAOpensTheMenuAtTheMouse) {
    Session session(options);
    play(session,
         "move @view(0.3,0.3)\npress Shift+A\nframe 3\nclick @widget(\"Add/Transfers\")\nframe 3\n"
         "click @widget(\"Add/Transfers/Bend\")\nframe 3\n");
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Add bend"])"));
    play(session, "press Shift+A\nframe 3\npress Escape\nframe 3\n");
    EXPECT_EQ(state(session)["undo"].size(), 1u);
}

TEST_F(AlgebraSessionTest, AUsersFileStandsInTheMenuHasSlidersAndTellsItsMistakes) {
    writeRipple("z + height * sin(20 * x)", 0);
    Session session(options);
    play(session,
         "click @widget(\"Menu/Add\")\nclick @widget(\"Add/Transfers\")\nclick @widget(\"Add/Transfers/ripple\")\n"
         "frame 3\ndrag @widget(\"Inspector/Height\") to @widget(\"Inspector/Height\")+40,0\nframe\n");
    const Json added = state(session);
    EXPECT_EQ(added["undo"], Json::parse(R"(["Add ripple", "Change height"])"));
    EXPECT_EQ(added["scene"]["transfers"]["ripple"]["type"], Json::parse(R"({ "file": "ripple.stf" })"));
    EXPECT_GT(added["scene"]["transfers"]["ripple"]["height"], 0.1);

    writeRipple("z + height * * sin(20 * x)", 1);
    play(session, "frame 40\n");
    const Json broken = state(session);
    ASSERT_EQ(broken["messages"].size(), 1u);
    EXPECT_THAT(broken["messages"][0].get<std::string>(), HasSubstr("ripple.stf"));
    EXPECT_THAT(broken["messages"][0].get<std::string>(), HasSubstr("^"));
    // The last good version is still there to work with.
    play(session,
         "drag @widget(\"Inspector/Height\") to @widget(\"Inspector/Height\")+20,0\nframe 3\n"
         "click @widget(\"Inspector/Mistake\")\n");
    EXPECT_EQ(state(session)["undo"].size(), 3u);

    writeRipple("z + 2 * height * sin(20 * x)", 2);
    play(session, "do transfers.reload\nframe 3\n");
    const Json mended = state(session);
    EXPECT_THAT(mended["messages"].back().get<std::string>(), HasSubstr("again"));
    EXPECT_FALSE(session.editor().workspace().compiled.root == nullptr);
}

TEST_F(AlgebraSessionTest, AFormulaFileFromElsewhereIsChosenInADialog) {
    fs::create_directory(folder / "mine");
    writeRipple("z + height * x", 0);
    fs::rename(folder / "ripple.stf", folder / "mine" / "ripple.stf");
    Session session(options);
    play(session, "do transfer.add-file\nframe 3\ntext \"" + (folder / "mine" / "ripple.stf").string() +
                      "\"\npress Enter\nframe 3\n");
    EXPECT_EQ(state(session)["scene"]["transfers"]["ripple"]["type"]["file"], "mine/ripple.stf");
    play(session,
         "click @widget(\"Menu/Add\")\nclick @widget(\"Add/Transfers\")\n"
         "click @widget(\"Add/Transfers/ripple\")\nframe 3\n");
    EXPECT_EQ(state(session)["scene"]["transfers"].size(), 2u);
}

TEST_F(AlgebraSessionTest, WhatWasBuiltIsSavedAndOpensAgain) {
    writeRipple("z + height * sin(20 * x)", 0);
    const std::string saved = (folder / "built.voledit").string();
    Json before;
    {
        Session session(options);
        play(session, "do transfer.add twist\ndo transfer.add-file " + (folder / "ripple.stf").string() +
                          "\ndo node.select /root\ndo object.combine difference box\ndo node.rename hole\n"
                          "do file.save-as " +
                          saved + "\n");
        before = state(session);
    }
    options.file = saved;
    Session session(options);
    const Json after = state(session);
    EXPECT_EQ(after["scene"], before["scene"]);
    EXPECT_TRUE(after["scene"]["objects"].contains("hole"));
    EXPECT_TRUE(after["messages"].empty());
}

TEST_F(AlgebraSessionTest, TheTreeIsWalkedAndCutByKeys) {
    Session session(options);
    play(session, "do transfer.add twist\ndo transfer.add bend\npress Up\npress H\nframe\n");
    EXPECT_EQ(state(session)["scene"]["transfers"]["twist"]["enabled"], false);
    play(session, "press Alt+Down\nframe\n");
    EXPECT_EQ(state(session)["scene"]["root"]["by"], Json::parse(R"([{ "use": "bend" }, { "use": "twist" }])"));
    play(session, "press F2\nframe 2\ntext \"turn\"\npress Enter\nframe 2\n");
    EXPECT_TRUE(state(session)["scene"]["transfers"].contains("turn"));
    play(session, "press X\nframe\npress Delete\nframe\n");
    const Json cut = state(session);
    EXPECT_FALSE(cut["scene"].contains("transfers"));
    EXPECT_EQ(cut["undo"].size(), 7u);
}

TEST_F(AlgebraSessionTest, SelectingAnotherNodeEndsWhatIsTyped) {
    Session session(options);
    const std::string opacity =
        "do node.select ball\nframe 2\nclick @widget(\"Inspector/Opacity formula\")\nframe 2\n"
        "click @widget(\"Inspector/Opacity\")\nframe\npress Ctrl+A\n";
    play(session, "do transfer.add twist\n" + opacity +
                      "text \"0.5 * (1 - r)\"\nframe\n"
                      "click @widget(\"Scene/twist\")\nframe 3\n");
    const Json right = state(session);
    EXPECT_EQ(right["scene"]["objects"]["ball"]["opacity"], "0.5 * (1 - r)");
    EXPECT_EQ(right["undo"], Json::parse(R"(["Add twist", "Change opacity", "Change opacity"])"));
    EXPECT_FALSE(session.editor().workspace().document.previewing());
    // What is wrong when it is left does not stay, nor what was right on the way to it.
    play(session,
         "do node.select ball\nframe 2\nclick @widget(\"Inspector/Opacity\")\nframe\npress Ctrl+A\n"
         "text \"0.5\"\nframe\ntext \" * nothing\"\nframe\nclick @widget(\"Scene/twist\")\nframe 3\n");
    EXPECT_EQ(state(session)["scene"], right["scene"]);
    EXPECT_EQ(state(session)["undo"], right["undo"]);
    EXPECT_FALSE(session.editor().workspace().document.previewing());
}

TEST_F(AlgebraSessionTest, TimeIsScrubbedOnlyWhereSomethingChangesOverIt) {
    {
        Session session(options);
        EXPECT_THROW(play(session, "click @widget(\"Timeline/Time\")\n"), Error);
    }
    std::ofstream(options.file) << R"({ "voledit": 1, "timeline": { "fps": 10, "start": 0, "end": 21 },
        "root": { "type": "solid", "shape": { "sphere": { "center": [0,0,0],
                  "radius": { "keys": [[0, 1], [2, 3]] } } }, "color": [1,1,1], "opacity": 1 } })";
    Session session(options);
    play(session, "do timeline.goto 1\nframe\n");
    EXPECT_EQ(state(session)["time"], 1);
    EXPECT_EQ(session.editor().workspace().compiled.root->bounds, (Box3{Vec3(-2), Vec3(2)}));
    play(session, "click @widget(\"Timeline/Time\")\npress Escape\nframe\n");  // a field to type in, left again
    EXPECT_EQ(state(session)["time"], 1);
    play(session, "do timeline.end\nframe\n");
    EXPECT_EQ(state(session)["time"], 2);
    play(session, "do timeline.start\nframe\n");
    EXPECT_EQ(state(session)["time"], 0);
    EXPECT_TRUE(state(session)["undo"].empty());
}

}  // namespace
}  // namespace voledit
