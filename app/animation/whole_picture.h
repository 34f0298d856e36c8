#pragma once
// Whether a frame's file was cut off.

#include <filesystem>

#include "core/base/types.h"

namespace voledit {

/// True if the file is a PNG or a scan-line EXR of this size, as `IoClient::writePicture` makes them, that is not cut
/// off. Looks at the structure (chunks, offsets, lengths), not at the pixels.
bool isWholePicture(const std::filesystem::path& file, Index2 size);

}  // namespace voledit
