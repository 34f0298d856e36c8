#pragma once
// What a window, or an event file, feeds the editor with.

#include <string>
#include <vector>

#include "app/editor/keys.h"
#include "core/base/types.h"

namespace voledit {

enum class MouseButton : unsigned char { Left, Right, Middle };

/// One thing that happened, in window pixels from the upper left.
struct InputEvent {
    enum class Kind : unsigned char { Move, Button, Wheel, Key, Text, Drop };
    Kind kind = Kind::Move;
    Vec2 at{0};                              // Move
    MouseButton button = MouseButton::Left;  // Button
    Key key = Key::None;                     // Key
    bool down = false;                       // Button, Key
    double wheel = 0;                        // Wheel: notches, > 0 away from the user
    std::string text;                        // Text: UTF-8; Drop: a path

    bool operator==(const InputEvent&) const = default;

    static InputEvent move(const Vec2& at) { return {.kind = Kind::Move, .at = at, .text = {}}; }
    static InputEvent press(MouseButton button, bool down) {
        return {.kind = Kind::Button, .button = button, .down = down, .text = {}};
    }
    static InputEvent scroll(double notches) { return {.kind = Kind::Wheel, .wheel = notches, .text = {}}; }
    static InputEvent stroke(Key key, bool down) { return {.kind = Kind::Key, .key = key, .down = down, .text = {}}; }
    static InputEvent typed(std::string text) { return {.kind = Kind::Text, .text = std::move(text)}; }
    static InputEvent dropped(std::string path) { return {.kind = Kind::Drop, .text = std::move(path)}; }
};

/// One frame's input.
struct FrameInput {
    Index2 size{1280, 800};          // the window in pixels
    double seconds = 1.0 / 60;       // since the frame before
    std::vector<InputEvent> events;  // in the order they happened
    bool close = false;              // the user wants the window closed
};

}  // namespace voledit
