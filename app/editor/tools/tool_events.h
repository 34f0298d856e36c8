#pragma once
// What the viewport's tools are fed with: pointer and keys, free of any window or user-interface library.

#include <string>

#include "core/base/types.h"

namespace voledit {

enum class PointerButton : std::uint8_t { None, Left, Middle, Right };
enum class PointerPhase : std::uint8_t { Move, Down, Up, DoubleClick, Wheel, Leave };

struct Modifiers {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const Modifiers&) const = default;
};

/// One event of the pointer over (or captured by) the viewport. A double click comes after its second Down.
struct PointerEvent {
    PointerPhase phase = PointerPhase::Move;
    Vec2 at{0};  // viewport pixels from its upper left corner; may lie outside while a button is held
    PointerButton button = PointerButton::None;  // of Down, Up, DoubleClick
    Modifiers modifiers{};
    double wheel = 0;  // notches, positive is away from the user
};

/// A key going down. `key` is the name that event files use: "G", "Escape", "Enter", "Backspace", "7", ".", "-",
/// "Left".
struct KeyEvent {
    std::string key;
    Modifiers modifiers{};
};

}  // namespace voledit
