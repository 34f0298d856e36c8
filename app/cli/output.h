#pragma once
// Small files that commands read and write.

#include <filesystem>
#include <string>

#include "core/scene/camera.h"

namespace voledit {

/// Throws Error unless a file could be written at `path` (its folder is there and may be written to): found out before
/// long work, not after it.
void checkWritable(const std::filesystem::path& path);

/// The same for a volume, whose ending must name a format that voledit writes.
void checkVolumeWritable(const std::filesystem::path& path);

/// Writes beside `path` and renames. Throws Error.
void writeTextFile(const std::filesystem::path& path, const std::string& text);

/// A camera from a JSON file: the object of a scene's `camera`, or a file that has one as its member. Throws Error.
Camera readCamera(const std::filesystem::path& path);

}  // namespace voledit
