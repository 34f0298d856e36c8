#pragma once
// How the window is divided.

#include "core/base/types.h"

namespace voledit {

/// A rectangle in window pixels from the upper left.
struct PixelRect {
    Index2 origin{0}, size{1};
    bool operator==(const PixelRect&) const = default;
    bool contains(const Vec2& at) const {
        const Vec2 d = at - Vec2(origin);
        return d.x >= 0 && d.y >= 0 && d.x < size.x && d.y < size.y;
    }
};

/// Menu on top, status bar at the bottom, panels at the right, the viewport in what is left, the timeline below it.
struct Layout {
    PixelRect menu, view, time, panels, status;
};

/// The layout of a window of `window` pixels, `scale` pixels a design pixel. Every size is at least 1. The timeline
/// gets `timeHeight` design pixels, but leaves the viewport two fifths of the height; 0: none.
Layout layoutOf(Index2 window, float scale, float timeHeight = 0);

}  // namespace voledit
