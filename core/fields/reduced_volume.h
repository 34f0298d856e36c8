#pragma once
// Volumes at reduced resolution, for what cannot hold them whole.

#include <memory>

#include "core/fields/volume.h"

namespace voledit {

/// Means of boxes of `box` samples (each ≥ 1, at most the volume's size), standing in the boxes' middles; what fills no
/// last box is left out. Of the same type: means of whole numbers are rounded, halves away from zero. In parallel.
std::shared_ptr<const Volume> reducedVolume(const Volume& volume, const Index3& box);

}  // namespace voledit
