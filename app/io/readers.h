#pragma once
// One reader a format: from a file's header to a StoredVolume, nothing believed, nothing of the voxels read. Each
// throws Error that names the file, the place, the cause and the remedy.

#include <optional>

#include "app/io/stored_volume.h"
#include "core/io/io_client.h"

namespace voledit {

StoredVolume parseNrrd(const Source& source, VolumeSink& sink);

/// `compressed`: the whole file is gzip.
StoredVolume parseNifti(const Source& source, bool compressed, VolumeSink& sink);

StoredVolume parseMetaImage(const Source& source, VolumeSink& sink);

/// Structured points only.
StoredVolume parseVtk(const Source& source);

StoredVolume parseRaw(const Source& source, const RawFormat& format);

}  // namespace voledit
