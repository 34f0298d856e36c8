#include "render/slice_variants.h"

namespace voledit {

ProgramVariant sliceVariant(const SliceVariant& variant) {
    ProgramVariant program{"slice.vert", "slice.frag", {}};
    if (variant.mapped) program.defines.push_back("MAPPED");
    if (variant.shaded) program.defines.push_back("SHADED");
    if (variant.gradientOpacity) program.defines.push_back("GRADIENT_OPACITY");
    program.defines.push_back("SEGMENTS=" + std::to_string(variant.segments));
    program.defines.push_back("SUBSAMPLES=" + std::to_string(variant.subsamples));
    return program;
}

std::vector<ProgramVariant> allPrograms() {
    std::vector<ProgramVariant> programs{{"fullscreen.vert", "mask.frag", {}}, {"overlay.vert", "overlay.frag", {}}};
    for (const bool mapped : {false, true})
        for (const bool shaded : {false, true})
            for (const bool gradientOpacity : {false, true})
                programs.push_back(
                    sliceVariant({.mapped = mapped, .shaded = shaded, .gradientOpacity = gradientOpacity}));
    return programs;
}

}  // namespace voledit
