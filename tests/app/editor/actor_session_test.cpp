// Sessions with actors: what a user does with rigs, motions, poses and joints.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/editor/session.h"
#include "app/editor/state_json.h"
#include "core/base/error.h"
#include "core/scene/keys.h"
#include "tests/app/editor/actor_rig.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A walk of the left arm alone: three frames at 10 Hz, 0°, 45° and 90° about y; the hips travel along x.
std::string bvhOf(const std::string& hips, const std::string& arm) {
    return "HIERARCHY\nROOT " + hips +
           "\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n  JOINT " +
           arm +
           "\n  {\n    OFFSET 0.4 0 1\n    CHANNELS 3 Zrotation Xrotation Yrotation\n    End Site\n    {\n"
           "      OFFSET 0.8 0 0\n    }\n  }\n}\nMOTION\nFrames: 3\nFrame Time: 0.1\n"
           "0 0 0 0 0 0 0 0 0\n0.5 0 0 0 0 0 0 0 45\n1 0 0 0 0 0 0 0 90\n";
}

struct ActorSessionTest : testing::Test {
    fs::path folder = test::scratchFolder();
    EditorOptions options;

    ActorSessionTest() {
        options.headless = true;
        options.file = folder / "actor.voledit";
        std::ofstream(options.file) << test::kActorScene;
    }
    void play(Session& session, const std::string& events) {
        replay(parseEvents(events, "test.ev"), "test.ev", session);
    }
    Json state(Session& session) { return Json::parse(stateJson(session.editor())); }
    std::string lastMessage(Session& session) {
        const auto& notices = session.editor().workspace().notices;
        return notices.empty() ? "" : notices.back().text;
    }
    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    Json joint(const Json& state, const std::string& name) {
        for (const Json& entry : state["scene"]["root"]["skeleton"]["joints"])
            if (entry["name"] == name) return entry;
        return nullptr;
    }
    void expectRotation(const Json& joint, const Vec3& degrees) {
        ASSERT_TRUE(joint.contains("rotate")) << joint;
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(joint["rotate"][std::size_t(a)].get<double>(), degrees[a], 1e-9) << joint;
    }
    const Workspace& workspace(Session& session) { return session.editor().workspace(); }
};

TEST_F(ActorSessionTest, AJointIsDraggedToAnotherPlaceByName) {
    Session session(options);
    play(session, "drag @joint(LeftHand) to @joint(LeftHand)+-60,-50\nframe 2\n");
    const Json dragged = state(session);
    EXPECT_EQ(dragged["undo"], Json::parse(R"(["Pose LeftHand"])"));
    EXPECT_EQ(dragged["selection"]["joints"], Json::parse(R"({ "actor": "/root", "names": ["LeftHand"] })"));
    const Vec2 there = session.locate(parsePlace("@joint(body/LeftHand)"));
    play(session, "press Ctrl+Z\nframe\n");
    const Vec2 before = session.locate(parsePlace("@joint(LeftHand)"));
    EXPECT_LT(glm::distance(there, before + Vec2(-60, -50)), 1e-3);
    try {
        play(session, "click @joint(LeftFoot)\n");
        FAIL() << "there is no such joint";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("test.ev:1"), HasSubstr("LeftFoot"), HasSubstr("RightForeArm")));
    }
}

TEST_F(ActorSessionTest, KeysTurnTheSelectedJointAndClearIt) {
    Session session(options);
    play(session, "click @joint(LeftArm)\npress R\npress Y\ntext \"\"\npress 3\npress 0\npress Enter\nframe\n");
    expectRotation(joint(state(session), "LeftArm"), {0, 30, 0});
    play(session, "press Alt+R\nframe\n");
    EXPECT_FALSE(joint(state(session), "LeftArm").contains("rotate"));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Rotate LeftArm", "Clear rotation"])"));
}

