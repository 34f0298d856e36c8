// NIfTI-1, with the affine as an sform, shear and all.

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "app/io/header_text.h"
#include "app/io/output_file.h"
#include "app/io/writers.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::size_t kDataOffset = 352, kChunk = 4 << 20;

int datatypeOf(VoxelType type) {
    switch (type) {
        case VoxelType::Int8:
            return 256;
        case VoxelType::UInt8:
            return 2;
        case VoxelType::Int16:
            return 4;
        case VoxelType::UInt16:
            return 512;
        case VoxelType::Int32:
            return 8;
        case VoxelType::UInt32:
            return 768;
        case VoxelType::Float:
            return 16;
        case VoxelType::Double:
            break;
    }
    return 64;
}

/// The header's fields at the offsets of nifti1.h, and the four bytes behind it (no extensions).
class HeaderBytes {
public:
    void int16(std::size_t offset, int value) { put(offset, std::int16_t(value)); }
    void int32(std::size_t offset, int value) { put(offset, std::int32_t(value)); }
    void real(std::size_t offset, double value) { put(offset, float(value)); }
    void byte(std::size_t offset, int value) { put(offset, std::uint8_t(value)); }
    void text(std::size_t offset, const char* value) { std::memcpy(bytes_.data() + offset, value, std::strlen(value)); }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    template <class T>
    void put(std::size_t offset, T value) {
        std::memcpy(bytes_.data() + offset, &value, sizeof value);
    }

    std::array<std::byte, kDataOffset> bytes_{};
};

HeaderBytes headerOf(const VolumeGrid& g, VoxelType type) {
    HeaderBytes h;
    h.int32(0, 348);
    const bool several = g.channels > 1;
    const std::array<int, 8> dim{several ? 5 : 3, g.size.x, g.size.y, g.size.z, 1, several ? g.channels : 1, 1, 1};
    for (std::size_t d = 0; d < 8; ++d) h.int16(40 + 2 * d, dim[d]);
    if (several) h.int16(68, 1007);  // NIFTI_INTENT_VECTOR
    h.int16(70, datatypeOf(type));
    h.int16(72, int(8 * byteSize(type)));
    const Vec3 spacing = g.spacing();
    const std::array<double, 8> pixdim{1, spacing.x, spacing.y, spacing.z, 1, 1, 1, 1};
    for (std::size_t d = 0; d < 8; ++d) h.real(76 + 4 * d, pixdim[d]);
    h.real(108, double(kDataOffset));
    h.real(112, 1);   // slope
    h.byte(123, 2);   // millimetres
    h.int16(252, 0);  // no qform: it could not hold a shear
    h.int16(254, 1);  // sform: scanner coordinates
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 4; ++c)
            h.real(280 + 16 * r + 4 * c, (r < 2 ? -1 : 1) * g.worldFromIndex[int(c)][int(r)]);  // LPS to RAS
    h.text(344, "n+1");
    return h;
}

/// Channel after channel: NIfTI has components slowest.
void writeChannel(OutputFile& file, const VolumeOutput& volume, std::size_t channel) {
    const std::size_t size = byteSize(volume.type), channels = std::size_t(volume.grid.channels);
    const std::size_t count = volume.grid.sampleCount();
    std::vector<std::byte> plane;
    for (std::size_t at = 0; at < count; at += kChunk) {
        const std::size_t n = std::min(kChunk, count - at);
        std::span<const std::byte> part = volume.voxels.subspan(at * size, channels == 1 ? n * size : 0);
        if (channels > 1) {
            plane.resize(n * size);
            const std::byte* from = volume.voxels.data() + (at * channels + channel) * size;
            for (std::size_t i = 0; i < n; ++i) std::memcpy(plane.data() + i * size, from + i * channels * size, size);
            part = plane;
        }
        file.write(part);
        volume.progress((double(channel) + double(at + n) / double(count)) / double(channels));
    }
}

}  // namespace

std::vector<std::string> writeNifti(const VolumeOutput& volume) {
    const VolumeGrid& g = volume.grid;
    constexpr int most = std::numeric_limits<std::int16_t>::max();
    if (std::max({g.size.x, g.size.y, g.size.z, g.channels}) > most)
        throw Error(volume.target.name, "has more than 32767 samples on an axis, which NIfTI-1 cannot hold",
                    "write it as .nrrd");
    OutputFile file(volume.target);
    if (lowered(volume.target.path.string()).ends_with(".gz")) file.pack(Packing::Gzip);
    file.write(headerOf(g, volume.type).bytes());
    for (int c = 0; c < g.channels; ++c) writeChannel(file, volume, std::size_t(c));
    file.close();
    return {volume.target.path.filename().string()};
}

}  // namespace voledit
