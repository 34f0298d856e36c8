#pragma once
// One reader a format: from a file's header to a StoredVolume, nothing believed, nothing of the voxels read; VTK to a
// volume or mesh. Each throws Error that names the file, the place, the cause and the remedy.

#include <optional>

#include "app/io/stored_volume.h"
#include "core/io/io_client.h"

namespace voledit {

StoredVolume parseNrrd(const Source& source, VolumeSink& sink);

/// `compressed`: the whole file is gzip.
StoredVolume parseNifti(const Source& source, bool compressed, VolumeSink& sink);

StoredVolume parseMetaImage(const Source& source, VolumeSink& sink);

StoredVolume parseRaw(const Source& source, const RawFormat& format);

/// Legacy VTK: structured points become a volume; structured, rectilinear and unstructured grids a mesh. Of several
/// arrays the one that `mainArray` gives; values of cells become those of points, with a warning.
void readVtk(const Source& source, VolumeSink& sink);

struct VtkFile;
/// The mesh in a file whose data set is none of structured points.
void readVtkMesh(const VtkFile& file, VolumeSink& sink);

}  // namespace voledit
