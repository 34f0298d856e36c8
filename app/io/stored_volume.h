#pragma once
// A volume as a file describes it, and the one way from there to voxels. NRRD, NIfTI, MetaImage, VTK and raw files
// differ in their headers only: each parser makes a StoredVolume, `load` does the rest.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/input_file.h"
#include "app/io/volume_sink.h"

namespace voledit {

enum class StoredType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double, Int64, UInt64 };

/// Bytes of one value.
std::size_t byteSize(StoredType type);
/// "int8" … "uint64", "float", "double".
std::string_view nameOf(StoredType type);

enum class Encoding : std::uint8_t {
    Raw,
    Deflated,  // gzip or zlib, told apart by their first bytes
    Ascii,     // numbers, separated by white space or commas
    Hex,
};

/// A stretch of a file, from `offset` to its end.
struct DataPart {
    Source file;
    std::uint64_t offset = 0;
};

struct StoredVolume {
    std::string format;
    StoredType type = StoredType::UInt8;
    bool bigEndian = false;

    std::array<std::uint64_t, 3> size{1, 1, 1};
    std::uint64_t channels = 1;
    /// Distance in the stored order, in values, between neighbours along i, j, k and between channels.
    std::array<std::uint64_t, 4> stride{1, 1, 1, 1};
    /// Values in the file, ≥ those of the volume (other time steps).
    std::uint64_t storedValues = 1;

    Mat4 worldFromIndex{1.0};  // LPS
    double slope = 1, intercept = 0;

    Encoding encoding = Encoding::Raw;
    /// Where the values are: each part holds an equal share of them.
    std::vector<DataPart> parts;
    /// True where the format itself lets other things follow the values, so that nobody need be warned.
    bool moreMayFollow = false;
    /// Bytes to leave out at the start of each part, after decoding.
    std::uint64_t skip = 0;

    /// Sets size, channels, stride and storedValues of the usual order: channel fastest, then i, j, k, then the rest.
    void setInterleaved(std::array<std::uint64_t, 3> samples, std::uint64_t channelCount, std::uint64_t timeSteps);
};

/// Type of the voxels that a stored volume becomes: its own, double for 64-bit integers; rescaled, the smallest that
/// holds all of `values` (in the machine's byte order) × slope + intercept, whole numbers where both are.
VoxelType loadedType(const StoredVolume& stored, std::span<const std::byte> values);

/// Writes `values` as voxels of `type` to `out`, in the volume's order, rescaled.
void convert(const StoredVolume& stored, std::span<const std::byte> values, VoxelType type, std::span<std::byte> out);

/// Checks the description against the files (nothing is believed), reads and decodes the values, and converts them: to
/// the machine's byte order, channels interleaved, slope and intercept applied (to the smallest type that holds the
/// results), 64-bit integers to double. Throws Error.
void load(const Source& source, const StoredVolume& stored, VolumeSink& sink);

}  // namespace voledit
