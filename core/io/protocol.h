#pragma once
// What the client and voledit-io say to each other: one packet a message, over a local socket; voxels and pixels beside
// it in a memory file. Neither side believes the other: lengths are checked while unpacking.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/fields/volume.h"
#include "core/io/io_client.h"
#include "core/io/mesh_bytes.h"

namespace voledit {

enum class IoTask : std::uint8_t { ReadVolume, WriteVolume, ReadPicture, WritePicture, ReadMotion };

/// Client to parser. Writing carries the voxels (or float RGBA pixels) as a memory file.
struct IoRequest {
    IoTask task = IoTask::ReadVolume;
    std::string path;       // absolute; writing: the file to make, alone in a folder of its own
    std::string shownPath;  // as the user wrote it, for messages
    std::optional<RawFormat> raw;
    std::optional<Vec3> spacing;
    std::uint64_t memoryLimit = 0;  // bytes, > 0
    bool mayReduce = false;         // reduced_volumes.h
    VolumeGrid grid;                // writing a volume
    VoxelType type = VoxelType::UInt8;
    Index2 pictureSize{0};  // writing a picture
    bool transparent = false;
};

/// Parser to client: any number of Progress, then one of the others. Volume, Mesh, Picture and Motion carry a memory
/// file; a motion's holds it as BVH text, which the client reads as it does any stranger's.
struct IoReply {
    enum class Kind : std::uint8_t { Progress, Failed, Volume, Mesh, Picture, Written, Motion };

    Kind kind = Kind::Progress;
    double fraction = 0;
    std::string message;  // Failed: the whole message
    std::string format, storedType;
    VolumeGrid grid;
    VoxelType type = VoxelType::UInt8;
    VolumeStatistics statistics;
    MeshCounts mesh;
    std::vector<std::string>
        notes;  // Volume, Mesh, Motion: warnings; Written: names of the files made, the header last
    Index2 pictureSize{0};
    std::uint64_t textBytes = 0;  // Motion
};

std::vector<std::byte> pack(const IoRequest& request);
std::vector<std::byte> pack(const IoReply& reply);

/// Inverse of `pack`. Throws Error where the packet is short, long or names an unknown kind.
IoRequest unpackRequest(std::span<const std::byte> packet);
IoReply unpackReply(std::span<const std::byte> packet);

/// Longest packet that either side sends; texts are cut to fit.
inline constexpr std::size_t kLongestPacket = 128 * 1024;

}  // namespace voledit
