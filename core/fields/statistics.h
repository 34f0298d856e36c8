#pragma once
// Minimum, maximum, mean and histogram of voxels, by whoever fills them.

#include <cstddef>
#include <span>

#include "core/fields/volume.h"

namespace voledit {

/// Statistics of channel 0 of interleaved values of `type`, over finite values only, in parallel; the same for every
/// number of threads. All members are 0 (256 empty bins) where no value is finite. The histogram's bins are
/// [min + b·w, min + (b+1)·w) with w = (max − min) / 256, the last one closed; where all values are one, it is in the
/// last bin. Needs voxels.size() to be a whole number of samples.
VolumeStatistics statisticsOf(VoxelType type, std::span<const std::byte> voxels, int channels);

/// Minimum and maximum alone, in about the time that reading the voxels takes; the histogram is empty and the mean not
/// a number. (Where that is no faster, all of `statisticsOf`.)
VolumeStatistics extremesOf(VoxelType type, std::span<const std::byte> voxels, int channels);

/// All of a volume's statistics: those it came with, counted here where it came with extremes alone, as volumes do from
/// files. Takes a while for large ones: keep what it gives.
VolumeStatistics countedStatistics(const Volume& volume);

}  // namespace voledit
