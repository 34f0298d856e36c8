#pragma once
// The editor's state as event files ask for it (`state PATH`, scene-format.md §4).

#include <string>

#include "app/editor/editor.h"

namespace voledit {

/// JSON: "scene" (as saving writes it, the view as its camera; null where nothing is open), "selection" {"lattice",
/// "points": [[i, j, k] …]}, "undo", "redo" (names, the next one last), "modified", "renderer", "time", "frame" (the
/// nearest), "playing", "keys" (selected, [{"path", "time"} …]), "viewport" [x, y, w, h], "messages" (all since the
/// start), and in a window of the last interaction "frame_ms" (median time between pictures), "pictures_per_second"
/// and "refined_ms" (from the last change to full quality), and of now "renderer_why" (a sentence) and "picture" (its
/// size, pixels).
std::string stateJson(const Editor& editor);

}  // namespace voledit
