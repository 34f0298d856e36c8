// Sessions in time: playing, keys put and moved by mouse and keyboard, all from event files.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/editor/session.h"
#include "app/editor/state_json.h"
#include "core/base/error.h"
#include "core/scene/keys.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

constexpr const char* kScene = R"({ "voledit": 1, "timeline": { "fps": 10, "start": 0, "end": 20 },
  "transfers": {
    "turn": { "type": "twist", "axis": "z", "angle": { "keys": [[0, 0], [0.5, 20], [1, 90]] },
              "frame": { "min": [-1,-1,-1], "max": [1,1,1] } },
    "pull": { "type": "ffd", "degree": [3,3,3], "frame": { "min": [-1,-1,-1], "max": [1,1,1] },
              "move": [{ "point": [3,3,3], "by": { "keys": [[0, [0,0,0]], [1, [0.5,0,0]]] } }] } },
  "root": { "type": "transfer", "by": [{ "use": "turn" }, { "use": "pull" }],
            "of": { "type": "solid", "shape": { "sphere": { "center": [0,0,0], "radius": 1 } },
                    "color": [0.9, 0.7, 0.4], "opacity": 0.8 } } })";
constexpr const char* kAngle = "/transfers/turn/angle";

struct TimelineSessionTest : testing::Test {
    fs::path folder = test::scratchFolder();
    EditorOptions options;

    TimelineSessionTest() {
        options.headless = true;
        options.file = folder / "keys.voledit";
        std::ofstream(options.file) << kScene;
    }
    void play(Session& session, const std::string& events) {
        replay(parseEvents(events, "test.ev"), "test.ev", session);
    }
    Json state(Session& session) { return Json::parse(stateJson(session.editor())); }
    std::vector<double> times(Session& session, const std::string& path = kAngle) {
        std::vector<double> times;
        for (const KeyMark& mark : keysOf(session.editor().workspace().document.scene(), path))
            times.push_back(std::round(mark.time * 1e6) / 1e6);
        return times;
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

using Times = std::vector<double>;

TEST_F(TimelineSessionTest, PlaysByFramesOfASixtiethAndIsNoStep) {
    Session session(options);
    play(session, "press Space\nframe 30\n");
    EXPECT_TRUE(state(session)["playing"].get<bool>());
    const int frame = state(session)["frame"];
    EXPECT_GE(frame, 5);
    EXPECT_LE(frame, 6);
    // What is shown is compiled for that very time.
    EXPECT_EQ(session.editor().workspace().compiled.time, session.editor().workspace().time);
    play(session, "frame 120\n");  // once round
    const int again = state(session)["frame"];
    EXPECT_EQ(again, frame);
    play(session, "press Space\n");
    const double time = state(session)["time"];
    play(session, "frame 30\n");
    EXPECT_EQ(state(session)["time"], time);
    EXPECT_FALSE(state(session)["playing"].get<bool>());
    EXPECT_TRUE(state(session)["undo"].empty());
    EXPECT_FALSE(state(session)["modified"].get<bool>());
}

TEST_F(TimelineSessionTest, WithoutLoopItStopsAtTheEnd) {
    Session session(options);
    play(session, "do timeline.loop off\ndo timeline.frame 15\ndo timeline.play\nframe 60\n");
    EXPECT_EQ(state(session)["frame"], 19);
    EXPECT_FALSE(state(session)["playing"].get<bool>());
}

TEST_F(TimelineSessionTest, EditingGoesOnWhileItPlays) {
    Session session(options);
    play(session, "do timeline.play\nframe 5\ndo transfer.add bend\nframe 5\npress Ctrl+Z\nframe 5\n");
    EXPECT_TRUE(state(session)["playing"].get<bool>());
    EXPECT_TRUE(state(session)["undo"].empty());
    EXPECT_EQ(state(session)["redo"].size(), 1u);
}

TEST_F(TimelineSessionTest, StepsJumpsAndGoesFromKeyToKey) {
    Session session(options);
    play(session, "move @view(0.5,0.1)\npress Right\npress Right\n");
    EXPECT_EQ(state(session)["frame"], 2);
    play(session, "press Left\n");
    EXPECT_EQ(state(session)["frame"], 1);
    play(session, "press Up\n");
    EXPECT_EQ(state(session)["time"], 0.5);
    play(session, "press Up\npress Up\n");  // stays at the last
    EXPECT_EQ(state(session)["time"], 1);
    play(session, "press Down\n");
    EXPECT_EQ(state(session)["time"], 0.5);
    play(session, "press Shift+Right\n");
    EXPECT_EQ(state(session)["frame"], 19);
    play(session, "press Shift+Left\n");
    EXPECT_EQ(state(session)["frame"], 0);
    play(session, "do timeline.step 7\ndo timeline.step -2\n");
    EXPECT_EQ(state(session)["frame"], 5);
    EXPECT_THAT(problemOf(session, "do timeline.frame 1.5\n"), HasSubstr("whole"));
    EXPECT_THAT(problemOf(session, "do timeline.goto soon\n"), HasSubstr("timeline.goto"));
}

TEST_F(TimelineSessionTest, ArrowsWalkTheTreeOverThePanels) {
    Session session(options);
    play(session, "move @widget(\"Scene/turn\")\nframe\npress Down\nframe\npress Down\nframe\n");
    EXPECT_NE(state(session)["selection"]["node"], "");
    EXPECT_EQ(state(session)["frame"], 0);
}

TEST_F(TimelineSessionTest, TheRulerIsScrubbed) {
    Session session(options);
    play(session, "drag @widget(\"Timeline/Ruler\") to @widget(\"Timeline/Ruler\")+0,2\nframe\n");
    const double fps = 10, time = state(session)["time"];
    EXPECT_NEAR(time * fps, std::round(time * fps), 1e-9);
    EXPECT_NEAR(time, 1, 0.11);  // the middle of the range
    EXPECT_TRUE(state(session)["undo"].empty());
}

TEST_F(TimelineSessionTest, TheRangeIsAStep) {
    Session session(options);
    play(session, "do timeline.range 2 12 25\nframe\n");
    EXPECT_EQ(state(session)["scene"]["timeline"], Json::parse(R"({ "fps": 25, "start": 2, "end": 12 })"));
    play(session, "press Ctrl+Z\nframe\n");
    EXPECT_EQ(state(session)["scene"]["timeline"]["end"], 20);
    EXPECT_THAT(problemOf(session, "do timeline.range 8 3\n"), HasSubstr("before it starts"));
    play(session, "doubleclick @widget(\"Timeline/End\")\npress Ctrl+A\ntext \"30\"\npress Enter\nframe\n");
    EXPECT_EQ(state(session)["scene"]["timeline"]["end"], 30);
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Change timeline"])"));
}

