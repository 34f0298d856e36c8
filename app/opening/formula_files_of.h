#pragma once
// Which formula files a scene names.

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace voledit {

/// The paths of formula files (`{ "file": PATH }`) as the scene's STFs write them, each once, sorted; those of entries
/// that nothing uses too.
std::vector<std::string> formulaFilesOf(const Scene& scene);

}  // namespace voledit
