#pragma once
// What a motion holds, for people and programs.

#include <nlohmann/json.hpp>

#include "core/io/io_client.h"

namespace voledit {

/// { "kind": "motion", "format", "joints" (without end sites), "endSites", "channels", "frames", "frameTime", "fps",
/// "duration" (seconds), "height" (of the rest pose, along its up), "up" ("y", "-y", "z" …), "bounds" (of the rest
/// pose), "hierarchy": [ { "name", "parent" (null for a root), "offset", "at" (rest), "channels" (names), "endSite" } ]
/// }
nlohmann::ordered_json motionJson(const MotionFile& file);

/// The same on standard output, the hierarchy as an indented list.
void printMotion(const MotionFile& file);

}  // namespace voledit
