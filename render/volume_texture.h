#pragma once
// Volumes on the GPU.

#include "core/fields/volume.h"
#include "render/gl_objects.h"

namespace voledit {

/// One channel of a volume as a 3-D texture with linear filtering in floats. 8- and 16-bit integers lie in R8 and R16;
/// other types in R32F, to which 32-bit integers and doubles are rounded.
struct VolumeTexture {
    Texture texture;
    double valueScale = 1;  // data value = raw · valueScale + valueOffset, raw being what the texture gives
    double valueOffset = 0;
};

/// Uploads `channel` of `volume`, a few slices at a time. Throws Error where an axis is longer than the GPU allows or
/// its memory is full.
VolumeTexture makeVolumeTexture(const Volume& volume, int channel);

}  // namespace voledit
