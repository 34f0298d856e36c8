#pragma once
// The variants of the slice program.

#include <vector>

#include "core/objects/term.h"
#include "render/shader_library.h"
#include "render/term_program.h"

namespace voledit {

struct SliceVariant {
    bool mapped = false;   // polygons carry source coordinates and Jacobians
    bool located = false;  // fragments locate their points in further maps
    bool shaded = true;
    bool gradientOpacity = false;
    bool realVoxels = false;           // voxels may be NaN
    int segments = 2, subsamples = 2;  // SliceOptions
};

ProgramVariant sliceVariant(const SliceVariant& variant);
/// The program of one pass over pre-images that combine (fold_target.h).
/// @param cover  pre-images in which nothing is seen count
ProgramVariant foldVariant(const SliceVariant& variant, Combine combine, int pass, bool cover);
ProgramVariant foldCompositeVariant(Combine combine);

/// The program whose fragments walk rays through one volume.
struct MarchVariant {
    bool baked = false;  // the volume lies under a map
    bool shaded = true;
    bool realVoxels = false;  // voxels may be NaN
    int steps = 4;            // of a block
};
ProgramVariant marchVariant(const MarchVariant& variant);

/// The program of a term.
ProgramVariant termVariant(const TermProgram& program, bool mapped, bool shaded);

/// The same with shadows and occlusion; only where it is lit.
ProgramVariant withSurroundings(ProgramVariant variant);

/// Every program that the renderers use, for tests that compile them all.
std::vector<ProgramVariant> allPrograms();

}  // namespace voledit
