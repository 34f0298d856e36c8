#pragma once
// The named actions of keys: putting, taking, moving them, and going from one to the next.

#include "app/editor/workspace.h"

namespace voledit {

/// Adds key.insert, key.remove, key.clear, key.delete, key.next, key.previous, key.auto, key.move, key.copy,
/// key.interpolation, key.select, key.select-all, key.select-none, key.grab, key.duplicate, timeline.frame-all.
/// `workspace` outlives `actions`.
void addKeyActions(Actions& actions, Workspace& workspace);

/// "step", "linear", "smooth".
std::string wordOf(Track::Interpolation interpolation);

}  // namespace voledit