TEST_F(ActorSessionTest, PosesAreCopiedPastedAndMirrored) {
    Session session(options);
    play(session, "do joint.select LeftArm\ndo joint.rotate 10 20 30\ndo pose.copy\ndo pose.paste-mirrored\n");
    const Json both = state(session);
    expectRotation(joint(both, "LeftArm"), {10, 20, 30});
    // Seen in a mirror across x: turns about y and z change their sign.
    expectRotation(joint(both, "RightArm"), {10, -20, -30});
    play(session, "do joint.select LeftArm\ndo joint.clear-rotation\ndo joint.select\ndo pose.mirror\n");
    const Json swapped = state(session);
    EXPECT_FALSE(joint(swapped, "RightArm").contains("rotate"));
    EXPECT_NEAR(joint(swapped, "LeftArm")["rotate"][1].get<double>(), 20, 1e-9);
    play(session, "do pose.clear\ndo pose.paste\n");
    expectRotation(joint(state(session), "LeftArm"), {10, 20, 30});
    EXPECT_TRUE(state(session)["messages"].empty());
}

TEST_F(ActorSessionTest, ALibraryHoldsPoses) {
    Session session(options);
    play(session,
         "do joint.select LeftArm RightArm\ndo joint.rotate 0 40 0\ndo pose.save wave\ndo pose.clear\n"
         "do pose.apply wave\n");
    expectRotation(joint(state(session), "RightArm"), {0, 40, 0});
    EXPECT_THROW(play(session, "do pose.apply bow\n"), Error);
    play(session,
         "do node.select body\nframe 2\ndo pose.clear\nframe\nclick @widget(\"Inspector/Poses/wave\")\nframe\n");
    expectRotation(joint(state(session), "LeftArm"), {0, 40, 0});
    play(session, "click @widget(\"Inspector/Poses/Delete wave\")\nframe\n");
    EXPECT_FALSE(state(session)["scene"]["root"].contains("poses"));
}

TEST_F(ActorSessionTest, AJointGoesToAPlaceByIkAndTheRootMoves) {
    Session session(options);
    play(session, "do joint.select LeftHand\ndo joint.move 1.2 0 1.9\nframe\n");
    EXPECT_LT(glm::distance(test::jointIn(workspace(session), "LeftHand"), Vec3(1.2, 0, 1.9)), 1e-6);
    play(session, "do joint.select Hips\ndo joint.move 0.5 0 0\nframe\n");
    EXPECT_LT(glm::distance(test::jointIn(workspace(session), "LeftHand"), Vec3(1.7, 0, 1.9)), 1e-6);
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Pose LeftHand", "Move Hips"])"));
}

TEST_F(ActorSessionTest, AMotionDrivesTheActorAndItsTableIsEdited) {
    const fs::path walk = write("walk.bvh", bvhOf("Hips", "LeftArm"));
    Session session(options);
    const std::vector<std::string> before = workspace(session).document.undoNames();
    play(session, "do actor.import-motion " + walk.string() + "\nframe\n");
    Json driven = state(session);
    EXPECT_EQ(driven["scene"]["root"]["motion"], "walk");
    EXPECT_EQ(driven["scene"]["assets"]["walk"]["path"], "walk.bvh");
    EXPECT_EQ(driven["undo"], Json::parse(R"(["Import motion"])"));
    EXPECT_EQ(driven["selection"]["node"], "/root");
    play(session, "do timeline.goto 0.2\nframe\n");
    const Vec3 arm = test::jointIn(workspace(session), "LeftForeArm") - test::jointIn(workspace(session), "LeftArm");
    EXPECT_LT(glm::distance(arm, Vec3(0, 0, -0.8)), 1e-6) << arm.x << " " << arm.y << " " << arm.z;
    // What is posed goes on top of the motion, and reaches its pixel.
    play(session, "drag @joint(LeftHand) to @joint(LeftHand)+60,-20\nframe 2\n");
    EXPECT_EQ(state(session)["undo"].back(), "Pose LeftHand");

    play(session,
         "do node.select body\nframe 2\nclick @widget(\"Inspector/Joints\")\nframe 2\n"
         "click @widget(\"Inspector/Joints/LeftArm\")\nframe 2\n"
         "click @widget(\"Inspector/Joints/LeftArm/—\")\nframe 2\n");
    driven = state(session);
    EXPECT_EQ(driven["undo"].back(), "Change joint table");
    EXPECT_TRUE(driven["scene"]["root"]["motionMap"]["LeftArm"].is_null());
    EXPECT_EQ(driven["scene"]["root"]["motionMap"]["Hips"], "Hips");
    play(session, "do actor.clear-motion\nframe\n");
    EXPECT_FALSE(state(session)["scene"]["root"].contains("motion"));
}

