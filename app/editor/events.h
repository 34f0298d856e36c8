#pragma once
// Recorded sessions: the lines of an event file (scene-format.md §4).

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/input.h"
#include "app/editor/places.h"

namespace voledit {

/// One line.
struct Event {
    enum class Kind : unsigned char {
        Frame,
        Move,
        Down,
        Up,
        Wheel,
        Click,
        DoubleClick,
        Drag,
        Press,
        Hold,
        Release,
        Text,
        Drop,
        Do,
        Wait,
        Screenshot,
        State
    };
    Kind kind = Kind::Frame;
    int count = 1;                           // Frame: how many; Drag: steps
    Place from, to;                          // from: Move, Click, DoubleClick, Drag; to: Drag
    MouseButton button = MouseButton::Left;  // Down, Up
    double wheel = 0;                        // Wheel
    Chord chord;                             // Press
    Key key = Key::None;                     // Hold, Release
    std::string text;                        // Text: the characters; Drop, Screenshot, State: the path; Do: the action
    std::string argument;                    // Do
    int line = 0;                            // in the file, from 1

    bool operator==(const Event&) const = default;
};

/// Parses a whole file. Throws Error "FILE:LINE: what was found, what was expected".
std::vector<Event> parseEvents(const std::string& text, const std::string& file);
/// Reads and parses. Throws Error.
std::vector<Event> loadEvents(const std::filesystem::path& path);

/// One line of a file, without comment; nullopt where there is nothing on it. Throws Error without file and line.
std::optional<Event> parseEvent(const std::string& line);
/// The line that `parseEvent` reads as `event`.
std::string lineOf(const Event& event);

}  // namespace voledit
