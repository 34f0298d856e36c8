#pragma once
// Volumes larger than the memory limit, at reduced resolution: means of boxes of voxels, read a few rows at a time.

#include "app/io/stored_volume.h"

namespace voledit {

/// The smallest power of two by which each axis must be shortened so that the loaded volume takes at most `limit`
/// bytes; 1 where it need not be, or cannot: numbers written as text, unusual orders of the axes.
int reductionFor(const StoredVolume& stored, std::uint64_t limit);

/// The description of `stored` reduced by `factor`: samples are the means of boxes of factor³ samples (fewer along an
/// axis that has fewer) and stand in the boxes' middles; what fills no last box is left out. Values in the usual order.
StoredVolume reducedBy(int factor, const StoredVolume& stored);

/// Reads the values of `reducedBy(factor, stored)` into `out`, as numbers of `stored.type` in the machine's byte order;
/// means of whole numbers are rounded, halves away from zero. Throws Error.
void readReduced(const StoredVolume& stored, int factor, std::span<std::byte> out, VolumeSink& sink);

}  // namespace voledit