TEST_F(ActorSessionTest, AMotionThatMatchesNothingOffersTheTable) {
    const fs::path odd = write("odd.bvh", bvhOf("thing1", "thing2"));
    Session session(options);
    play(session, "drop " + odd.string() + "\nframe 4\n");
    EXPECT_THAT(lastMessage(session), AllOf(HasSubstr("thing1"), HasSubstr("table")));
    EXPECT_EQ(state(session)["scene"]["root"]["motion"], "odd");
    EXPECT_TRUE(workspace(session).problem.empty()) << workspace(session).problem;
    // The table stands open.
    play(session,
         "click @widget(\"Inspector/Joints/LeftArm\")\nframe 2\nclick @widget(\"Inspector/Joints/LeftArm/thing2\")\n"
         "frame 2\n");
    EXPECT_EQ(state(session)["scene"]["root"]["motionMap"]["LeftArm"], "thing2");
}

TEST_F(ActorSessionTest, WithoutAnActorAMotionAsksForARig) {
    std::ofstream(options.file) << R"({ "voledit": 1, "root": { "type": "solid",
        "shape": { "sphere": { "center": [0,0,0], "radius": 1 } }, "color": [1,1,1], "opacity": 1 } })";
    const fs::path walk = write("walk.bvh", bvhOf("Hips", "LeftArm"));
    Session session(options);
    const Json before = state(session)["scene"];
    play(session, "drop " + walk.string() + "\nframe 4\n");
    EXPECT_THAT(lastMessage(session), HasSubstr("rig"));
    EXPECT_EQ(state(session)["scene"], before);
    EXPECT_THROW(play(session, "do actor.import-motion " + walk.string() + "\n"), Error);
}

TEST_F(ActorSessionTest, ABrokenMotionLeavesTheSceneAndSaysWhy) {
    const fs::path bad = write("bad.bvh", "HIERARCHY\nROOT Hips\n{\n");
    Session session(options);
    const Json before = state(session)["scene"];
    play(session, "do actor.import-motion " + bad.string() + "\nframe 3\n");
    EXPECT_THAT(lastMessage(session), HasSubstr("bad.bvh"));
    EXPECT_EQ(state(session)["scene"], before);
}

TEST_F(ActorSessionTest, TheRigIsEditedAtRestAndRegionsInTheInspector) {
    Session session(options);
    play(session, "do joint.select LeftArm\ndo joint.rotate 0 -60 0\nframe\n");
    EXPECT_GT(test::jointIn(workspace(session), "LeftHand").z, 1.5);
    play(session, "press Tab\nframe 2\n");
    EXPECT_TRUE(workspace(session).actors.rigEdit);
    EXPECT_NEAR(test::jointIn(workspace(session), "LeftHand").z, 1, 1e-12);
    play(session, "drag @widget(\"Inspector/Region/Size 1\") to @widget(\"Inspector/Region/Size 1\")+40,0\nframe\n");
    const Json sized = state(session);
    EXPECT_EQ(sized["undo"].back(), "Change size");
    EXPECT_GT(sized["scene"]["root"]["skeleton"]["limbs"][1]["size"][0], 0.6);
    EXPECT_EQ(sized["scene"]["root"]["skeleton"]["limbs"][1]["size"][1], 0.6);
    play(session, "do view.regions on\ndo joint.disjoint on\nframe\npress Tab\nframe\n");
    const Json apart = state(session);
    EXPECT_EQ(apart["scene"]["root"]["disjoint"], Json::parse(R"(["LeftArm"])"));
    EXPECT_FALSE(workspace(session).actors.rigEdit);
    EXPECT_GT(test::jointIn(workspace(session), "LeftHand").z, 1.5);
    play(session, "do actor.mode disjoint\nframe\n");
    EXPECT_EQ(state(session)["scene"]["root"]["mode"], "disjoint");
}

