#pragma once
// Slices of a chain of forward and affine maps over one volume.

#include "render/cut_uniforms.h"
#include "render/slice_content.h"
#include "render/slice_picture.h"

namespace voledit {

class ChainContent final : public SliceContent {
public:
    ChainContent(SliceWorkshop& workshop, SlicePlan plan, const CompiledScene& scene, double step, double longestRay);

    std::vector<Part> parts() const override;
    const Visibility& visibility() const override;
    Box3 domain() const override;
    int stepsOfSlab() const override;
    std::optional<Combine> folded() const override;
    ProgramVariant variant(const Part& part, int pass) const override;
    void setUniforms(Program& program) const override;
    void bind() const override;

private:
    /// Those of the volume's box and of the solids that the maps' cells come from.
    CutFaces findCutFaces() const;

    SliceWorkshop& workshop_;
    SlicePlan plan_;
    bool shaded_, folded_;
};

}  // namespace voledit
