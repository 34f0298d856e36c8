#include "render/slice_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/base/paths.h"
#include "render/cell_slicer.h"
#include "render/gl_state.h"
#include "render/slice_plan.h"
#include "render/slice_resources.h"
#include "render/slice_target.h"
#include "render/slice_variants.h"

namespace voledit {

namespace {

/// Slices of one draw call. Fixed, so that a picture in many pieces is the picture at once.
constexpr int kBatchSlices = 8;
/// Batches between two looks for opaque pixels.
constexpr int kBatchesPerMask = 4;

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

struct SliceRenderer::State {
    explicit State(const SliceOptions& o) : options(o), shaders(shaderFolder()) {}

    void describeVertices();
    void layOutSlices();
    void setUniforms(const CompiledScene& scene);
    void drawBatch(const SliceBatch& batch);
    void drawNext(int batches);

    SliceOptions options;
    ShaderLibrary shaders;
    SliceResources resources;
    SliceTarget target;
    Buffer vertices = makeBuffer(), indices = makeBuffer();
    VertexArray brickArray = makeVertexArray(), cellArray = makeVertexArray();
    std::vector<SliceBatch> batches;
    SliceStatistics statistics;

    // The picture under way.
    Program* program = nullptr;
    std::unique_ptr<CellSlicer> slicer;
    SlicePlan plan;
    View view;
    double slabDepth = 1, referenceDepth = 0;
    int firstBatch = 0, endBatch = 0, nextBatch = 0;  // slices are counted from slicer->start()
    int batchesAtOnce = 1;
    Vec3f background{0};
};

void SliceRenderer::State::describeVertices() {
    for (const VertexArray* array : {&brickArray, &cellArray}) {
        const bool mapped = array == &cellArray;
        glVertexArrayVertexBuffer(array->name(), 0, vertices.name(), 0, (mapped ? 15 : 3) * sizeof(float));
        glVertexArrayElementBuffer(array->name(), indices.name());
        for (GLuint location = 0; location < (mapped ? 5U : 1U); ++location)
            floatAttribute(*array, location, 3, location * 3 * sizeof(float));
    }
}

void SliceRenderer::State::layOutSlices() {
    const double start = slicer->start(), nearest = slicer->nearest(), farthest = slicer->farthest();
    firstBatch = endBatch = nextBatch = 0;
    statistics = {0, 0, resources.mesh().cellCount(), resources.mesh().culled};
    if (!(nearest < farthest)) return;
    const double first = std::floor((nearest - start) / slabDepth), end = std::ceil((farthest - start) / slabDepth);
    firstBatch = nextBatch = int(first) / kBatchSlices;
    endBatch = (int(end) + kBatchSlices - 1) / kBatchSlices;
    statistics.slices = int(end - first);
    referenceDepth = slicer->middle();
}

void SliceRenderer::State::setUniforms(const CompiledScene& scene) {
    const Volume& volume = *plan.volume->volume;
    const Mat3 rays(view.rayAtOrigin(), view.rayPerPixelX(), view.rayPerPixelY());
    const Mat3 indexFromWorld(plan.indexFromSource);
    Mat3 atReference = referenceDepth * (indexFromWorld * rays);
    atReference[0] += transformPoint(plan.indexFromSource, view.eye);
    const Box3 domain = volume.grid().indexDomain();
    const VolumeTexture& texture = resources.volume();
    const TransferTable& table = resources.table();
    const double entriesPerValue = (TransferTable::kSize - 1) / (table.high - table.low);
    const RenderSettings& render = scene.render;
    const Vec3 light = render.light ? glm::normalize(*render.light) : Vec3(0);

    Program& p = *program;
    p.set("volume", 0);
    p.set("thicknessTable", 1);
    p.set("colorTable", 2);
    p.set("gradientTable", 3);
    p.set("rayPerDepth", Mat3f(rays));
    p.set("indexAtReference", Mat3f(atReference));
    p.set("indexPerDepth", Mat3f(indexFromWorld * rays));
    p.set("indexFromWorld", Mat3f(indexFromWorld));
    p.set("volumeLast", Vec3f(volume.grid().size - 1));
    p.set("domainMin", Vec3f(domain.min - 1e-3));
    p.set("domainMax", Vec3f(domain.max + 1e-3));
    p.set("tableScale", float(texture.valueScale * entriesPerValue));
    p.set("tableOffset", float((texture.valueOffset - table.low) * entriesPerValue));
    p.set("tableSize", float(TransferTable::kSize));
    p.set("gradientScale", float((TransferTable::kSize - 1) / table.gradientHigh));
    p.set("gradientUnit", float(texture.valueScale));
    p.set("restFromIndexGradient", Mat3f(glm::transpose(Mat3(volume.indexFromWorld()))));
    p.set("slabDepth", float(slabDepth));
    p.set("opacityDistance", float(scene.opacityDistance));
    p.set("lighting", Vec4f(render.ambient, render.diffuse, render.specular, render.shininess));
    p.set("towardLight", Vec4f(light, render.light ? 1 : 0));
}

void SliceRenderer::State::drawBatch(const SliceBatch& batch) {
    if (batch.indices.empty()) return;
    fill(vertices, std::span(batch.vertices));
    fill(indices, std::span(batch.indices));
    glBindVertexArray((plan.forward ? cellArray : brickArray).name());
    glDrawElements(GL_TRIANGLES, GLsizei(batch.indices.size()), GL_UNSIGNED_INT, nullptr);
    statistics.polygons += batch.polygons;
}

void SliceRenderer::State::drawNext(int count) {
    count = std::min(count, endBatch - nextBatch);
    batches.resize(std::max(batches.size(), std::size_t(count)));
    const double firstDepth = slicer->start() + slabDepth / 2;
    parallelFor(std::size_t(count), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const int first = (nextBatch + int(n)) * kBatchSlices;
            slicer->cut(firstDepth + slabDepth * first, slabDepth, kBatchSlices, referenceDepth, batches[n]);
        }
    });
    for (int n = 0; n < count; ++n) {
        program->use();
        resources.bind();
        target.bind();
        drawBatch(batches[std::size_t(n)]);
        ++nextBatch;
        if (options.mask && nextBatch % kBatchesPerMask == 0 && nextBatch < endBatch) target.mask(shaders);
    }
}

