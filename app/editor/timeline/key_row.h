#pragma once
// A row of a panel that shows a value which may have keys.

#include <imgui.h>

#include <cmath>
#include <string>

#include "app/editor/workspace.h"

namespace voledit {

/// How a value stands to the time that is shown.
enum class KeyState : unsigned char { None, Animated, Keyed };
template <class T>
KeyState keyStateOf(const Tracked<T>& value, double t) {
    for (const PartTrack& part : value.tracks())
        for (const Track::Key& key : part.track.keys)
            if (std::abs(key.time - t) <= kSameKeyTime) return KeyState::Keyed;
    return value.animated() ? KeyState::Animated : KeyState::None;
}

/// While it lives, the fields drawn are those of the value at `path`: tinted green where it has keys, yellow where one
/// of them is at the time shown. I and Alt+I over them mean it, and a right click opens a menu of keys. With "" as the
/// path nothing of this.
class KeyRow {
public:
    KeyRow(Workspace& workspace, ValuePath path, const char* label, KeyState state);
    ~KeyRow();
    KeyRow(const KeyRow&) = delete;
    KeyRow& operator=(const KeyRow&) = delete;

private:
    void menu() const;

    Workspace& workspace_;
    ValuePath path_;
    const char* label_;
    KeyState state_;
    ImVec2 from_{};
};

/// True where I over the row, or its menu, wants a key for a value that the scene leaves out: the row must give it one.
bool takeKeyWish(Workspace& workspace, const ValuePath& path);

/// Does what the menu of a row asked for in this frame. After all panels are drawn: their copies of nodes are then
/// written back. Throws Error.
void runKeyRequest(Workspace& workspace);

}  // namespace voledit
