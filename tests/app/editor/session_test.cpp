// Whole sessions of the editor, headless: what a user does, from events to what is saved.
#include "app/editor/session.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/editor/run_editor.h"
#include "app/editor/state_json.h"
#include "core/base/error.h"
#include "core/io/io_client.h"
#include "core/scene/node_edits.h"
#include "render/term_program.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

// A ball in 24³ voxels, 2 mm apart.
fs::path writeBall(const fs::path& folder, const std::string& name = "ball.nrrd") {
    const fs::path path = folder / name;
    std::ofstream file(path, std::ios::binary);
    file << "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 24 24 24\nspacings: 2 2 2\nencoding: raw\n\n";
    for (int n = 0; n < 24 * 24 * 24; ++n) {
        const Vec3 d = Vec3(n % 24, n / 24 % 24, n / 576) - 11.5;
        file.put(char(std::max(0.0, 255 - 2.2 * (d.x * d.x + d.y * d.y + d.z * d.z))));
    }
    return path;
}

std::string textOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

struct SessionTest : testing::Test {
    fs::path folder = test::scratchFolder();
    EditorOptions options;

    SessionTest() { options.headless = true; }

    void play(Session& session, const std::string& events) {
        replay(parseEvents(events, "test.ev"), "test.ev", session);
    }
    Json state(Session& session) { return Json::parse(stateJson(session.editor())); }
    // The viewport's part of a screenshot.
    Picture shownIn(Session& session, const std::string& screenshot) {
        const Workspace& workspace = session.editor().workspace();
        IoClient io;
        const Picture window = io.readPicture(screenshot);
        Picture shown(workspace.viewSize);
        for (int y = 0; y < shown.size.y; ++y)
            for (int x = 0; x < shown.size.x; ++x)
                shown.at(x, y) = window.at(workspace.viewOrigin.x + x, workspace.viewOrigin.y + y);
        return shown;
    }
    // What `voledit render` gives.
    Picture rendered(const std::string& scene, Index2 size, const std::string& renderer) {
        const std::string picture = (folder / "rendered.png").string();
        const auto result = test::run("voledit", {"render", scene, "-o", picture, "--renderer", renderer, "--size",
                                                  std::to_string(size.x) + "x" + std::to_string(size.y)});
        EXPECT_EQ(result.status, 0) << result.err;
        IoClient io;
        return io.readPicture(picture);
    }
    std::string problemOf(Session& session, const std::string& events) {
        try {
            play(session, events);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(SessionTest, OpensByMenuBendsUndoesRedoesAndSaves) {
    const fs::path ball = writeBall(folder);
    Session session(options);
    const std::string scene = (folder / "bent.voledit").string();
    play(session, "click @widget(\"Menu/File\")\nclick @widget(\"File/Open…\")\ntext \"" + ball.string() +
                      "\"\npress Enter\nwait idle\n"
                      "click @widget(\"Menu/Lattice\")\nclick @widget(\"Lattice/Add Lattice\")\n"
                      "drag @point(lattice,3,0,3) to @point(lattice,3,0,3)+30,-20\n"
                      "drag @point(lattice,0,0,3) to @point(lattice,0,0,3)+-30,-10\n");
    const Json moved = state(session);
    EXPECT_EQ(moved["undo"], Json::parse(R"(["Add lattice", "Move control point", "Move control point"])"));
    EXPECT_EQ(moved["selection"]["points"], Json::parse("[[0, 0, 3]]"));
    EXPECT_EQ(moved["renderer"], "slices");
    EXPECT_TRUE(moved["modified"]);
    EXPECT_FALSE(moved.contains("frame_ms"));

    play(session, "press Ctrl+Z\n");
    const Json undone = state(session);
    EXPECT_EQ(undone["undo"].size(), 2u);
    EXPECT_EQ(undone["redo"], Json::parse(R"(["Move control point"])"));
    EXPECT_EQ(undone["scene"]["transfers"]["lattice"]["move"].size(), 1u);

    play(session, "press Ctrl+Shift+Z\ndo file.save-as " + scene + "\n");
    const Json saved = state(session);
    EXPECT_EQ(saved["scene"], moved["scene"]);
    EXPECT_FALSE(saved["modified"]);
    EXPECT_EQ(Json::parse(textOf(scene)), saved["scene"]);
    EXPECT_EQ(saved["scene"]["assets"]["ball"]["path"], "ball.nrrd");
}

TEST_F(SessionTest, SavedScenesOpenAsTheyWere) {
    options.file = writeBall(folder);
    const std::string scene = (folder / "bent.voledit").string();
    Json before;
    {
        Session session(options);
        play(session,
             "do lattice.add\ndrag @point(lattice,3,3,3) to +10,20\ndrag @view(0.1,0.9) to +90,-40\ndo file.save-as " +
                 scene);
        before = state(session);
    }
    options.file = scene;
    Session session(options);
    EXPECT_EQ(state(session)["scene"], before["scene"]);
    EXPECT_FALSE(state(session)["modified"]);
    EXPECT_TRUE(state(session)["undo"].empty());
}

// What `voledit render` draws of the saved scene at the viewport's size is the viewport, once overlays are off; also
// right after saving, when notices are up.
TEST_F(SessionTest, BareViewportIsThePictureThatRenderGives) {
    options.file = writeBall(folder);
    options.size = Index2(900, 600);
    Session session(options);
    const std::string scene = (folder / "bent.voledit").string(), window = (folder / "window.png").string();
    play(session, "do lattice.add\ndrag @point(lattice,3,3,3) to +40,20\ndo file.save-as " + scene +
                      "\ndo view.overlays off\nwait idle\nscreenshot " + window);
    const Picture shown = shownIn(session, window), wanted = rendered(scene, shown.size, "slices");
    EXPECT_GE(psnr(shown, wanted), 50);
    EXPECT_LT(psnr(shown, Picture(shown.size)), 40) << "the picture is empty";
}

// Neither what moves nor what is explained stands over a bare viewport.
TEST_F(SessionTest, NothingIsDrawnOverABareViewport) {
    options.file = writeBall(folder);
    options.size = Index2(560, 600);
    Session session(options);
    const auto picture = [&](const std::string& events) {
        const std::string window = (folder / "window.png").string();
        play(session, events + "\nframe 40\nscreenshot " + window);
        return shownIn(session, window);
    };
    play(session, "do lattice.add\ndo view.overlays off\nmove @view(0.5,0.02)\n");
    const Picture bare = picture("frame");
    EXPECT_EQ(psnr(picture("move @widget(\"Lattice/Cells x\")"), bare), kInfinity) << "a tooltip";
    EXPECT_EQ(psnr(picture("hold Ctrl\nmove @view(0.1,0.1)\ndown left\nframe\nmove @view(0.9,0.9)"), bare), kInfinity)
        << "a box";
    play(session, "up left\nrelease Ctrl\nframe\n");
    const Picture again = picture("do select.points 3,3,3\nmove @view(0.5,0.5)\nframe\npress G");
    EXPECT_EQ(psnr(again, bare), kInfinity) << "a readout";
}

TEST_F(SessionTest, UndoLetsGoOfWhatIsHeld) {
    options.file = writeBall(folder);
    Session session(options);
    play(session, "do lattice.add\ndo lattice.enable off\ndo lattice.enable on\n");
    const Json before = state(session)["scene"];
    for (const std::string grabbed : {"@widget(\"Appearance/Opacity point 2\")", "@point(lattice,3,0,3)"})
        for (const std::string pull : {"", "move +0,-30\nframe\n"}) {
            const fs::path undone = folder / "undone.json";
            play(session, "move " + grabbed + "\nframe\ndown left\nframe\n" + pull + "do edit.undo\nstate " +
                              undone.string() + "\nmove +0,-40\nframe\nmove +5,0\nframe\nup left\nframe\n");
            const Json after = state(session);
            EXPECT_EQ(after["undo"].size(), 2u);
            EXPECT_EQ(after["scene"], Json::parse(textOf(undone))["scene"]) << grabbed << " " << pull;
            EXPECT_EQ(after["redo"], Json::parse(R"(["Enable lattice"])"));
            play(session, "do edit.redo\n");
            EXPECT_EQ(state(session)["scene"], before);
        }
}

TEST_F(SessionTest, AWidgetScrolledOutOfSightIsBroughtBack) {
    options.file = writeBall(folder);
    options.size = Index2(900, 420);
    Session session(options);
    play(session, "do lattice.add\nframe\n");
    const Vec2 low = session.locate({.kind = Place::Kind::Widget, .name = "appearance/Opacity distance"});
    EXPECT_LT(low.y, 420 - 26);
    const Vec2 top = session.locate({.kind = Place::Kind::Widget, .name = "Scene/Add"});
    EXPECT_GT(top.y, 30);
    play(session, "click @widget(\"Scene/Show lattice\")\n");
    EXPECT_EQ(state(session)["undo"].size(), 2u);
}

// Terms too deep for a shader have no slices: rays draw them, and slices come back when the last layer goes.
TEST_F(SessionTest, RaysDrawWhatSlicesCannot) {
    options.file = writeBall(folder);
    options.size = Index2(480, 320);
    Session session(options);
    const std::string scene = (folder / "s.voledit").string(), window = (folder / "window.png").string();
    play(session, "wait idle\n");
    EXPECT_EQ(state(session)["renderer"], "slices");
    session.editor().workspace().document.apply("Add layers", [](Scene& deep) {
        for (int n = 0; n <= kDeepestTermProgram; ++n) {
            RecolorObject layer;
            layer.opacity = Tracked<PiecewiseLinear>(PiecewiseLinear{{{0, 0}, {1, 1}}});
            wrapObject(deep, kRootPath, Object{layer});
        }
    });
    play(session, "wait idle\n");
    EXPECT_EQ(state(session)["renderer"], "rays");
    ASSERT_EQ(state(session)["messages"].size(), 1u);
    EXPECT_THAT(state(session)["messages"][0].get<std::string>(), HasSubstr("rays on the CPU draw it"));
    EXPECT_THAT(state(session)["messages"][0].get<std::string>(), testing::Not(HasSubstr("--renderer")));

    play(session, "do file.save-as " + scene + "\ndo view.overlays off\nscreenshot " + window);
    const Picture shown = shownIn(session, window);
    EXPECT_GE(psnr(shown, rendered(scene, shown.size, "rays")), 50);
    EXPECT_EQ(state(session)["renderer"], "rays");
    EXPECT_EQ(state(session)["messages"].size(), 2u) << "told once, and that it was saved";

    play(session, "do edit.undo\nwait idle\n");
    EXPECT_EQ(state(session)["renderer"], "slices");
    play(session, "do view.renderer rays\nframe\n");
    EXPECT_EQ(state(session)["renderer"], "rays");
}

TEST_F(SessionTest, FilesOutsideTheFolderAreOpenedOnlyWhenAllowed) {
    const fs::path ball = writeBall(folder), elsewhere = folder / "scenes";
    fs::create_directory(elsewhere);
    const fs::path scene = elsewhere / "far.voledit";
    std::ofstream(scene) << R"({"voledit": 1, "assets": {"ball": {"kind": "volume", "path": "../ball.nrrd"}},
                                "root": {"type": "volume", "asset": "ball"}})";
    options.file = writeBall(folder, "first.nrrd");
    Session session(options);
    play(session,
         "do file.open " + scene.string() + "\nwait idle\nclick @widget(\"Files outside the folder/Cancel\")\n");
    EXPECT_TRUE(state(session)["scene"]["assets"].contains("first"));
    play(session, "do file.open " + scene.string() +
                      "\nwait idle\nclick @widget(\"Files outside the folder/Open anyway\")\nwait idle\n");
    EXPECT_TRUE(state(session)["scene"]["assets"].contains("ball"));
}

TEST_F(SessionTest, NavigatingIsNoUndoStepButIsSaved) {
    options.file = writeBall(folder);
    Session session(options);
    const Json before = state(session);
    play(session, "drag @view(0.5,0.1) to @view(0.7,0.2)\n");
    const Json after = state(session);
    EXPECT_NE(before["scene"]["camera"], after["scene"]["camera"]);
    EXPECT_TRUE(after["undo"].empty());
    EXPECT_FALSE(after["modified"]);
    play(session, "do view.front\ndo view.frame\n");
    const Json camera = state(session)["scene"]["camera"];
    EXPECT_LT(camera["eye"][1].get<double>(), camera["target"][1].get<double>());
    EXPECT_NEAR(camera["eye"][0].get<double>(), camera["target"][0].get<double>(), 1e-9);
}

TEST_F(SessionTest, TheSameEventsGiveTheSamePicture) {
    options.file = writeBall(folder);
    options.size = Index2(640, 420);
    const std::string events = "do lattice.add\ndrag @point(lattice,3,0,3) to +30,-20\nscreenshot ";
    std::vector<std::string> pictures;
    for (const char* name : {"a.png", "b.png"}) {
        Session session(options);
        play(session, events + (folder / name).string());
        pictures.push_back(textOf(folder / name));
    }
    EXPECT_FALSE(pictures[0].empty());
    EXPECT_TRUE(pictures[0] == pictures[1]);
}

TEST_F(SessionTest, RecordingReplaysToTheSameState) {
    options.file = writeBall(folder);
    options.record = folder / "rec.ev";
    Json recorded;
    {
        Session session(options);
        play(session,
             "press Ctrl+L\ndrag @point(lattice,3,0,3) to +30,-20\npress A\npress G\nmove @view(0.4,0.4)\nframe\n"
             "move @view(0.45,0.42)\nframe\npress Enter\nwheel 2\nframe 3\npress Ctrl+Z\ndo view.right\n");
        recorded = state(session);
    }
    EXPECT_EQ(recorded["undo"].size(), 2u);
    options.record.clear();
    Session session(options);
    play(session, textOf(folder / "rec.ev"));
    EXPECT_EQ(state(session), recorded);
}

TEST_F(SessionTest, ADroppedFileIsOpened) {
    const fs::path ball = writeBall(folder);
    Session session(options);
    play(session, "drop " + ball.string() + "\nframe\nwait idle\n");
    EXPECT_TRUE(state(session)["scene"]["objects"].contains("ball"));
}

TEST_F(SessionTest, EscapeStopsOpeningAndNothingIsLost) {
    options.file = writeBall(folder);
    writeBall(folder, "other.nrrd");
    Session session(options);
    play(session, "do lattice.add\ndo file.save-as " + (folder / "s.voledit").string() + "\n");
    const Json before = state(session);
    session.editor().act("file.open", (folder / "other.nrrd").string());
    session.editor().frame({.events = {InputEvent::stroke(Key::Escape, true)}});
    play(session, "wait idle\n");
    const Json after = state(session);
    EXPECT_EQ(after["scene"], before["scene"]);
    EXPECT_THAT(after["messages"].back().get<std::string>(), HasSubstr("cancelled"));
}

TEST_F(SessionTest, AFileThatCannotBeReadBecomesANotice) {
    options.file = writeBall(folder);
    std::ofstream(folder / "broken.nrrd") << "NRRD0004\ntype: unsigned char\nsizes: 9 9";
    Session session(options);
    const Json before = state(session);
    play(session, "do file.open " + (folder / "broken.nrrd").string() + "\nwait idle\n");
    const Json after = state(session);
    EXPECT_EQ(after["scene"], before["scene"]);
    ASSERT_EQ(after["messages"].size(), 1u);
    EXPECT_THAT(after["messages"][0].get<std::string>(), HasSubstr("broken.nrrd"));
    play(session, "click @widget(\"Notice/Close\")\n");
    EXPECT_THAT(problemOf(session, "click @widget(\"Notice/Close\")"), HasSubstr("there is no widget"));
}

TEST_F(SessionTest, UnsavedChangesAskFirst) {
    options.file = writeBall(folder);
    const std::string other = writeBall(folder, "other.nrrd").string(), open = "do file.open " + other + "\n";
    Session session(options);
    play(session, "do lattice.add\n" + open + "click @widget(\"Unsaved changes/Cancel\")\nwait idle\n");
    EXPECT_TRUE(state(session)["scene"]["objects"].contains("ball"));
    play(session, open + "press Escape\nwait idle\n");
    EXPECT_TRUE(state(session)["scene"]["objects"].contains("ball"));
    // Save: asks for a name first, then goes on.
    play(session, open + "click @widget(\"Unsaved changes/Save\")\ntext \"" + (folder / "kept").string() +
                      "\"\npress Enter\nwait idle\n");
    EXPECT_TRUE(fs::exists(folder / "kept.voledit"));
    EXPECT_TRUE(state(session)["scene"]["objects"].contains("other"));
    play(session, "do lattice.add\ndo file.open " + (folder / "ball.nrrd").string() +
                      "\nclick @widget(\"Unsaved changes/Discard\")\nwait idle\n");
    EXPECT_TRUE(state(session)["scene"]["objects"].contains("ball"));
    play(session, "do lattice.add\npress Ctrl+Q\n");
    EXPECT_FALSE(session.closed());
    play(session, "click @widget(\"Unsaved changes/Discard\")\n");
    EXPECT_TRUE(session.closed());
}

TEST_F(SessionTest, SavingOverAFileAsks) {
    options.file = writeBall(folder);
    const fs::path scene = folder / "s.voledit";
    std::ofstream(scene) << "mine";
    Session session(options);
    const std::string save = "press Ctrl+Shift+S\ntext \"" + scene.string() + "\"\npress Enter\n";
    play(session, save + "click @widget(\"Save as/Replace/Keep\")\n");
    EXPECT_EQ(textOf(scene), "mine");
    play(session, "press Escape\n" + save + "click @widget(\"Save as/Replace/Replace\")\n");
    EXPECT_THAT(textOf(scene), HasSubstr("\"voledit\""));
}

TEST_F(SessionTest, PlacesThatAreNotThereAreErrorsWithTheirLine) {
    options.file = writeBall(folder);
    Session session(options);
    for (const auto& [line, why] : {std::pair{"click 1280,20", "not on the screen"},
                                    {"move -1,5", "not on the screen"},
                                    {"click @view(1.2,0)", "not on the screen"},
                                    {"click @point(none,0,0,0)", "no such control point"},
                                    {"click @joint(Hips)", "no actor"},
                                    {"click @key(a,1)", "nothing of that name has keys"},
                                    {"click @widget(\"Nowhere/Nothing\")", "no widget"},
                                    {"do no.thing", "no action"},
                                    {"do edit.redo", "cannot be used now"},
                                    {"do view.overlays maybe", "on or off"}}) {
        const std::string problem = problemOf(session, std::string("frame\n") + line);
        EXPECT_THAT(problem, testing::StartsWith("test.ev:2: "));
        EXPECT_THAT(problem, HasSubstr(why));
    }
    play(session, "do lattice.add\n");
    EXPECT_THAT(problemOf(session, "click @point(lattice,4,0,0)"), HasSubstr("no such control point"));
    play(session, "click @view(1,1)\nclick @view(0,0)\n");
}

TEST_F(SessionTest, AMisspeltWidgetIsToldWhatThereIs) {
    options.file = writeBall(folder);
    Session session(options);
    EXPECT_THAT(problemOf(session, "click @widget(\"Menu/Fil\")"), HasSubstr("Menu/File"));
}

TEST_F(SessionTest, RunGivesTheExitStatus) {
    options.file = writeBall(folder);
    options.play = folder / "ok.ev";
    std::ofstream(options.play) << "do lattice.add\nstate " << (folder / "s.json").string() << "\n";
    EXPECT_EQ(runEditor(options), 0);
    EXPECT_EQ(Json::parse(textOf(folder / "s.json"))["undo"].size(), 1u);
    std::ofstream(options.play) << "do no.thing\n";
    EXPECT_EQ(runEditor(options), 1);
    std::ofstream(options.play) << "jump\n";
    EXPECT_THROW(runEditor(options), Error);
    options.play.clear();
    options.file = folder / "missing.nrrd";
    EXPECT_THROW(runEditor(options), Error);
}

TEST_F(SessionTest, EveryScaleFitsItsWidgets) {
    options.file = writeBall(folder);
    options.size = Index2(2560, 1600);
    options.scale = 2;
    Session session(options);
    play(session,
         "do lattice.add\nclick @widget(\"Menu/View\")\nclick @widget(\"View/Overlays\")\ndo view.scale 1\nframe 3\n"
         "click @widget(\"Menu/View\")\nclick @widget(\"View/Top\")\n");
    EXPECT_FALSE(session.editor().workspace().overlays);
    EXPECT_EQ(session.editor().workspace().scale, 1);
}

}  // namespace
}  // namespace voledit
