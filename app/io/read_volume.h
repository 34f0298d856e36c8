#pragma once
// The one way in: any path to a volume.

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"
#include "core/io/protocol.h"

namespace voledit {

/// Reads what the request names into `sink`. Throws Error.
void readAnyVolume(const IoRequest& request, VolumeSink& sink);

}  // namespace voledit