SliceRenderer::SliceRenderer(const SliceOptions& options) : state_(std::make_unique<State>(options)) {
    state_->describeVertices();
}

SliceRenderer::~SliceRenderer() = default;

void SliceRenderer::begin(const CompiledScene& scene, Index2 size, double stepScale) {
    State& s = *state_;
    const GlStateGuard guard;
    s.slicer.reset();
    s.firstBatch = s.nextBatch = s.endBatch = 0;
    s.plan = planSlices(scene.root);
    s.background = scene.render.background;
    s.view = makeView(scene.camera, size);
    s.slabDepth = scene.stepLength() * stepScale * s.options.segments;
    s.resources.prepare(s.plan, s.options.cull, s.slabDepth * s.view.longestRay());
    s.target.start(size);
    s.slicer = std::make_unique<CellSlicer>(s.resources.mesh(), s.view);
    s.layOutSlices();
    const VoxelType type = s.plan.volume->volume->type();
    const TransferFunction& appearance = s.plan.volume->appearance;
    s.program = &s.shaders.get(sliceVariant({.mapped = s.plan.forward != nullptr,
                                             .shaded = scene.render.shading,
                                             .gradientOpacity = !appearance.gradientOpacity.points.empty(),
                                             .realVoxels = type == VoxelType::Float || type == VoxelType::Double,
                                             .segments = s.options.segments,
                                             .subsamples = s.options.subsamples}));
    s.setUniforms(scene);
}

bool SliceRenderer::advance(double budgetMs) {
    State& s = *state_;
    if (s.nextBatch >= s.endBatch) return true;
    const GlStateGuard guard;
    if (budgetMs <= 0) {
        while (s.nextBatch < s.endBatch) s.drawNext(4 * threadCount());
        return true;
    }
    const auto start = std::chrono::steady_clock::now();
    while (s.nextBatch < s.endBatch) {
        const double left = budgetMs - millisecondsSince(start);
        if (left <= 0) return false;
        const auto piece = std::chrono::steady_clock::now();
        const int count = s.batchesAtOnce;
        s.drawNext(count);
        glFinish();
        // Pieces of about a third of the budget keep the overshoot small.
        const double took = std::max(millisecondsSince(piece), 0.1);
        s.batchesAtOnce = std::clamp(int(count * (budgetMs / 3) / took), 1, 4 * threadCount());
    }
    return true;
}

double SliceRenderer::progress() const {
    const int all = state_->endBatch - state_->firstBatch;
    return all > 0 ? double(state_->nextBatch - state_->firstBatch) / all : 1;
}

unsigned SliceRenderer::texture() const {
    return state_->target.texture();
}

Picture SliceRenderer::readBack() const {
    const Vec3f background = state_->background;
    const Index2 size = state_->target.size();
    const std::vector<Vec4f> rows = state_->target.read();
    Picture picture(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Vec4f& from = rows[std::size_t(size.y - 1 - y) * std::size_t(size.x) + std::size_t(x)];
            picture.at(x, y) = Vec4f(Vec3f(from) + (1 - from.a) * background, from.a);
        }
    return picture;
}

const SliceStatistics& SliceRenderer::statistics() const {
    return state_->statistics;
}

Picture renderSlices(SliceRenderer& renderer, const CompiledScene& scene, Index2 size) {
    renderer.begin(scene, size);
    renderer.advance(0);
    return renderer.readBack();
}

}  // namespace voledit
