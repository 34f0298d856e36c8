#pragma once
// Skeletons and clips of glTF, FBX and Collada, by assimp. Opened as a module.

#include "app/io/input_file.h"
#include "app/io/node_clip.h"

namespace voledit {

/// Reads the skeleton and the first clip (a warning names the others). Files that it names (buffers) are read where
/// they lie in its folder or below. Throws Error.
extern "C" void voleditReadMotion(const Source& source, StoredMotion& motion);

}  // namespace voledit