TEST_F(TimelineSessionTest, AKeyIsClickedDraggedAndTakenBack) {
    Session session(options);
    play(session, "click @key(turn/angle,1)\nframe\n");
    EXPECT_EQ(state(session)["keys"], Json::parse(R"([{ "path": "/transfers/turn/angle", "time": 0.5 }])"));
    // To where the next key stands, and three frames beyond: 0.5 → 0.8 needs the pixels of 0.3 s.
    const Vec2 from = session.locate(parsePlace("@key(angle,1)")), next = session.locate(parsePlace("@key(angle,2)"));
    const double pixelsPerFrame = (next.x - from.x) / 5;
    play(session, "drag @key(angle,1) to @key(angle,1)+" + std::to_string(3.2 * pixelsPerFrame) + ",0\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.8, 1}));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Move key"])"));
    EXPECT_NEAR(state(session)["keys"][0]["time"].get<double>(), 0.8, 1e-9);
    play(session, "press Ctrl+Z\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.5, 1}));
    EXPECT_TRUE(state(session)["keys"].empty());  // what was selected is gone
}

TEST_F(TimelineSessionTest, CtrlDragCopiesEscapeRestoresDeleteRemoves) {
    Session session(options);
    const Vec2 a = session.locate(parsePlace("@key(angle,0)")), b = session.locate(parsePlace("@key(angle,1)"));
    const std::string three = std::to_string((b.x - a.x) * 3 / 5);
    play(session, "hold Ctrl\ndrag @key(angle,0) to @key(angle,0)+" + three + ",0\nrelease Ctrl\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.3, 0.5, 1}));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Copy key"])"));
    play(session, "move @key(angle,0)\ndown left\nmove +" + three + ",0\nframe\npress Escape\nup left\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.3, 0.5, 1}));
    play(session, "click @key(angle,1)\nhold Shift\nclick @key(angle,3)\nrelease Shift\nframe\n");
    EXPECT_EQ(state(session)["keys"].size(), 2u);
    play(session, "press Delete\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.5}));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Copy key", "Delete 2 keys"])"));
}

