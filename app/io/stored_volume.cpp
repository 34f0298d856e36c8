#include "app/io/stored_volume.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/io/byte_order.h"
#include "app/io/checks.h"
#include "app/io/decode.h"
#include "app/io/reduce.h"
#include "app/io/stored_type.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/fields/statistics.h"

namespace voledit {

static_assert(int(StoredType::Double) == int(VoxelType::Double), "withStoredType casts one to the other");

std::size_t byteSize(StoredType type) {
    return type >= StoredType::Int64 ? 8 : byteSize(VoxelType(type));
}

std::string_view nameOf(StoredType type) {
    if (type == StoredType::Int64) return "int64";
    if (type == StoredType::UInt64) return "uint64";
    return nameOf(VoxelType(type));
}

void StoredVolume::setInterleaved(std::array<std::uint64_t, 3> samples, std::uint64_t channelCount,
                                  std::uint64_t timeSteps) {
    size = samples;
    channels = channelCount;
    // The products are checked in `load`, before anything uses them; unsigned overflow is harmless until then.
    stride = {channels, channels * size[0], channels * size[0] * size[1], 1};
    storedValues = stride[2] * size[2] * timeSteps;
}

namespace {

constexpr std::size_t kGrain = 1 << 18;

/// True where the voxels can be read straight into place.
bool isPlain(const StoredVolume& s) {
    StoredVolume usual;
    usual.setInterleaved(s.size, s.channels, 1);
    return s.stride == usual.stride && s.slope == 1 && s.intercept == 0 && s.type < StoredType::Int64;
}

/// Values from the first to the last that the volume needs.
std::uint64_t neededValues(const StoredVolume& s) {
    std::uint64_t last = (s.channels - 1) * s.stride[3];
    for (std::size_t a = 0; a < 3; ++a) last += (s.size[a] - 1) * s.stride[a];
    return last + 1;
}

void checkDescription(const Source& source, const StoredVolume& s, VolumeSink& sink) {
    checkSizes(source.name, s.size, s.channels);
    checkAffine(source.name, s.worldFromIndex);
    if (!std::isfinite(s.slope) || !std::isfinite(s.intercept) || s.slope == 0)
        throw Error(source.name, "has an unusable slope or intercept", "correct them in the header");
    if (neededValues(s) > s.storedValues || s.parts.empty() || s.storedValues % s.parts.size() != 0)
        throw Error(source.name, "its sizes and its data files do not agree", "correct the header");
    for (const DataPart& part : s.parts) checkLength({s, part, s.storedValues / s.parts.size(), sink});
}

/// Reads the first `out.size()` bytes of all values, of the parts one behind the other.
void readValues(const StoredVolume& s, std::span<std::byte> out, VolumeSink& sink) {
    const std::uint64_t share = s.storedValues / s.parts.size();
    const std::size_t shareBytes = std::size_t(share) * byteSize(s.type);
    const std::size_t whole = out.size();
    for (std::size_t n = 0; n < s.parts.size() && !out.empty(); ++n) {
        const auto mine = out.first(std::min(out.size(), shareBytes));
        const double from = 1 - double(out.size()) / double(whole);
        decode({s, s.parts[n], share, sink, from, from + double(mine.size()) / double(whole)}, mine);
        out = out.subspan(mine.size());
    }
}

/// The smallest type for stored × slope + intercept: a whole-numbered rescale of integers stays whole.
VoxelType rescaledType(const StoredVolume& s, std::span<const std::byte> bytes) {
    const bool real = s.type == StoredType::Float || s.type == StoredType::Double;
    if (real) return VoxelType(s.type);
    const bool wide = byteSize(s.type) > 2;
    if (s.slope != std::floor(s.slope) || s.intercept != std::floor(s.intercept))
        return wide ? VoxelType::Double : VoxelType::Float;
    if (s.type >= StoredType::Int64) return VoxelType::Double;
    const VolumeStatistics found = statisticsOf(VoxelType(s.type), bytes, 1);
    const double a = found.min * s.slope + s.intercept, b = found.max * s.slope + s.intercept;
    for (const VoxelType type : {VoxelType(s.type), VoxelType::Int8, VoxelType::UInt8, VoxelType::Int16,
                                 VoxelType::UInt16, VoxelType::Int32, VoxelType::UInt32}) {
        const auto [least, most] = rangeOf(type);
        if (std::min(a, b) >= least && std::max(a, b) <= most) return type;
    }
    return VoxelType::Double;
}

/// out = in, in the volume's order, × slope + intercept.
template <class In, class Out>
void gather(const StoredVolume& s, const In* in, Out* out) {
    const std::size_t nx = s.size[0], ny = s.size[1], channels = s.channels;
    const bool rescale = s.slope != 1 || s.intercept != 0;
    parallelFor(ny * s.size[2], std::max<std::size_t>(1, kGrain / (nx * channels)),
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t row = begin; row < end; ++row) {
                        const In* from = in + row % ny * s.stride[1] + row / ny * s.stride[2];
                        Out* to = out + row * nx * channels;
                        for (std::size_t i = 0; i < nx; ++i)
                            for (std::size_t c = 0; c < channels; ++c) {
                                const In value = from[i * s.stride[0] + c * s.stride[3]];
                                *to++ = rescale ? Out(double(value) * s.slope + s.intercept) : Out(value);
                            }
                    }
                });
}

}  // namespace

