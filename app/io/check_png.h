#pragma once
// PNG's structure, before a library decodes it.

#include "app/io/input_file.h"

namespace voledit {

/// Throws Error where the file is no PNG, its chunks do not fill it to an end mark, or its compressed data could not
/// hold the pixels that it claims.
void checkPng(const Source& source);

}  // namespace voledit
