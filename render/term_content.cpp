#include "render/term_content.h"

#include <glm/ext/matrix_transform.hpp>

#include "render/chain_content.h"
#include "render/slice_variants.h"

namespace voledit {

namespace {
/// Halvings of a step in search of a jump: to a thirty-second of it.
constexpr int kRefinements = 5;
}  // namespace

TermContent::TermContent(SliceWorkshop& workshop, const CompiledScene& scene, double step, double longestRay)
    : workshop_(workshop), bounds_(scene.root->bounds), shaded_(scene.render.shading) {
    if (!workshop.terms.holds(scene.root)) workshop.terms.prepare(makeTermProgram(scene.root));
    workshop.termCells.prepare(scene.root, step * stepsOfSlab() * longestRay, workshop.options.cull);
}

std::vector<SliceContent::Part> TermContent::parts() const {
    return {{&workshop_.termCells.mesh(), glm::translate(Mat4(1), -workshop_.terms.program().origin)}};
}

ProgramVariant TermContent::variant(bool mapped, int) const {
    return termVariant(workshop_.terms.program(), mapped, shaded_);
}

void TermContent::setUniforms(Program& p) const {
    const Vec3 origin = workshop_.terms.program().origin;
    p.set("tables", 0);
    p.set("segments", workshop_.options.segments);
    p.set("refinements", kRefinements);
    p.set("boundsMin", Vec3f(bounds_.min - origin));
    p.set("boundsMax", Vec3f(bounds_.max - origin));
}

std::unique_ptr<SliceContent> makeContent(SliceWorkshop& workshop, const CompiledScene& scene, double step,
                                          double longestRay) {
    if (auto chain = planChain(scene.root))
        return std::make_unique<ChainContent>(workshop, std::move(*chain), scene, step, longestRay);
    return std::make_unique<TermContent>(workshop, scene, step, longestRay);
}

}  // namespace voledit
