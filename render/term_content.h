#pragma once
// Slices of any term, by a generated program.

#include "render/slice_content.h"
#include "render/slice_picture.h"

namespace voledit {

class TermContent final : public SliceContent {
public:
    TermContent(SliceWorkshop& workshop, const CompiledScene& scene, double step, double longestRay);

    std::vector<Part> parts() const override;
    const Visibility& visibility() const override { return everything_; }
    Box3 domain() const override { return {}; }
    int stepsOfSlab() const override { return workshop_.options.segments; }
    ProgramVariant variant(const Part& part, int pass) const override;
    void setUniforms(Program& program) const override;
    void bind() const override { workshop_.terms.bind(); }

private:
    SliceWorkshop& workshop_;
    TermPlan plan_;
    Visibility everything_;
    bool shaded_;
};

}  // namespace voledit
