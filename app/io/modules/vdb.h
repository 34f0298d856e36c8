#pragma once
// OpenVDB grids. Opened as a module.

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"
#include "app/io/writers.h"

namespace voledit {

/// Reads the first float grid over the dense box of its active voxels, level sets as stored; grids "channel0",
/// "channel1" … of one transform become channels. Throws Error.
extern "C" void voleditReadVdb(const Source& source, VolumeSink& sink);

/// Writes float grids with the volume's transform: "density", or "channel0" … where there are several channels. The
/// box's corners are active, so that reading gives the same box. Throws Error.
extern "C" void voleditWriteVdb(const VolumeOutput& volume);

}  // namespace voledit
