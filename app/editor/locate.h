#pragma once
// From a place's name to window pixels.

#include "app/editor/places.h"
#include "app/editor/widget_places.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Window pixels (from the upper left) of `place`, for the viewport and camera of `workspace` and the widgets drawn
/// last. Throws Error where it is not on the screen: outside a window of `window` pixels, a point outside the viewport
/// or behind the eye, an unknown or hidden widget (the message lists widgets with like names), an unknown joint, and a
/// key that the timeline does not show.
Vec2 locatePlace(const Place& place, const Workspace& workspace, const WidgetPlaces& widgets, Index2 window);

/// The name on the screen that `wanted` means: case, and the dots of "Open…", do not matter. `wanted` where there is
/// none.
std::string widgetNamed(const std::string& wanted, const WidgetPlaces& widgets);

}  // namespace voledit