TEST_F(TimelineSessionTest, GrabAndDuplicateFollowTheMouseUntilAClick) {
    Session session(options);
    const Vec2 a = session.locate(parsePlace("@key(angle,0)")), b = session.locate(parsePlace("@key(angle,1)"));
    const std::string two = std::to_string((b.x - a.x) * 2 / 5);
    play(session, "click @key(angle,1)\npress G\nmove +" + two + ",0\nframe\npress Enter\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.7, 1}));
    play(session, "press Shift+D\nmove +" + two + ",0\nframe\nclick +" + two + ",0\nframe\n");
    EXPECT_EQ(times(session).size(), 4u);
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Move key", "Copy key"])"));
}

TEST_F(TimelineSessionTest, ABoxSelectsKeysOfSeveralRows) {
    Session session(options);
    play(session, "drag @key(angle,1)+-9,-9 to @key(angle,2)+9,9\nframe\n");
    EXPECT_EQ(state(session)["keys"].size(), 2u);
    play(session, "click @key(angle,1)+-14,0\nframe\n");
    EXPECT_TRUE(state(session)["keys"].empty());
}

TEST_F(TimelineSessionTest, ActionsMoveCopyAndInterpolate) {
    Session session(options);
    play(session, "do key.select turn/angle 2\ndo key.move 0.25\n");
    EXPECT_EQ(times(session), (Times{0, 0.5, 1.25}));
    play(session, "do key.copy 0.5\n");
    EXPECT_EQ(times(session), (Times{0, 0.5, 1.25, 1.75}));
    play(session, "do key.select angle 0\ndo key.interpolation step\n");
    EXPECT_EQ(keysOf(session.editor().workspace().document.scene(), kAngle)[0].interpolation,
              Track::Interpolation::Step);
    EXPECT_EQ(numbersAt(session.editor().workspace().document.scene(), kAngle, 0.4)[0], 0);
    EXPECT_THAT(problemOf(session, "do key.interpolation wobbly\n"), HasSubstr("step, linear or smooth"));
    EXPECT_THAT(problemOf(session, "do key.select nothing\n"), HasSubstr("no keys"));
    EXPECT_THAT(problemOf(session, "do key.select angle 9\n"), HasSubstr("counted from 0"));
    play(session, "do key.delete\n");
    EXPECT_EQ(times(session), (Times{0.5, 1.25, 1.75}));
    play(session, "do key.clear turn/angle\nframe\n");
    EXPECT_TRUE(times(session).empty());
}

TEST_F(TimelineSessionTest, IOverAFieldInsertsAKeyAndAltITakesIt) {
    Session session(options);
    play(session,
         "do node.select turn\nframe 2\ndo timeline.frame 7\nmove @widget(\"Inspector/Angle\")\npress I\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.5, 0.7, 1}));
    EXPECT_NEAR(numbersAt(session.editor().workspace().document.scene(), kAngle, 0.7)[0], 48, 1e-9);
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Insert key"])"));
    play(session, "press Alt+I\nframe\n");
    EXPECT_EQ(times(session), (Times{0, 0.5, 1}));
    // A value without keys, and one that the file leaves out.
    play(session,
         "move @widget(\"Inspector/Amount\")\npress I\nframe 2\nmove @widget(\"Inspector/At\")\npress I\nframe 2\n");
    EXPECT_EQ(times(session, "/transfers/turn/amount"), (Times{0.7}));
    EXPECT_EQ(times(session, "/transfers/turn/at"), (Times{0.7}));
}

TEST_F(TimelineSessionTest, TheMenuOfAFieldHasItsKeys) {
    Session session(options);
    play(session,
         "do node.select turn\nframe 2\nmove @widget(\"Inspector/Angle\")\ndown right\nup right\nframe 3\n"
         "click @widget(\"Inspector/Angle/Next key\")\nframe 2\n");
    EXPECT_EQ(state(session)["time"], 0.5);
    play(session,
         "move @widget(\"Inspector/Angle\")\ndown right\nup right\nframe 3\n"
         "click @widget(\"Inspector/Angle/Clear keys\")\nframe 2\n");
    EXPECT_TRUE(times(session).empty());
    EXPECT_EQ(state(session)["scene"]["transfers"]["turn"]["angle"], 20);
}

TEST_F(TimelineSessionTest, IInTheViewKeysTheSelectedPoints) {
    Session session(options);
    play(session,
         "do node.select pull\nframe 2\ndo select.points 3,3,3 0,0,0\ndo timeline.frame 5\n"
         "move @view(0.05,0.05)\npress I\nframe 2\n");
    EXPECT_EQ(times(session, "/transfers/pull/move/63/by"), (Times{0, 0.5, 1}));
    EXPECT_EQ(times(session, "/transfers/pull/move/0/by"), (Times{0.5}));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Insert 2 keys"])"));
}

