#include "render/term_content.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>

#include "core/objects/seen_part.h"
#include "render/chain_content.h"
#include "render/slice_variants.h"

namespace voledit {

namespace {
/// Halvings of a step in search of a jump: to a thirty-second of it.
constexpr int kRefinements = 5;
}  // namespace

TermContent::TermContent(SliceWorkshop& workshop, const CompiledScene& scene, double step, double longestRay)
    : workshop_(workshop), plan_(planTerm(scene.root)), shaded_(scene.render.shading) {
    if (!workshop.terms.holds(plan_.drawn)) workshop.terms.prepare(makeTermProgram(plan_.drawn));
    workshop.termMesh.prepare(plan_, workshop.terms.program().origin, step * stepsOfSlab() * longestRay,
                              workshop.options.cull);
}

std::vector<SliceContent::Part> TermContent::parts() const {
    return {{&workshop_.termMesh.mesh(), glm::translate(Mat4(1), -workshop_.terms.program().origin), false}};
}

ProgramVariant TermContent::variant(const Part& part, int) const {
    return termVariant(workshop_.terms.program(), part.mesh->kind == CellMesh::Kind::Tetrahedron, shaded_);
}

void TermContent::setUniforms(Program& p) const {
    const Vec3 origin = workshop_.terms.program().origin;
    p.set("tables", 0);
    // Rays that pass less than a part of a solid may miss it.
    p.set("segments", stepsOfSlab() * (plan_.solids ? 2 : 1));
    p.set("refinements", kRefinements);
    const Vec3 size = plan_.bounds.size();
    p.set("boundsMin", Vec3f(plan_.bounds.min - origin));
    p.set("boundsMax", Vec3f(plan_.bounds.max - origin));
    if (!holdsData(*plan_.drawn) || anyMayCombine(*plan_.root)) p.set("cutThickness", 0.0F);
    p.set("rounding", float(1e-6 * std::max({size.x, size.y, size.z})));
}

std::unique_ptr<SliceContent> makeContent(SliceWorkshop& workshop, const CompiledScene& scene, double step,
                                          double longestRay) {
    if (auto chain = planChain(scene.root))
        return std::make_unique<ChainContent>(workshop, std::move(*chain), scene, step, longestRay);
    return std::make_unique<TermContent>(workshop, scene, step, longestRay);
}

}  // namespace voledit
