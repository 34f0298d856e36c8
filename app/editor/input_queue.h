#pragma once
// Spreads input over frames so that nothing is lost: ImGui 1.86 sees states, not events.

#include <deque>
#include <span>
#include <vector>

#include "app/editor/input.h"

namespace voledit {

/// Events wait here until a frame can take them: a button or key that goes down and up between two frames, or a mouse
/// that moves on after a press, would else be missed.
class InputQueue {
public:
    void push(std::span<const InputEvent> events);
    /// What the next frame sees: the longest run of waiting events in which no button or key changes twice, no move
    /// follows a change of a button, no modifier changes after what it belongs to, and nothing follows a text or a
    /// drop.
    std::vector<InputEvent> takeFrame();
    bool empty() const { return waiting_.empty(); }

private:
    std::deque<InputEvent> waiting_;
};

/// Writes `events` and the keys, buttons and modifiers that they leave down into ImGui's io (of the current context).
void feedImGui(const std::vector<InputEvent>& events);
/// Tells ImGui which of our keys are its arrows, Enter, Escape and so on. Once, for the current context.
void mapImGuiKeys();

}  // namespace voledit
