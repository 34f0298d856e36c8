#include "app/editor/actions.h"

#include <gtest/gtest.h>

#include <set>

#include "app/editor/editor.h"
#include "core/base/error.h"

namespace voledit {
namespace {

TEST(Actions, RunWithTheirArgument) {
    Actions actions;
    std::string got;
    actions.add({"file.open", "Open…", "Ctrl+O", "PATH", "Opens", [&](const std::string& path) { got = path; }});
    actions.run("file.open", "a b.nrrd");
    EXPECT_EQ(got, "a b.nrrd");
    EXPECT_EQ(actions.tooltip("file.open"), "Open… (Ctrl+O)\nOpens");
    ASSERT_TRUE(actions.ofShortcut({Key::O, true, false, false}));
    EXPECT_FALSE(actions.ofShortcut({Key::O, false, false, false}));
    EXPECT_FALSE(actions.ofShortcut({}));
}

TEST(Actions, UnknownAndDisabledOnesAreErrors) {
    Actions actions;
    actions.add({"a.b", "B", "", "", "", [](const std::string&) { FAIL(); }, [] { return false; }});
    EXPECT_THROW(actions.run("a.b"), Error);
    EXPECT_THROW(actions.run("a.c"), Error);
}

TEST(Actions, IdsAndShortcutsAreUnique) {
    Actions actions;
    const auto nothing = [](const std::string&) {};
    actions.add({"a.b", "B", "Ctrl+Shift+B", "", "", nothing});
    EXPECT_THROW(actions.add({"a.b", "C", "", "", "", nothing}), Error);
    EXPECT_THROW(actions.add({"a.c", "C", "Shift+Ctrl+B", "", "", nothing}), Error);
    EXPECT_THROW(actions.add({"a.d", "D", "Ctrl+Nothing", "", "", nothing}), Error);
    EXPECT_EQ(actions.all().size(), 1u);
}

TEST(Actions, AShortcutMeansOneThingInEachRegion) {
    Actions actions;
    const auto nothing = [](const std::string&) {};
    actions.add({"a.b", "B", "Delete", "", "", nothing});
    actions.add({"a.c", "C", "Delete", "", "", nothing, {}, {}, KeyRegion::Timeline});
    EXPECT_THROW(actions.add({"a.d", "D", "Delete", "", "", nothing, {}, {}, KeyRegion::Timeline}), Error);
    const Chord chord{Key::Delete};
    EXPECT_EQ(actions.ofShortcut(chord)->id, "a.b");
    EXPECT_EQ(actions.ofShortcut(chord, KeyRegion::Timeline)->id, "a.c");
    EXPECT_FALSE(actions.ofShortcut(chord, KeyRegion::Panels));
}

TEST(Actions, SwitchesTurnRoundOrObey) {
    EXPECT_TRUE(switchArgument("x", "", false));
    EXPECT_FALSE(switchArgument("x", "", true));
    EXPECT_TRUE(switchArgument("x", "on", true));
    EXPECT_FALSE(switchArgument("x", "off", true));
    EXPECT_THROW(switchArgument("x", "yes", true), Error);
}

// The editor's whole registry: each action explains itself, and the contract's are there.
TEST(Actions, TheEditorsAreComplete) {
    IoClient io;
    EditorSettings settings;
    settings.headless = true;
    const Editor editor(settings, io);
    const Actions& actions = editor.workspace().actions;
    for (const Action& action : actions.all()) {
        EXPECT_FALSE(action.title.empty()) << action.id;
        EXPECT_FALSE(action.help.empty()) << action.id;
        EXPECT_NE(listOf(actions).find(action.id), std::string::npos);
    }
    for (const char* id :
         {"file.open",      "file.save",      "file.save-as",      "file.screenshot",  "file.quit",
          "edit.undo",      "edit.redo",      "view.front",        "view.back",        "view.left",
          "view.right",     "view.top",       "view.bottom",       "view.frame",       "view.overlays",
          "view.renderer",  "view.step",      "lattice.add",       "lattice.remove",   "lattice.reset",
          "select.all",     "select.none",    "appearance.preset", "timeline.goto",    "timeline.play",
          "timeline.pause", "timeline.frame", "timeline.step",     "timeline.loop",    "timeline.start",
          "timeline.end",   "key.insert",     "key.delete",        "key.next",         "key.previous",
          "key.auto",       "key.move",       "key.copy",          "key.interpolation"})
        EXPECT_TRUE(actions.find(id)) << id;
    EXPECT_EQ(actions.ofShortcut(*chordNamed("Ctrl+Z"))->id, "edit.undo");
    EXPECT_EQ(actions.ofShortcut(*chordNamed("Ctrl+Shift+Z"))->id, "edit.redo");
    EXPECT_EQ(actions.ofShortcut(*chordNamed("Ctrl+O"))->id, "file.open");
}

}  // namespace
}  // namespace voledit
