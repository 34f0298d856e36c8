#pragma once
// One writer a format.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/io/input_file.h"
#include "core/fields/volume.h"

namespace voledit {

/// A volume to be written, and where.
struct VolumeOutput {
    VolumeGrid grid;
    VoxelType type = VoxelType::UInt8;
    std::span<const std::byte> voxels;
    Source target;  // its name is what the user sees
    std::function<void(double)> progress;
};

/// Writes by the target's ending and returns the names of the files made, the header last. Throws Error: an unknown
/// ending, a size that the format cannot hold, a full disk.
std::vector<std::string> writeAnyVolume(const VolumeOutput& volume);

std::vector<std::string> writeNrrd(const VolumeOutput& volume);       // .nrrd: gzip; .nhdr: raw beside it
std::vector<std::string> writeNifti(const VolumeOutput& volume);      // .nii, .nii.gz
std::vector<std::string> writeMetaImage(const VolumeOutput& volume);  // .mha; .mhd: .zraw beside it

}  // namespace voledit
