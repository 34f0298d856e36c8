#pragma once
// Where a reader puts a volume.

#include <cstddef>
#include <span>
#include <string>

#include "core/fields/mesh_data.h"
#include "core/fields/volume.h"

namespace voledit {

class InputFile;

/// All that is known of a volume before its voxels are read.
struct VolumeHeader {
    VolumeGrid grid;
    VoxelType type = VoxelType::UInt8;
    std::string format;      // as VolumeFile::format
    std::string storedType;  // number type in the file
};

/// Takes one volume: `allocate` once, then the returned memory is filled; or one mesh. May be called from the reading
/// thread only, except `progress`.
class VolumeSink {
public:
    virtual ~VolumeSink() = default;

    /// Zeroed memory for the header's voxels, i fastest, channels interleaved. Throws Error where they are more than
    /// the memory limit allows; `where` names the file.
    virtual std::span<std::byte> allocate(const std::string& where, const VolumeHeader& header) = 0;
    /// Says that the values in that memory are to become value × slope + intercept (in the smallest type that holds
    /// them), once they are all there.
    virtual void rescale(double slope, double intercept) = 0;
    /// Takes a mesh in place of a volume; `storedType` is the number type of its values in the file. Throws Error as
    /// `allocate` does.
    virtual void take(const std::string& where, MeshData mesh, const std::string& storedType) = 0;
    /// Throws Error, as `allocate` does, where `bytes` are more than the memory limit allows.
    virtual void checkMemory(const std::string& where, std::uint64_t bytes) const = 0;
    /// Bytes that a volume may take.
    virtual std::uint64_t memoryLimit() const = 0;
    /// Whether a volume that needs more may be given at reduced resolution.
    virtual bool mayReduce() const = 0;
    /// Copies bytes of `file` from `offset` on to `out` where that lies in the memory that `allocate` gave, faster than
    /// reading them there; progress runs from `from` to `to`. False where it cannot: then read. Throws Error.
    virtual bool copy(const InputFile& file, std::uint64_t offset, std::span<std::byte> out, double from,
                      double to) = 0;
    /// Fraction of the reading done, 0…1.
    virtual void progress(double fraction) = 0;
    /// Something that was repaired, cut or left out; the user sees it.
    virtual void warn(const std::string& message) = 0;
};

}  // namespace voledit
