#include "render/slice_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/base/paths.h"
#include "core/eval/cut_faces.h"
#include "render/slice_variants.h"

namespace voledit {

SliceWorkshop::SliceWorkshop(const SliceOptions& o) : options(o), shaders(shaderFolder()) {}

SlicePicture::SlicePicture(SliceWorkshop& workshop, const CompiledScene& scene, Index2 size, double stepScale)
    : workshop_(workshop), view_(makeView(scene.camera, size)) {
    const double step = scene.stepLength() * stepScale;
    content_ = makeContent(workshop, scene, step, view_.longestRay());
    folded_ = content_->folded();
    slabDepth_ = step * content_->stepsOfSlab();
    const Surroundings surroundings(scene);
    surrounded_ = !surroundings.none();
    if (surrounded_) workshop.surroundings.prepare(surroundings);
    workshop.target.start(size, true);
    if (folded_) workshop.fold.resize(size);
    for (const SliceContent::Part& part : content_->parts()) addLayer(part);
    layOut();
    for (const Layer& layer : layers_)
        for (Program* program : layer.programs)
            if (program) setUniforms(*program, layer, scene);
    if (folded_) setCompositeUniforms(scene);
    statistics_.programsCompiled = workshop.shaders.compiled();
}

void SlicePicture::addLayer(const SliceContent::Part& part) {
    const bool mapped = part.mesh->kind == CellMesh::Kind::Tetrahedron;
    const auto programOf = [&](int pass) {
        const ProgramVariant variant = content_->variant(part, pass);
        return &workshop_.shaders.get(surrounded_ ? withSurroundings(variant) : variant);
    };
    std::array<Program*, 2> programs{programOf(0), nullptr};
    if (folded_ && !part.alone && FoldTarget::passes(*folded_) == 2) programs[1] = programOf(1);
    SliceWorkshop& w = workshop_;
    layers_.push_back({mapped, part.alone, part.placeFromWorld,
                       CellSlicer(*part.mesh, view_, content_->domain(), content_->visibility()),
                       part.alone ? &w.aloneCells
                       : mapped   ? &w.cells
                                  : &w.bricks,
                       part.alone ? &w.aloneBatches
                       : mapped   ? &w.cellBatches
                                  : &w.brickBatches,
                       programs});
    statistics_.cells += part.mesh->cellCount();
    statistics_.culledCells += part.mesh->culled;
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
    const Mat3 rays(view_.rayAtOrigin(), view_.rayPerPixelX(), view_.rayPerPixelY());
    const Mat3 placeFromWorld(layer.placeFromWorld);
    Mat3 atReference = referenceDepth_ * (placeFromWorld * rays);
    atReference[0] += transformPoint(layer.placeFromWorld, view_.eye);

    p.set("rayPerDepth", Mat3f(rays));
    p.set("indexAtReference", Mat3f(atReference));
    p.set("indexPerDepth", Mat3f(placeFromWorld * rays));
    p.set("indexFromWorld", Mat3f(placeFromWorld));
    p.set("slabDepth", float(slabDepth_));
    p.set("opacityDistance", float(scene.opacityDistance));
    p.set("cutThickness", float(cutThickness(scene)));
    setLights(p, scene.render, lightsOf(scene.render, scene.camera));
    if (surrounded_) workshop_.surroundings.setUniforms(p, scene.render, view_, referenceDepth_);
    content_->setUniforms(p);
}

void SlicePicture::setCompositeUniforms(const CompiledScene& scene) {
    composite_ = &workshop_.shaders.get(foldCompositeVariant(*folded_));
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

int SlicePicture::mostAtOnce() const {
    return 4 * threadCount();
}

void SlicePicture::draw(int count) {
    count = std::min(count, endBatch_ - nextBatch_);
    cut(count);
    if (surrounded_) workshop_.surroundings.bind();
    for (int n = 0; n < count; ++n) {
        folded_ ? drawFolded(n) : drawBatch(n);
        ++nextBatch_;
        for (const Layer& layer : layers_) statistics_.polygons += (*layer.batches)[std::size_t(n)].polygons;
        if (workshop_.options.mask && nextBatch_ < endBatch_) workshop_.target.mask(workshop_.shaders, window_);
    }
}

void SlicePicture::drawBatch(int number) {
    workshop_.target.bind();
    content_->bind();
    for (const Layer& layer : layers_) {
        const SliceBatch& batch = (*layer.batches)[std::size_t(number)];
        layer.programs[0]->use();
        layer.geometry->upload(batch);
        layer.geometry->draw(0, batch.indices.size());
    }
}

void SlicePicture::drawLayer(const Layer& layer, std::size_t pass, int number, std::size_t slice) {
    const auto& first = (*layer.batches)[std::size_t(number)].firstIndex;
    if (first[slice] == first[slice + 1]) return;
    layer.programs[pass]->use();
    layer.geometry->draw(first[slice], first[slice + 1]);
}

std::array<int, 4> SlicePicture::windowOfSlice(int number, std::size_t slice) const {
    Vec2 low(1), high(-1);
    for (const Layer& layer : layers_) {
        if (layer.alone) continue;
        const SliceBatch& batch = (*layer.batches)[std::size_t(number)];
        const auto stride = std::size_t(layer.slicer.floatsPerVertex());
        for (std::size_t n = batch.firstIndex[slice]; n < batch.firstIndex[slice + 1]; ++n) {
            const float* position = &batch.vertices[stride * batch.indices[n]];
            low = glm::min(low, Vec2(position[0], position[1]));
            high = glm::max(high, Vec2(position[0], position[1]));
        }
    }
    std::array<int, 4> window{};
    for (int a = 0; a < 2; ++a) {
        const auto pixel = [&](double ndc) { return (ndc + 1) / 2 * view_.size[a]; };
        const int from = std::max(int(std::floor(pixel(low[a]))) - 1, window_[std::size_t(a)]);
        const int to =
            std::min(int(std::ceil(pixel(high[a]))) + 1, window_[std::size_t(a)] + window_[std::size_t(a) + 2]);
        window[std::size_t(a)] = from;
        window[std::size_t(a) + 2] = std::max(to - from, 0);
    }
    return window;
}

void SlicePicture::drawFolded(int number) {
    for (const Layer& layer : layers_) layer.geometry->upload((*layer.batches)[std::size_t(number)]);
    for (std::size_t slice = 0; slice < kBatchSlices; ++slice) {
        workshop_.target.bind();
        content_->bind();
        for (const Layer& layer : layers_)
            if (layer.alone) drawLayer(layer, 0, number, slice);
        const auto window = windowOfSlice(number, slice);
        if (window[2] == 0 || window[3] == 0) continue;
        glEnable(GL_SCISSOR_TEST);
        glScissor(window[0], window[1], window[2], window[3]);
        for (int pass = 0; pass < FoldTarget::passes(*folded_); ++pass) {
            workshop_.fold.start(*folded_, pass);
            for (const Layer& layer : layers_) {
                if (layer.alone) continue;
                layer.mapped ? workshop_.fold.drawCells() : workshop_.fold.drawUncovered();
                drawLayer(layer, std::size_t(pass), number, slice);
            }
        }
        workshop_.target.bind();
        workshop_.fold.bindTextures();
        workshop_.target.drawWindow(*composite_, window);
    }
}

}  // namespace voledit
