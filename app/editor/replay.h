#pragma once
// Replays an event file.

#include <string>
#include <vector>

#include "app/editor/events.h"

namespace voledit {

/// What a replay drives: the editor in a window or headless; in tests a stand-in.
class EventHost {
public:
    virtual ~EventHost() = default;

    /// Draws one frame with `events` and what earlier frames could not take.
    virtual void frame(const std::vector<InputEvent>& events) = 0;
    /// True while input still waits for a frame.
    virtual bool inputWaits() const = 0;
    /// Window pixels of a place that is on the screen. Throws Error.
    virtual Vec2 locate(const Place& place) = 0;
    /// Runs a named action. Throws Error.
    virtual void act(const std::string& action, const std::string& argument) = 0;
    virtual void waitIdle() = 0;
    virtual void saveScreenshot(const std::string& path) = 0;
    virtual void saveState(const std::string& path) = 0;
    /// True when the user, or an action, closed the editor: what is left is not replayed.
    virtual bool closed() const = 0;
};

/// Runs `events` in order. Throws Error "FILE:LINE: …" where one fails.
void replay(const std::vector<Event>& events, const std::string& file, EventHost& host);

}  // namespace voledit
