#pragma once
// Which files make up a volume that lies in many.

#include <optional>

#include "app/io/detect.h"
#include "app/io/modules/dicom.h"
#include "app/io/modules/pictures.h"

namespace voledit {

/// All DICOM files of a folder, or, where it has none itself, of its subfolders. Empty where there are none.
DicomFiles dicomFilesIn(const Source& folder);

/// The folder's DICOM files, of which the series of `file` is wanted.
DicomFiles seriesOfFile(const Source& file);

/// The slices of one TIFF (its pages) or PNG file. Checks the file's structure. Throws Error.
SliceStack stackOfFile(const Source& file, Format format, const std::optional<Vec3>& spacing, VolumeSink& sink);

/// The TIFF or PNG files of a folder, by the numbers in their names; of both kinds the more numerous, with a warning.
/// Warns of the first number that is missing. Checks each. Throws Error where there are none.
SliceStack stackInFolder(const Source& folder, const std::optional<Vec3>& spacing, VolumeSink& sink);

/// The files whose names match "slice_%03d.png" (a number) or "slice_*.png" (anything). Warns of the first number that
/// is missing. Checks each. Throws Error where there are none.
SliceStack stackOfPattern(const Source& pattern, const std::optional<Vec3>& spacing, VolumeSink& sink);

}  // namespace voledit
