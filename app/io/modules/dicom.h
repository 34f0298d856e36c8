#pragma once
// DICOM series, by GDCM. Opened as a module.

#include <optional>
#include <vector>

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"

namespace voledit {

struct DicomFiles {
    std::string name;           // what the user named, for messages
    std::vector<Source> files;  // candidates of all series
    std::optional<Source> one;  // the series of this file; else the largest series
};

/// Reads one series: slices sorted along their normal, spacing from their positions (a tilted gantry's shear is kept).
/// Slices' own sizes, types and gaps are checked. Throws Error.
extern "C" void voleditReadDicom(const DicomFiles& files, VolumeSink& sink);

}  // namespace voledit
