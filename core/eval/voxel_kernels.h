#pragma once
// Rows of voxels by vector instructions: where tetrahedra cross them, where their samples lie, what these hold.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// A convex piece as half-spaces c + x·i + y·j + z·k ≥ 0 over the indices of voxels: where such a number is above
/// `guard`, rounding or not, the voxel is on the inner side; below −guard it is not.
struct HalfSpaces {
    static constexpr std::size_t kMost = 4;
    std::array<double, kMost> c, x, y, z, guard;
    std::array<double, kMost> perX;  // 1 / x; whatever where x is 0
};

/// Along each of some rows: the voxels that are surely inside lie from `first` to `last`, those that may be from
/// `mayFirst` to `mayLast`; empty where the last is before the first.
struct RowIntervals {
    static constexpr int kRows = 8;
    std::array<std::int32_t, kRows> first, last, mayFirst, mayLast;
    unsigned any;    // bits of the rows that may hold some
    unsigned plain;  // of those where nothing is in doubt
};

/// The rows j, j + 1, …, of `rows` (≤ kRows), in the slices k, k + 1, … (result[0], result[1], …), of voxels
/// 0 … length − 1.
void intervalsOfRows(const HalfSpaces& piece, int j, int rows, int k, int length, std::span<RowIntervals> result);

/// Where voxels have their samples: start + i · alongI + j · alongJ + k · alongK, three numbers and a fourth that fills
/// a vector. In index space of the volume, or in units of RowPlaces.
struct SamplePlaces {
    std::array<double, 4> start, alongI, alongJ, alongK;
    std::array<std::int32_t, 4> step{};  // alongI rounded, where that is in units
};

/// Voxels first … last of a row, whose samples lie inside the volume, where `places` of a list says.
struct VoxelSpan {
    std::uint32_t places;
    std::int32_t first, last;
};

/// Places of a row's samples as fixed-point numbers, and whether there is one.
struct RowPlaces {
    static constexpr int kMostVoxels = 8192;  // of an axis of the volume
    enum State : std::uint8_t { Nothing = 0, Value = 1, Ask = 2 };

    /// For a volume of `size`, each axis 2 … kMostVoxels: as many bits as leave room for its places.
    explicit RowPlaces(const Index3& size);
    /// All of them Nothing.
    void clear(std::size_t length);

    int bits;  // behind the point

    std::array<std::vector<std::int32_t>, 3> at;
    std::vector<std::uint8_t> state;
};

/// Fills in the places of spans of row (j, k), from left to right, clamped to a volume of `size` samples. `list` is in
/// units, and places are off by at most `kPlaceError` of them.
void placeSpans(std::span<const VoxelSpan> spans, std::span<const SamplePlaces> list, int j, int k, const Index3& size,
                RowPlaces& places);
inline constexpr float kPlaceError = 3.5F;

/// How to reach a volume's voxels: one channel, row after row.
template <class T>
struct VoxelRows {
    const T* voxels;
    Index3 size;
    double range;  // largest less smallest value
};

/// out[i] = the trilinear value at place i, rounded to nearest, where the state is Value; `nothing` elsewhere. Where
/// the rounding of the exact value is in doubt the state becomes Ask; true where one did. T has at most 16 bits; the
/// volume has less than 2³¹ bytes.
template <class T>
bool valuesOfRow(const VoxelRows<T>& rows, RowPlaces& places, T nothing, std::span<T> out);

}  // namespace voledit
