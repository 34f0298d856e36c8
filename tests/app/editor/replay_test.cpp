#include "app/editor/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/editor/input_queue.h"
#include "app/editor/recorder.h"
#include "core/base/error.h"

namespace voledit {
namespace {

// Writes down what it is told, one word a frame's event.
class Diary final : public EventHost {
public:
    void frame(const std::vector<InputEvent>& events) override {
        queue_.push(events);
        std::string line = "|";
        for (const InputEvent& event : queue_.takeFrame()) switch (event.kind) {
                case InputEvent::Kind::Move:
                    line += "m" + std::to_string(int(event.at.x)) + "," + std::to_string(int(event.at.y));
                    break;
                case InputEvent::Kind::Button:
                    line += event.down ? "d" : "u";
                    break;
                case InputEvent::Kind::Key:
                    line += (event.down ? "+" : "-") + std::string(nameOf(event.key));
                    break;
                default:
                    line += event.text;
            }
        said += line;
    }
    bool inputWaits() const override { return !queue_.empty(); }
    Vec2 locate(const Place& place) override {
        if (place.kind == Place::Kind::Widget) throw Error("no such widget");
        return place.at + place.offset;
    }
    void act(const std::string& action, const std::string& argument) override {
        said += "[" + action + " " + argument + "]";
    }
    void waitIdle() override { said += "[idle]"; }
    void saveScreenshot(const std::string& path) override { said += "[" + path + "]"; }
    void saveState(const std::string& path) override { said += "[" + path + "]"; }
    bool closed() const override { return false; }

    std::string said;

private:
    InputQueue queue_;
};

std::string diaryOf(const std::string& text) {
    Diary diary;
    replay(parseEvents(text, "f"), "f", diary);
    return diary.said;
}

TEST(Replay, ShortFormsHaveTheirFrames) {
    EXPECT_EQ(diaryOf("click 3,4"), "|m3,4|d|u|");
    EXPECT_EQ(diaryOf("doubleclick 3,4"), "|m3,4|d|u|d|u|");
    EXPECT_EQ(diaryOf("drag 0,0 to 10,20 steps 2"), "|m0,0|d|m5,10|m10,20|u|");
    EXPECT_EQ(diaryOf("drag 4,4 to +10,0 steps 1"), "|m4,4|d|m14,4|u|");
    EXPECT_EQ(diaryOf("press Ctrl+Z"), "|+Ctrl+Z|-Z-Ctrl|");
}

TEST(Replay, RawLinesWaitForTheirFrame) {
    EXPECT_EQ(diaryOf("move 1,2\ndown left\nframe\nup left\nframe 2"), "|m1,2d|u|");
    EXPECT_EQ(diaryOf("hold Shift\ntext \"a\"\nwait idle"), "|+Shifta[idle]");
    EXPECT_EQ(diaryOf("down left\nup left\nframe"), "|d|u");
}

TEST(Replay, TwoClicksAreNoDoubleClick) {
    const std::string said = diaryOf("click 3,4\nclick 3,4");
    const auto first = said.find('u'), second = said.rfind('d');
    EXPECT_GE(std::count(said.begin() + long(first), said.begin() + long(second), '|'), 20);
}

TEST(Replay, CommandsComeAfterWhatWaits) {
    EXPECT_EQ(diaryOf("do file.open a b\nscreenshot x.png\nstate s.json"), "[file.open a b]||[x.png][s.json]");
}

TEST(Replay, ErrorsNameTheLine) {
    try {
        diaryOf("frame\nclick @widget(\"No/Where\")");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "f:2: no such widget");
    }
}

TEST(Recorder, WhatItWritesReplaysTheSame) {
    const auto path = std::filesystem::path(testing::TempDir()) / "recorder_test.ev";
    const RecordedWindow window{{1000, 700}, 1.5};
    {
        Recorder recorder(path, window);
        recorder.frame({}, 1.0 / 60);
        recorder.frame({InputEvent::move({3, 4})}, 1.0 / 60);
        recorder.frame({InputEvent::press(MouseButton::Left, true)}, 3.0 / 60);
        recorder.action("file.open", "a b");
        recorder.frame({InputEvent::typed("x y"), InputEvent::dropped("/a b")}, 0.001);
        recorder.loaded();
        recorder.frame({}, 1000);
    }
    std::ifstream file(path);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(recordedWindow(text), window);
    EXPECT_EQ(text.substr(text.find("frame")),
              "frame\nmove 3,4\nframe\ndown left\nframe 3\ndo file.open \"a b\"\ntext \"x y\"\ndrop \"/a b\"\n"
              "frame\nwait idle\nframe 120\n");
    EXPECT_EQ(parseEvents(text, "f").size(), 11u);
    std::filesystem::remove(path);
    EXPECT_THROW(Recorder("/nowhere/x.ev", window), Error);
    EXPECT_FALSE(recordedWindow("# window 1x1, scale 1"));
    EXPECT_FALSE(recordedWindow("frame"));
}

}  // namespace
}  // namespace voledit
