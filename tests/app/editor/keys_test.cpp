#include "app/editor/keys.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

TEST(Keys, NamesReadBack) {
    int named = 0;
    for (int code = 1; code < kKeyCount; ++code) {
        const std::string_view name = nameOf(Key(code));
        if (name.empty()) continue;
        ++named;
        EXPECT_EQ(keyNamed(name), Key(code)) << name;
    }
    EXPECT_EQ(named, 36 + 12 + 14 + 12 + 16 + 4);
}

TEST(Keys, SignsAndOtherNames) {
    EXPECT_EQ(keyNamed("g"), Key::G);
    EXPECT_EQ(keyNamed("-"), Key::Minus);
    EXPECT_EQ(keyNamed("esc"), Key::Escape);
    EXPECT_FALSE(keyNamed("Hyper"));
    EXPECT_FALSE(keyNamed(""));
}

TEST(Keys, ChordsInAnyOrder) {
    const Chord redo{Key::Z, true, true, false};
    EXPECT_EQ(chordNamed("Ctrl+Shift+Z"), redo);
    EXPECT_EQ(chordNamed("Shift+Ctrl+z"), redo);
    EXPECT_EQ(chordNamed(nameOf(redo)), redo);
    EXPECT_EQ(nameOf(Chord{Key::A, false, true, false}), "Shift+A");
}

TEST(Keys, NoChords) {
    for (const char* text : {"", "Ctrl+", "Ctrl", "+Z", "Z+Ctrl", "Ctrl+Nothing"})
        EXPECT_FALSE(chordNamed(text)) << text;
}

}  // namespace
}  // namespace voledit
