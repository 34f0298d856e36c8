#pragma once
// Which format a path holds: by content first, by name where that says nothing.

#include <cstdint>

#include "app/io/input_file.h"

namespace voledit {

enum class Format : std::uint8_t {
    Nrrd,
    Nifti,
    NiftiGz,
    MetaImage,
    Vtk,
    Vdb,
    Dicom,    // a file of a series
    Tiff,     // one file, of one or more pages
    Png,      // one picture
    Folder,   // of DICOM files or of slices
    Pattern,  // of file names: "slice_%03d.png", "slice_*.png"
};

/// Throws Error where there is nothing, nothing ordinary, or nothing that voledit reads.
Format detect(const Source& source);

/// True if the file holds DICOM by its mark (behind 128 bytes), or is named so.
bool looksLikeDicom(const Source& source);

}  // namespace voledit
