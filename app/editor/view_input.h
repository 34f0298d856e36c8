#pragma once
// What mouse and keys did over the viewport in one frame.

#include <array>
#include <vector>

#include "app/editor/keys.h"
#include "core/base/types.h"

namespace voledit {

enum MouseButton { kLeft = 0, kRight = 1, kMiddle = 2 };

struct ViewInput {
    Index2 size{1, 1};     // the viewport in pixels
    Vec2 mouse{0};         // pixels from the viewport's upper left; may lie outside while a button is held
    Vec2 moved{0};         // since the last frame, pixels
    bool hovered = false;  // the mouse is over the viewport with nothing of the interface in front
    /// By MouseButton. `pressed` only where the press began over the viewport; `down` only after such a press.
    std::array<bool, 3> pressed{}, down{}, released{}, doubleClicked{};
    double wheel = 0;  // notches, only where hovered; > 0 away from the user
    bool shift = false, ctrl = false, alt = false;
    /// Keys that went down in this frame, not wanted by a text field. While a tool is busy all of them; else those that
    /// are no action's shortcut.
    std::vector<Key> keys;

    bool keyPressed(Key key) const {
        for (Key k : keys)
            if (k == key) return true;
        return false;
    }
};

}  // namespace voledit
