#pragma once
// OpenVDB's table of grids, before the library reads them.

#include "app/io/input_file.h"

namespace voledit {

/// Throws Error where the file is no OpenVDB file (version 220 or later, since 2013), its header is damaged, or a grid
/// reaches beyond the end of the file, which the library does not notice.
void checkVdb(const Source& source);

}  // namespace voledit
