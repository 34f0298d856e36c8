#pragma once
// PNG by libpng alone: the most common picture must not wait for OpenImageIO's libraries.

#include "app/io/modules/pictures.h"

namespace voledit {

/// As voleditReadSlices, for a stack of PNG files that `checkPng` has passed; several at a time.
void readPngSlices(const SliceStack& stack, VolumeSink& sink);

/// As voleditReadPicture.
Picture readPng(const Source& source);

/// Writes 8-bit RGB. Throws Error.
void writePng(const Picture& picture, const Source& target, bool transparent);

}  // namespace voledit
