#include "render/chain_content.h"

#include <glm/matrix.hpp>

#include "core/objects/seen_part.h"
#include "core/stf/source_solid.h"
#include "render/slice_variants.h"

namespace voledit {

namespace {

bool isReal(VoxelType type) {
    return type == VoxelType::Float || type == VoxelType::Double;
}

/// True where a point may have several pre-images, or one that is not of a cell.
bool needsFolding(const TransferTerm& forward) {
    return forward.by->outside() == Outside::Keep || forward.by->cells()->mayOverlap();
}

/// True where a pre-image in which nothing is seen still decides.
bool coverCounts(const TransferTerm& forward) {
    return forward.by->outside() == Outside::Keep || forward.combine == Combine::First ||
           forward.combine == Combine::Intersection;
}

}  // namespace

ChainContent::ChainContent(SliceWorkshop& workshop, SlicePlan plan, const CompiledScene& scene, double step,
                           double longestRay)
    : workshop_(workshop),
      plan_(std::move(plan)),
      shaded_(scene.render.shading),
      folded_(plan_.forward && needsFolding(*plan_.forward)) {
    const bool cullCells = workshop.options.cull && !(folded_ && coverCounts(*plan_.forward));
    const bool separate = folded_ && !coverCounts(*plan_.forward) && plan_.located.empty();
    workshop.resources.prepare(plan_, {workshop.options.cull, cullCells, step * stepsOfSlab() * longestRay, separate});
}

int ChainContent::stepsOfSlab() const {
    // Pre-images combine sample by sample, so a slice is one step.
    return folded_ ? 1 : workshop_.options.segments;
}

std::optional<Combine> ChainContent::folded() const {
    return folded_ ? std::optional(plan_.forward->combine) : std::nullopt;
}

std::vector<SliceContent::Part> ChainContent::parts() const {
    const SliceResources& resources = workshop_.resources;
    std::vector<Part> parts{{&resources.mesh(), resources.entryFromSource(), false}};
    if (resources.alone()) parts.push_back({resources.alone(), resources.entryFromSource(), true});
    if (resources.uncovered())
        parts.push_back(
            {resources.uncovered(), resources.entryFromSource() * glm::inverse(plan_.worldFromDeformed), false});
    return parts;
}

const Visibility& ChainContent::visibility() const {
    return workshop_.resources.visibility();
}

Box3 ChainContent::domain() const {
    return plan_.volume->volume->grid().indexDomain();
}

ProgramVariant ChainContent::variant(const Part& part, int pass) const {
    const VolumeTerm& volume = *plan_.volume;
    const SliceVariant variant{.mapped = part.mesh->kind == CellMesh::Kind::Tetrahedron,
                               .located = !plan_.located.empty(),
                               .shaded = shaded_,
                               .gradientOpacity = !volume.appearance.gradientOpacity.points.empty(),
                               .realVoxels = isReal(volume.volume->type()),
                               .segments = stepsOfSlab(),
                               .subsamples = workshop_.options.subsamples};
    if (!folded_ || part.alone) return sliceVariant(variant);
    return foldVariant(variant, plan_.forward->combine, pass, coverCounts(*plan_.forward));
}

CutFaces ChainContent::findCutFaces() const {
    if (!plan_.forward) return {domain()};
    const auto next = workshop_.resources.nextFromSource();
    std::vector<std::vector<Vec4>> planes{
        sourceFacesIn(*plan_.forward->by->cells(), workshop_.resources.entryFromSource())};
    for (std::size_t m = 0; m < next.size(); ++m)
        planes.push_back(sourceFacesIn(*plan_.located[m].transfer->by->cells(), next[m]));
    planes.back() = facesThrough(std::move(planes.back()), domain());
    return cutFaces(domain(), std::move(planes));
}

void ChainContent::setUniforms(Program& p) const {
    const Volume& volume = *plan_.volume->volume;
    const Box3 domain = volume.grid().indexDomain();
    const VolumeTexture& texture = workshop_.resources.volume();
    const TransferTable& table = workshop_.resources.table();
    const double entriesPerValue = (TransferTable::kSize - 1) / (table.high - table.low);

    p.set("volume", 0);
    p.set("thicknessTable", 1);
    p.set("colorTable", 2);
    p.set("gradientTable", 3);
    p.set("volumeLast", Vec3f(volume.grid().size - 1));
    p.set("texelPerIndex", Vec3f(1.0 / Vec3(volume.grid().size)));
    const CutFaces faces = findCutFaces();
    // Slabs end where cells do; but what a map keeps outside its cells goes on.
    const Box3 ends = plan_.located.empty() && !anyMayCombine(*plan_.root) ? faces.box : domain;
    p.set("domainMin", Vec3f(ends.min - 1e-3));
    p.set("domainMax", Vec3f(ends.max + 1e-3));
    // As CutFinder has it: none where pre-images combine.
    if (anyMayCombine(*plan_.root)) p.set("cutThickness", 0.0F);
    setCutFaces(p, faces);
    p.set("tableScale", float(texture.valueScale * entriesPerValue));
    p.set("tableOffset", float((texture.valueOffset - table.low) * entriesPerValue));
    p.set("tableSize", float(TransferTable::kSize));
    p.set("visibleEntries", Vec2f(table.firstVisible, table.lastVisible));
    p.set("gradientScale", float((TransferTable::kSize - 1) / table.gradientHigh));
    p.set("gradientUnit", float(texture.valueScale));
    p.set("restFromIndexGradient", Mat3f(glm::transpose(Mat3(volume.indexFromWorld()))));
    p.set("locatedCount", int(plan_.located.size()));
}

void ChainContent::bind() const {
    workshop_.resources.bind();
}

}  // namespace voledit