VoxelType loadedType(const StoredVolume& s, std::span<const std::byte> bytes) {
    if (s.slope != 1 || s.intercept != 0) return rescaledType(s, bytes);
    return s.type >= StoredType::Int64 ? VoxelType::Double : VoxelType(s.type);
}

void convert(const StoredVolume& s, std::span<const std::byte> in, VoxelType type, std::span<std::byte> out) {
    withStoredType(s.type, [&](auto stored) {
        using In = decltype(stored);
        withVoxelType(type, [&](auto loaded) {
            using Out = decltype(loaded);
            // Real numbers never become whole ones.
            if constexpr (std::is_integral_v<In> || std::is_floating_point_v<Out>)
                gather(s, reinterpret_cast<const In*>(in.data()), reinterpret_cast<Out*>(out.data()));
        });
    });
}

namespace {

VolumeHeader headerOf(const StoredVolume& s) {
    VolumeHeader header;
    for (int a = 0; a < 3; ++a) header.grid.size[a] = int(s.size[std::size_t(a)]);
    header.grid.channels = int(s.channels);
    header.grid.worldFromIndex = s.worldFromIndex;
    header.format = s.format;
    header.storedType = nameOf(s.type);
    return header;
}

std::string sizeText(const StoredVolume& s) {
    return std::to_string(s.size[0]) + "x" + std::to_string(s.size[1]) + "x" + std::to_string(s.size[2]);
}

/// By how much the volume must be reduced; where it must be, the user is told.
int reductionOf(const Source& source, const StoredVolume& s, VolumeSink& sink) {
    const int factor = sink.mayReduce() ? reductionFor(s, sink.memoryLimit()) : 1;
    if (factor > 1)
        sink.warn(source.name + ": its " + sizeText(s) + " voxels need more than the memory limit of " +
                  readableBytes(sink.memoryLimit()) + "; it is shown at reduced resolution, " +
                  sizeText(reducedBy(factor, s)) + " (1/" + std::to_string(factor) +
                  " along each axis); raise --memory-limit to see it whole");
    return factor;
}

}  // namespace

void load(const Source& source, const StoredVolume& stored, VolumeSink& sink) {
    checkDescription(source, stored, sink);
    if (stored.type >= StoredType::Int64)
        sink.warn(source.name + ": its 64-bit integers are read as double; beyond 2^53 they lose digits");
    const int factor = reductionOf(source, stored, sink);
    const StoredVolume loaded = factor > 1 ? reducedBy(factor, stored) : stored;
    VolumeHeader header = headerOf(loaded);
    const auto fill = [&](std::span<std::byte> values) {
        if (factor > 1) return readReduced(stored, factor, values, sink);
        readValues(stored, values, sink);
        toMachineOrder(stored, values);
    };
    if (isPlain(loaded)) {
        header.type = VoxelType(loaded.type);
        return fill(sink.allocate(source.name, header));
    }
    const std::size_t bytes = std::size_t(neededValues(loaded)) * byteSize(loaded.type);
    const auto buffer = std::make_unique_for_overwrite<std::byte[]>(bytes);
    const std::span values(buffer.get(), bytes);
    fill(values);
    header.type = loadedType(loaded, values);
    convert(loaded, values, header.type, sink.allocate(source.name, header));
}

}  // namespace voledit
