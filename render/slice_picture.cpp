#include "render/slice_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/base/paths.h"
#include "core/stf/mapped_cells.h"
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

SliceWorkshop::SliceWorkshop(const SliceOptions& o) : options(o), shaders(shaderFolder()) {}

SlicePicture::SlicePicture(SliceWorkshop& workshop, const CompiledScene& scene, Index2 size, double stepScale)
    : workshop_(workshop), plan_(planSlices(scene.root)), view_(makeView(scene.camera, size)) {
    folded_ = plan_.forward && needsFolding(*plan_.forward);
    if (folded_) combine_ = plan_.forward->combine;
    // Pre-images combine sample by sample, so a slice is one step.
    slabDepth_ = scene.stepLength() * stepScale * (folded_ ? 1 : workshop.options.segments);
    const bool cullCells = workshop.options.cull && !(folded_ && coverCounts(*plan_.forward));
    SliceResources& resources = workshop.resources;
    resources.prepare(plan_, {workshop.options.cull, cullCells, slabDepth_ * view_.longestRay()});
    workshop.target.start(size);
    if (folded_) workshop.fold.resize(size);
    addLayer(resources.mesh(), resources.entryFromSource(), scene);
    if (resources.uncovered())
        addLayer(*resources.uncovered(), resources.entryFromSource() * glm::inverse(plan_.worldFromDeformed), scene);
    layOut();
    for (const Layer& layer : layers_)
        for (Program* program : layer.programs)
            if (program) setUniforms(*program, layer, scene);
    if (folded_) setCompositeUniforms(scene);
}

void SlicePicture::addLayer(const CellMesh& mesh, const Mat4& indexFromWorld, const CompiledScene& scene) {
    const bool mapped = mesh.kind == CellMesh::Kind::Tetrahedron;
    std::array<Program*, 2> programs{&programOf(mapped, 0, scene), nullptr};
    if (folded_ && FoldTarget::passes(combine_) == 2) programs[1] = &programOf(mapped, 1, scene);
    layers_.push_back(
        {mapped, indexFromWorld,
         CellSlicer(mesh, view_, plan_.volume->volume->grid().indexDomain(), workshop_.resources.visibility()),
         mapped ? &workshop_.cells : &workshop_.bricks, mapped ? &workshop_.cellBatches : &workshop_.brickBatches,
         programs});
    statistics_.cells += mesh.cellCount();
    statistics_.culledCells += mesh.culled;
}

Program& SlicePicture::programOf(bool mapped, int pass, const CompiledScene& scene) {
    const VolumeTerm& volume = *plan_.volume;
    SliceVariant variant{.mapped = mapped,
                         .located = !plan_.located.empty(),
                         .shaded = scene.render.shading,
                         .gradientOpacity = !volume.appearance.gradientOpacity.points.empty(),
                         .realVoxels = isReal(volume.volume->type()),
                         .segments = workshop_.options.segments,
                         .subsamples = workshop_.options.subsamples};
    if (!folded_) return workshop_.shaders.get(sliceVariant(variant));
    return workshop_.shaders.get(foldVariant(variant, combine_, pass, coverCounts(*plan_.forward)));
}

void SlicePicture::layOut() {
    double end = -kInfinity, nearest = kInfinity, farthest = -kInfinity;
    start_ = kInfinity;
    Index2 low = view_.size, high(0);
    for (const Layer& layer : layers_) {
        start_ = std::min(start_, layer.slicer.start());
        end = std::max(end, 2 * layer.slicer.middle() - layer.slicer.start());
        nearest = std::min(nearest, layer.slicer.nearest());
        farthest = std::max(farthest, layer.slicer.farthest());
        const auto [x, y, width, height] = layer.slicer.window();
        low = glm::min(low, Index2(x, y));
        high = glm::max(high, Index2(x + width, y + height));
    }
    if (!(nearest < farthest)) return;
    referenceDepth_ = (start_ + end) / 2;
    window_ = {low.x, low.y, std::max(high.x - low.x, 0), std::max(high.y - low.y, 0)};
    const double first = std::floor((nearest - start_) / slabDepth_),
                 last = std::ceil((farthest - start_) / slabDepth_);
    firstBatch_ = nextBatch_ = int(first) / kBatchSlices;
    endBatch_ = (int(last) + kBatchSlices - 1) / kBatchSlices;
    statistics_.slices = int(last - first);
}