TEST_F(ActorSessionTest, CoverageIsCountedAgainWhenARegionChanges) {
    Session session(options);
    play(session, "do view.coverage on\nframe 2\n");
    ASSERT_TRUE(workspace(session).actors.coverage);
    const Coverage before = *workspace(session).actors.coverage;
    EXPECT_GT(before.opaque, 1000u);
    play(session, "do joint.select LeftForeArm\nframe 2\nclick @widget(\"Inspector/Region/Size 1\")\n");
    play(session, "doubleclick @widget(\"Inspector/Region/Size 1\")\ntext \"0.1\"\npress Enter\nframe 3\n");
    ASSERT_TRUE(workspace(session).actors.coverage);
    EXPECT_GT(workspace(session).actors.coverage->uncovered, before.uncovered);
    play(session, "do rig.fit\nframe 3\n");
    EXPECT_EQ(state(session)["undo"].back(), "Fit regions");
    EXPECT_LE(workspace(session).actors.coverage->uncovered, before.uncovered);
    play(session, "do rig.edit off\nframe 2\n");
    EXPECT_FALSE(workspace(session).actors.coverage);
}

TEST_F(ActorSessionTest, TheActorIsARowWithItsNameAndTakesAnother) {
    Session session(options);
    play(session, "click @widget(\"Scene/body\")\nframe\npress F2\nframe 2\ntext \"dancer\"\npress Enter\nframe 2\n");
    EXPECT_EQ(state(session)["scene"]["root"]["name"], "dancer");
    EXPECT_NO_THROW(session.locate(parsePlace("@joint(dancer/LeftHand)")));
}

TEST_F(ActorSessionTest, DeleteWithJointsSelectedLeavesTheActor) {
    Session session(options);
    play(session, "click @joint(LeftArm)\npress Delete\npress X\nframe\n");
    EXPECT_EQ(state(session)["scene"]["root"]["type"], "actor");
    EXPECT_TRUE(state(session)["undo"].empty());
}

TEST_F(ActorSessionTest, ARecordedDragReplaysToTheSameScene) {
    options.record = folder / "session.ev";
    Json recorded;
    {
        Session session(options);
        play(session,
             "drag @joint(LeftHand) to @joint(LeftHand)+-60,-50\nframe 2\ndo joint.select RightArm\npress R\n"
             "move +40,40\npress Enter\nframe 2\n");
        recorded = state(session)["scene"];
    }
    const fs::path events = options.record;
    options.record.clear();
    Session session(options);
    replay(loadEvents(events), events.string(), session);
    EXPECT_EQ(state(session)["scene"], recorded);
    EXPECT_EQ(state(session)["undo"].size(), 2u);
}

TEST_F(ActorSessionTest, AnObjectIsRiggedAndAMotionWalksIt) {
    VOLEDIT_SHARED_OR_SKIP(body, "data/volumes/human_body.mhd");
    VOLEDIT_SHARED_OR_SKIP(walk, "data/mocap/makehuman_zombie_walk.bvh");
    options.file = body;
    Session session(options);
    play(session, "do actor.rig biped\nframe 2\n");
    EXPECT_THAT(lastMessage(session), HasSubstr("24 limbs"));
    EXPECT_EQ(state(session)["undo"], Json::parse(R"(["Auto-rig"])"));
    ASSERT_EQ(workspace(session).compiled.actors.size(), 1u);
    const Vec3 hand = test::jointIn(workspace(session), "LeftHand");
    play(session, "do actor.import-motion " + walk.string() + "\nframe 2\ndo timeline.goto 0.5\nframe\n");
    EXPECT_THAT(lastMessage(session), HasSubstr("frames"));
    EXPECT_TRUE(workspace(session).problem.empty()) << workspace(session).problem;
    EXPECT_GT(glm::distance(test::jointIn(workspace(session), "LeftHand"), hand), 0.5);
    play(session, "drag @joint(LeftHand) to @joint(LeftHand)+-10,-30\nframe 2\n");
    EXPECT_EQ(state(session)["undo"].back(), "Pose LeftHand");
    // A key on the hand is one on the arm that was dragged with it.
    play(session, "press I\nframe 2\n");
    EXPECT_EQ(state(session)["undo"].back(), "Insert 3 keys");
    EXPECT_EQ(animatedValues(workspace(session).document.scene()).size(), 3u);
    // What was built opens again.
    play(session, "do file.save-as " + (folder / "walker.voledit").string() + "\nframe\n");
    options.file = folder / "walker.voledit";
    options.allowOutside = true;
    const Json saved = state(session)["scene"];
    Session again(options);
    EXPECT_EQ(state(again)["scene"]["root"]["skeleton"], saved["root"]["skeleton"]);
}

}  // namespace
}  // namespace voledit
