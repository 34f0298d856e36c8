#include "render/slice_variants.h"

namespace voledit {

ProgramVariant sliceVariant(const SliceVariant& variant) {
    ProgramVariant program{"slice.vert", "slice.frag", {}};
    if (variant.mapped) program.defines.push_back("MAPPED");
    if (variant.shaded) program.defines.push_back("SHADED");
    if (variant.gradientOpacity) program.defines.push_back("GRADIENT_OPACITY");
    if (variant.realVoxels) program.defines.push_back("REAL_VOXELS");
    program.defines.push_back("SEGMENTS=" + std::to_string(variant.segments));
    program.defines.push_back("SUBSAMPLES=" + std::to_string(variant.subsamples));
    return program;
}

std::vector<ProgramVariant> allPrograms() {
    std::vector<ProgramVariant> programs{{"fullscreen.vert", "mask.frag", {}}, {"overlay.vert", "overlay.frag", {}}};
    for (int bits = 0; bits < 16; ++bits)
        programs.push_back(sliceVariant({.mapped = (bits & 1) != 0,
                                         .shaded = (bits & 2) != 0,
                                         .gradientOpacity = (bits & 4) != 0,
                                         .realVoxels = (bits & 8) != 0}));
    return programs;
}

}  // namespace voledit
