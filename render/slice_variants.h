#pragma once
// The variants of the slice program.

#include <vector>

#include "render/shader_library.h"

namespace voledit {

struct SliceVariant {
    bool mapped = false;  // polygons carry source coordinates and Jacobians
    bool shaded = true;
    bool gradientOpacity = false;
    bool realVoxels = false;           // voxels may be NaN
    int segments = 2, subsamples = 4;  // SliceOptions
};

ProgramVariant sliceVariant(const SliceVariant& variant);

/// Every program that the renderers use, for tests that compile them all.
std::vector<ProgramVariant> allPrograms();

}  // namespace voledit
