#pragma once
// What the editor keeps about time and keys beside the scene.

#include <optional>
#include <string>
#include <vector>

#include "app/editor/timeline/playback.h"
#include "app/editor/timeline/timeline_range.h"
#include "core/scene/keys.h"

namespace voledit {

/// A field of a panel that shows a value which may have keys, where it was drawn last; window pixels.
struct KeyField {
    ValuePath path;
    Vec2 min{0}, max{0};
};

/// A key as the dope sheet drew it last: where "@key(TRACK,N)" finds it.
struct ShownKey {
    ValuePath path;
    int index = 0;        // of the value's keys, from 0
    Vec2 at{0};           // window pixels
    bool visible = true;  // false where it is scrolled out of sight
};

/// Not part of the scene, hence not undone. Plain data.
struct TimelineState {
    std::optional<bool> wanted;  // shown or not, as the user said; else where something changes over time
    bool shown = false;          // in this frame
    float height = 210;          // of the whole timeline, design pixels

    Playback playback;
    bool autoKey = false;  // every edit of a value that may have keys sets one

    std::optional<TimelineRange> range;  // seen; nullopt: the scene's frames
    std::vector<std::string> closed;     // rows of nodes whose values are not shown
    std::vector<KeyRef> keys;            // selected
    ValuePath hovered;                   // of the field under the mouse; "" for none

    // What actions want of the dope sheet's next frame.
    enum class Grab : unsigned char { None, Move, Copy };
    Grab grabWanted = Grab::None;  // the selected keys follow the mouse
    bool menuWanted = false;       // the list of interpolations opens under the mouse

    // What a field's menu wants done after this frame's panels: an action, for a value.
    struct Request {
        std::string action;
        ValuePath path;
        bool waited = false;  // a frame, for the field to make the value: the file leaves it out
    } request;

    // Of the last frame drawn.
    std::vector<KeyField> fields;
    std::vector<ShownKey> shownKeys;
    ValuePath reveal;  // the row of this value, and its key `revealKey`, come into view in the next frame
    int revealKey = 0;
};

/// The value whose field is at `pixel`; "" where there is none.
inline ValuePath fieldAt(const TimelineState& state, const Vec2& pixel) {
    for (const KeyField& field : state.fields)
        if (pixel.x >= field.min.x && pixel.y >= field.min.y && pixel.x < field.max.x && pixel.y < field.max.y)
            return field.path;
    return {};
}

/// The user's own settings, for another scene.
inline TimelineState withoutScene(const TimelineState& state) {
    TimelineState fresh;
    fresh.wanted = state.wanted;
    fresh.height = state.height;
    fresh.autoKey = state.autoKey;
    fresh.playback.loop = state.playback.loop;
    return fresh;
}

}  // namespace voledit