TEST_F(TimelineSessionTest, MovingAnAnimatedPointSetsItsKeyAndLeavesTheOthers) {
    Session session(options);
    play(session,
         "do node.select pull\nframe 2\ndo timeline.frame 5\ndo select.points 3,3,3\ndo lattice.move 0,0,1\nframe\n");
    const Scene& scene = session.editor().workspace().document.scene();
    EXPECT_EQ(times(session, "/transfers/pull/move/63/by"), (Times{0, 0.5, 1}));
    EXPECT_EQ(numbersAt(scene, "/transfers/pull/move/63/by", 0.5), (std::vector<double>{0.25, 0, 1}));
    EXPECT_EQ(numbersAt(scene, "/transfers/pull/move/63/by", 1), (std::vector<double>{0.5, 0, 0}));
    // Without auto-key a point at rest moves for all times; with it, it gets a key.
    play(session, "do select.points 0,0,0\ndo lattice.move 0,0,-1\nframe\n");
    EXPECT_TRUE(times(session, "/transfers/pull/move/0/by").empty());
    play(session, "do key.auto on\ndo select.points 0,3,0\ndo lattice.move 0,0,-1\nframe\n");
    EXPECT_EQ(times(session, "/transfers/pull/move/12/by"), (Times{0.5}));
}

TEST_F(TimelineSessionTest, TheLatticeIsShownWhereItIsAtTheTime) {
    Session session(options);
    play(session, "do view.frame\nframe 2\n");
    const Vec2 before = session.locate(parsePlace("@point(pull,3,3,3)"));
    play(session, "do timeline.frame 10\nframe\n");
    const Vec2 after = session.locate(parsePlace("@point(pull,3,3,3)"));
    EXPECT_GT(after.x, before.x + 20);
}

TEST_F(TimelineSessionTest, ADoubleClickOnARowPutsAKey) {
    Session session(options);
    const Vec2 a = session.locate(parsePlace("@key(angle,0)")), b = session.locate(parsePlace("@key(angle,1)"));
    play(session, "doubleclick @key(angle,0)+" + std::to_string((b.x - a.x) * 2 / 5) + ",0\nframe 2\n");
    EXPECT_EQ(times(session), (Times{0, 0.2, 0.5, 1}));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Insert key"])"));
}

TEST_F(TimelineSessionTest, KeysOutOfSightAreBroughtIntoView) {
    Session session(options);
    play(session, "do key.select angle 2\ndo key.move 60\nframe\n");
    play(session, "click @key(angle,2)\nframe\n");
    EXPECT_NEAR(state(session)["keys"][0]["time"].get<double>(), 61, 1e-9);
    EXPECT_THAT(problemOf(session, "click @key(angle,3)\n"), HasSubstr("counted from 0"));
    EXPECT_THAT(problemOf(session, "click @key(nothing,0)\n"), HasSubstr("turn · angle"));
    EXPECT_THAT(problemOf(session, "do view.timeline off\nframe\nclick @key(angle,0)\n"), HasSubstr("view.timeline"));
}

TEST_F(TimelineSessionTest, TheTimelineIsShownWhereSomethingChangesOrWhereItIsWanted) {
    std::ofstream(options.file) << R"({ "voledit": 1, "root": { "type": "solid", "color": [1,1,1], "opacity": 1,
        "shape": { "sphere": { "center": [0,0,0], "radius": 1 } } } })";
    Session session(options);
    play(session, "frame\n");
    EXPECT_FALSE(session.editor().workspace().timeline.shown);
    const int height = session.editor().workspace().viewSize.y;
    play(session, "do view.timeline on\nframe\n");
    EXPECT_TRUE(session.editor().workspace().timeline.shown);
    EXPECT_LT(session.editor().workspace().viewSize.y, height);
    play(session,
         "do view.timeline off\nframe\ndo node.select /root\ndo key.insert /root/shape/sphere/radius\nframe 2\n");
    EXPECT_FALSE(session.editor().workspace().timeline.shown);  // the user's word holds
}

TEST_F(TimelineSessionTest, RecordingsOfPlayingEndAtTheSameTime) {
    options.record = folder / "played.ev";
    double time = 0;
    {
        Session session(options);
        play(session, "press Space\nframe 400\npress Space\nframe 3\n");
        time = state(session)["time"];
    }
    options.record.clear();
    Session again(options);
    replay(loadEvents(folder / "played.ev"), "played.ev", again);
    EXPECT_EQ(state(again)["time"], time);
    EXPECT_FALSE(state(again)["playing"].get<bool>());
}

}  // namespace
}  // namespace voledit
