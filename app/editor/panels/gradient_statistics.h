#pragma once
// How steeply a volume's values change: what the editor of the opacity over the gradient's magnitude shows.

#include "core/fields/volume.h"

namespace voledit {

/// Magnitudes of the gradient, data units per world unit, at some ten thousand voxels spread evenly over the volume
/// (always the same). `max` is what all but a thousandth of them keep below; above it nothing is counted.
VolumeStatistics gradientStatistics(const Volume& volume);

}  // namespace voledit