void SlicePicture::setUniforms(Program& p, const Layer& layer, const CompiledScene& scene) const {
    const Volume& volume = *plan_.volume->volume;
    const Mat3 rays(view_.rayAtOrigin(), view_.rayPerPixelX(), view_.rayPerPixelY());
    const Mat3 indexFromWorld(layer.indexFromWorld);
    Mat3 atReference = referenceDepth_ * (indexFromWorld * rays);
    atReference[0] += transformPoint(layer.indexFromWorld, view_.eye);
    const Box3 domain = volume.grid().indexDomain();
    const VolumeTexture& texture = workshop_.resources.volume();
    const TransferTable& table = workshop_.resources.table();
    const double entriesPerValue = (TransferTable::kSize - 1) / (table.high - table.low);
    const RenderSettings& render = scene.render;
    const Vec3 light = render.light ? glm::normalize(*render.light) : Vec3(0);

    p.set("volume", 0);
    p.set("thicknessTable", 1);
    p.set("colorTable", 2);
    p.set("gradientTable", 3);
    p.set("rayPerDepth", Mat3f(rays));
    p.set("indexAtReference", Mat3f(atReference));
    p.set("indexPerDepth", Mat3f(indexFromWorld * rays));
    p.set("indexFromWorld", Mat3f(indexFromWorld));
    p.set("volumeLast", Vec3f(volume.grid().size - 1));
    p.set("texelPerIndex", Vec3f(1.0 / Vec3(volume.grid().size)));
    p.set("domainMin", Vec3f(domain.min - 1e-3));
    p.set("domainMax", Vec3f(domain.max + 1e-3));
    p.set("tableScale", float(texture.valueScale * entriesPerValue));
    p.set("tableOffset", float((texture.valueOffset - table.low) * entriesPerValue));
    p.set("tableSize", float(TransferTable::kSize));
    p.set("visibleEntries", Vec2f(table.firstVisible, table.lastVisible));
    p.set("gradientScale", float((TransferTable::kSize - 1) / table.gradientHigh));
    p.set("gradientUnit", float(texture.valueScale));
    p.set("restFromIndexGradient", Mat3f(glm::transpose(Mat3(volume.indexFromWorld()))));
    p.set("locatedCount", int(plan_.located.size()));
    p.set("slabDepth", float(slabDepth_));
    p.set("opacityDistance", float(scene.opacityDistance));
    p.set("lighting", Vec4f(render.ambient, render.diffuse, render.specular, render.shininess));
    p.set("towardLight", Vec4f(light, render.light ? 1 : 0));
}

void SlicePicture::setCompositeUniforms(const CompiledScene& scene) {
    composite_ = &workshop_.shaders.get(foldCompositeVariant(combine_));
    composite_->set("sampled", 0);
    composite_->set("lit", 1);
    composite_->set("rayPerDepth", Mat3f(Mat3(view_.rayAtOrigin(), view_.rayPerPixelX(), view_.rayPerPixelY())));
    composite_->set("slabDepth", float(slabDepth_));
    composite_->set("opacityDistance", float(scene.opacityDistance));
}

void SlicePicture::cut(int count) {
    for (const Layer& layer : layers_) layer.batches->resize(std::max(layer.batches->size(), std::size_t(count)));
    parallelFor(std::size_t(count), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const double first = double(nextBatch_ + int(n)) * kBatchSlices + 0.5;
            for (const Layer& layer : layers_)
                layer.slicer.cut(start_ + slabDepth_ * first, slabDepth_, kBatchSlices, referenceDepth_,
                                 (*layer.batches)[n]);
        }
    });
}

void SlicePicture::draw(int count) {
    count = std::min(count, endBatch_ - nextBatch_);
    cut(count);
    for (int n = 0; n < count; ++n) {
        folded_ ? drawFolded(n) : drawBatch(n);
        ++nextBatch_;
        for (const Layer& layer : layers_) statistics_.polygons += (*layer.batches)[std::size_t(n)].polygons;
        if (workshop_.options.mask && nextBatch_ < endBatch_) workshop_.target.mask(workshop_.shaders, window_);
    }
}

void SlicePicture::drawBatch(int number) {
    workshop_.target.bind();
    workshop_.resources.bind();
    for (const Layer& layer : layers_) {
        const SliceBatch& batch = (*layer.batches)[std::size_t(number)];
        layer.programs[0]->use();
        layer.geometry->upload(batch);
        layer.geometry->draw(0, batch.indices.size());
    }
}

void SlicePicture::drawFolded(int number) {
    for (const Layer& layer : layers_) layer.geometry->upload((*layer.batches)[std::size_t(number)]);
    for (std::size_t slice = 0; slice < kBatchSlices; ++slice) {
        const auto empty = [&](const Layer& layer) {
            const auto& first = (*layer.batches)[std::size_t(number)].firstIndex;
            return first[slice] == first[slice + 1];
        };
        if (std::all_of(layers_.begin(), layers_.end(), empty)) continue;
        workshop_.target.bind();  // the common state
        glEnable(GL_SCISSOR_TEST);
        glScissor(window_[0], window_[1], window_[2], window_[3]);
        workshop_.resources.bind();
        for (int pass = 0; pass < FoldTarget::passes(combine_); ++pass) {
            workshop_.fold.start(combine_, pass);
            for (const Layer& layer : layers_) {
                layer.mapped ? workshop_.fold.drawCells() : workshop_.fold.drawUncovered();
                layer.programs[std::size_t(pass)]->use();
                const auto& first = (*layer.batches)[std::size_t(number)].firstIndex;
                layer.geometry->draw(first[slice], first[slice + 1]);
            }
        }
        workshop_.target.bind();
        workshop_.fold.bindTextures();
        workshop_.target.drawWindow(*composite_, window_);
    }
}

}  // namespace voledit
