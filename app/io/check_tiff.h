#pragma once
// TIFF's structure, before a library decodes it.

#include <vector>

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"

namespace voledit {

/// Indices of the pages that are slices (reduced copies are left out), in order. Throws Error where the file is no
/// TIFF, its page chain breaks or turns back, or a page's data lies beyond the file's end. Warns of bit depths that are
/// widened. Classic TIFF and BigTIFF, TIFF 6.0 specification.
std::vector<int> checkTiff(const Source& source, VolumeSink& sink);

}  // namespace voledit
