#pragma once
// How packets reach a volume's voxels.

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/fields/volume.h"

namespace voledit {

enum class VoxelKind : std::uint8_t { Bits8, Bits16, Bits32, Float };

/// Voxels of one channel as bytes, sizes and distances between neighbours in values.
struct VoxelAccess {
    const std::byte* voxels = nullptr;
    std::size_t bytes = 0;
    VoxelKind kind = VoxelKind::Bits8;
    std::array<int, 3> size{2, 2, 2};
    int row = 2, slice = 4;
    std::array<float, 3> beforeLast{};  // the largest number below the last sample's index, on each axis
    std::int32_t flip = 0;              // turns the sign bits of signed numbers, which are then unsigned …
    float bias = 0;                     // … and too large by this
};

VoxelAccess voxelAccess(const Volume& volume);

/// Differences of one voxel along the index axes at x, as volume.h defines them, everywhere.
std::array<float, 3> differencesAt(const Volume& volume, const std::array<float, 3>& x);

}  // namespace voledit
