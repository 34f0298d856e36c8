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
};

/// Along each of some rows: the voxels that are surely inside lie from `first` to `last`, those that may be from
/// `mayFirst` to `mayLast`; empty where the last is before the first.
struct RowIntervals {
    static constexpr int kRows = 8;
    std::array<std::int32_t, kRows> first, last, mayFirst, mayLast;
};

/// The rows j, j + 1, …, of `rows` (≤ kRows), in slice k, of voxels 0 … length − 1.
void intervalsOfRows(const HalfSpaces& piece, int j, int rows, int k, int length, RowIntervals& result);

/// Voxels first … last of a row, whose samples lie at start + i · step in index space of the volume, inside it.
struct VoxelSpan {
    std::array<double, 3> start, step;
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

/// Fills in the places of a span, clamped to a volume of `size` samples.
void placeSpan(const VoxelSpan& span, const Index3& size, RowPlaces& places);

/// How to reach a volume's voxels: one channel, row after row.
template <class T>
struct VoxelRows {
    const T* voxels;
    Index3 size;
    double range;  // largest less smallest value
};

/// out[i] = the trilinear value at place i, rounded to nearest, where the state is Value; `nothing` elsewhere. Where
/// the rounding of the exact value is in doubt the state becomes Ask; true where one did. T has at most 16 bits.
/// `firstSlice`: the lowest slice that the places touch.
template <class T>
bool valuesOfRow(const VoxelRows<T>& rows, int firstSlice, RowPlaces& places, T nothing, std::span<T> out);

}  // namespace voledit
