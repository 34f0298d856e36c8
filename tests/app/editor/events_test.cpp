#include "app/editor/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace voledit {
namespace {

using Kind = Event::Kind;

TEST(Events, EveryLineReadsBack) {
    for (const char* line : {"frame",
                             "frame 12",
                             "move 3,4",
                             "down left",
                             "up middle",
                             "down right",
                             "wheel -1.5",
                             "click @view(0.5,0.5)",
                             "doubleclick 1,2",
                             "drag @point(a,1,2,3) to @point(a,1,2,3)+40,0 steps 5",
                             "press Ctrl+Shift+Z",
                             "press Escape",
                             "hold Shift",
                             "release Shift",
                             "text \"a \\\"b\\\" \\\\ # c\\n\"",
                             "drop \"/tmp/a b.nrrd\"",
                             "drop a.nrrd",
                             "do edit.undo",
                             "do file.save-as /tmp/x.voledit",
                             "do lattice.move 1,2,3",
                             "do select.points \"0,0,0 1,1,1\"",
                             "wait idle",
                             "screenshot out.png",
                             "state \"my state.json\""}) {
        const auto event = parseEvent(line);
        ASSERT_TRUE(event) << line;
        EXPECT_EQ(lineOf(*event), line);
    }
}

TEST(Events, DragHasTenStepsWhereNoneAreSaid) {
    EXPECT_EQ(parseEvent("drag 1,2 to 3,4")->count, 10);
}

TEST(Events, ArgumentsMayHoldBlanks) {
    EXPECT_EQ(parseEvent("do file.open /tmp/a b.nrrd")->argument, "/tmp/a b.nrrd");
    EXPECT_EQ(parseEvent("do file.open \"/tmp/a b.nrrd\"")->argument, "/tmp/a b.nrrd");
    EXPECT_EQ(parseEvent("screenshot a b.png")->text, "a b.png");
    EXPECT_EQ(parseEvent("click @widget(\"Lattice/Reset to rest\")")->from.name, "Lattice/Reset to rest");
    EXPECT_EQ(parseEvent("click @view( 0.5 , 0.25 )")->from.at, Vec2(0.5, 0.25));
}

TEST(Events, CommentsAndEmptyLines) {
    EXPECT_FALSE(parseEvent("# all of it"));
    EXPECT_FALSE(parseEvent("   \t"));
    EXPECT_EQ(parseEvent("frame 2  # settle")->count, 2);
    EXPECT_EQ(parseEvent("text \"a # b\"")->text, "a # b");
    EXPECT_EQ(parseEvent("drop a#b.nrrd")->text, "a#b.nrrd");
}

TEST(Events, WrongLines) {
    for (const char* line :
         {"jump",    "frame 0",    "frame x",      "frame 1 2",    "move",        "down",
          "down up", "wheel",      "wheel x",      "drag 1,2 3,4", "drag 1,2 to", "drag 1,2 to 3,4 steps 0",
          "press",   "press Ctrl", "hold Nothing", "text abc",     "text \"abc",  "drop",
          "do",      "wait",       "wait long",    "screenshot"})
        EXPECT_THROW(parseEvent(line), Error) << line;
}

TEST(Events, ErrorsNameFileAndLine) {
    try {
        parseEvents("frame\n\n# x\nfrme\n", "session.ev");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("session.ev:4: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("frme"));
    }
    const auto events = parseEvents("frame\r\n# x\nwait idle", "f");
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[1].line, 3);
    EXPECT_EQ(events[1].kind, Kind::Wait);
    EXPECT_THROW(loadEvents("/nowhere/x.ev"), Error);
    EXPECT_THROW(loadEvents("/"), Error);
}

}  // namespace
}  // namespace voledit
