#include "render/slice_variants.h"

#include <algorithm>
#include <array>

namespace voledit {

namespace {
std::vector<std::string> commonDefines(const SliceVariant& variant) {
    std::vector<std::string> defines;
    if (variant.mapped) defines.push_back("MAPPED");
    if (variant.located) defines.push_back("LOCATED");
    if (variant.shaded) defines.push_back("SHADED");
    if (variant.gradientOpacity) defines.push_back("GRADIENT_OPACITY");
    if (variant.realVoxels) defines.push_back("REAL_VOXELS");
    return defines;
}
}  // namespace

ProgramVariant sliceVariant(const SliceVariant& variant) {
    ProgramVariant program{"slice.vert", "slice.frag", commonDefines(variant)};
    program.defines.push_back("SEGMENTS=" + std::to_string(variant.segments));
    program.defines.push_back("SUBSAMPLES=" + std::to_string(variant.subsamples));
    return program;
}

ProgramVariant foldVariant(const SliceVariant& variant, Combine combine, int pass, bool cover) {
    ProgramVariant program{"slice.vert", "fold.frag", commonDefines(variant)};
    if (cover) program.defines.push_back("COVER");
    if (combine == Combine::First) program.defines.push_back("FIRST");
    if (combine == Combine::Merge && pass == 0) program.defines.push_back("ADD");
    return program;
}

ProgramVariant foldCompositeVariant(Combine combine) {
    ProgramVariant program{"fullscreen.vert", "fold_composite.frag", {}};
    if (combine == Combine::Merge) program.defines.push_back("MERGE");
    if (combine == Combine::Intersection) program.defines.push_back("INTERSECTION");
    return program;
}

ProgramVariant marchVariant(const MarchVariant& variant) {
    ProgramVariant program{"fullscreen.vert", "march.frag", {"STEPS=" + std::to_string(variant.steps)}};
    if (variant.baked) program.defines.push_back("BAKED");
    if (variant.shaded) program.defines.push_back("SHADED");
    if (variant.realVoxels) program.defines.push_back("REAL_VOXELS");
    return program;
}

ProgramVariant termVariant(const TermProgram& program, bool mapped, bool shaded) {
    ProgramVariant variant{"slice.vert", "term.frag", program.defines(), program.text};
    if (mapped) variant.defines.push_back("MAPPED");
    if (shaded) variant.defines.push_back("SHADED");
    return variant;
}

ProgramVariant withSurroundings(ProgramVariant variant) {
    const auto& defines = variant.defines;
    if (std::find(defines.begin(), defines.end(), "SHADED") != defines.end()) variant.defines.push_back("SURROUNDINGS");
    return variant;
}

std::vector<ProgramVariant> allPrograms() {
    std::vector<ProgramVariant> programs{{"fullscreen.vert", "mask.frag", {}}, {"overlay.vert", "overlay.frag", {}}};
    const std::array<Combine, 4> combines{Combine::Union, Combine::Merge, Combine::Intersection, Combine::First};
    for (const Combine combine : combines) programs.push_back(foldCompositeVariant(combine));
    for (int bits = 0; bits < 32; ++bits) {
        const SliceVariant variant{.mapped = (bits & 1) != 0,
                                   .located = (bits & 16) != 0,
                                   .shaded = (bits & 2) != 0,
                                   .gradientOpacity = (bits & 4) != 0,
                                   .realVoxels = (bits & 8) != 0};
        SliceVariant oneStep = variant;
        oneStep.segments = 1;
        if (variant.mapped || !variant.located)
            for (const SliceVariant& either : {variant, oneStep}) programs.push_back(sliceVariant(either));
        for (const Combine combine : combines)
            for (const int pass : {0, 1})
                for (const bool cover : {false, true}) programs.push_back(foldVariant(variant, combine, pass, cover));
    }
    for (const bool shaded : {false, true})
        for (const bool realVoxels : {false, true}) {
            programs.push_back(marchVariant({.shaded = shaded, .realVoxels = realVoxels}));
            for (const int steps : {1, 2, 4, 5})
                programs.push_back(
                    marchVariant({.baked = true, .shaded = shaded, .realVoxels = realVoxels, .steps = steps}));
        }
    const std::size_t plain = programs.size();
    for (std::size_t n = 0; n < plain; ++n) programs.push_back(withSurroundings(programs[n]));
    std::sort(programs.begin(), programs.end());
    programs.erase(std::unique(programs.begin(), programs.end()), programs.end());
    return programs;
}

}  // namespace voledit
