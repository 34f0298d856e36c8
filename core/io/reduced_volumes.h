#pragma once
// What becomes of volumes that are larger than the memory limit.

namespace voledit {

/// Whether volumes that need more than `memoryLimit()` are read at reduced resolution, with a warning, for the rest of
/// the process; by default they are refused. For programs that show volumes, not for those that compute with them. Only
/// raw and compressed NRRD, NIfTI, MetaImage, legacy VTK and headerless files can be reduced while they are read.
void setMayReduceVolumes(bool may);
bool mayReduceVolumes();

}  // namespace voledit
