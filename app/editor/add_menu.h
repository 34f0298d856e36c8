#pragma once
// What can be added to a scene, as a menu: every entry runs a named action.

#include "app/editor/workspace.h"

namespace voledit {

/// The entries of Add: deformations and objects. Within a menu or popup. Widgets: "Add/Transfers",
/// "Add/Transfers/Twist", "Add/Transfers/Formula file…", "Add/Objects/Sphere" …
void drawAddMenu(const Workspace& workspace);
/// The menu of Shift+A at the mouse; once a frame. Its scope is "Add".
void drawAddPopup(Workspace& workspace);

}  // namespace voledit
