#include "render/slice_renderer.h"

#include <algorithm>
#include <chrono>

#include "core/objects/fitted_terms.h"
#include "render/gl_state.h"
#include "render/march_picture.h"
#include "render/slice_picture.h"

namespace voledit {

namespace {
double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The way of drawing that the scene's term allows: rays in fragments, or slices.
std::unique_ptr<PictureWork> startPicture(SliceWorkshop& workshop, const CompiledScene& scene, Index2 size,
                                          double stepScale, bool moving) {
    if (workshop.options.march) {
        auto plan = planMarch(scene);
        const double step = scene.stepLength() * stepScale;
        const BakeRequest request{
            .cull = workshop.options.cull, .moving = moving, .lit = scene.render.shading, .step = step};
        if (plan && workshop.march.prepare(*plan, request))
            return std::make_unique<MarchPicture>(workshop, scene, std::move(*plan), size, step);
    }
    return std::make_unique<SlicePicture>(workshop, scene, size, stepScale);
}

}  // namespace

struct SliceRenderer::State {
    explicit State(const SliceOptions& options) : workshop(options) {}

    SliceWorkshop workshop;
    VolumeFitter fitter;
    CompiledScene fitted;  // the scene drawn, where that is not the one given
    int largestTexture = 0;
    std::unique_ptr<PictureWork> picture;
    Vec3f background{0};
    int batchesAtOnce = 1;
};

SliceRenderer::SliceRenderer(const SliceOptions& options) : state_(std::make_unique<State>(options)) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
    state_->largestTexture = options.largestTexture > 0 ? std::min(options.largestTexture, largest) : largest;
}

SliceRenderer::~SliceRenderer() = default;

void SliceRenderer::begin(const CompiledScene& scene, Index2 size, double stepScale, bool moving) {
    const GlStateGuard guard;
    state_->picture.reset();
    state_->background = scene.render.background;
    const TermPtr root = state_->fitter.fitted(scene.root, state_->largestTexture);
    if (root != scene.root) {
        state_->fitted = scene;
        state_->fitted.root = root;
    }
    const CompiledScene& drawn = root == scene.root ? scene : state_->fitted;
    state_->picture = startPicture(state_->workshop, drawn, size, stepScale, moving);
}

bool SliceRenderer::advance(double budgetMs) {
    if (!state_->picture || state_->picture->done()) return true;
    PictureWork& picture = *state_->picture;
    const GlStateGuard guard;
    if (budgetMs <= 0) {
        while (!picture.done()) picture.draw(picture.mostAtOnce());
        return true;
    }
    const auto start = std::chrono::steady_clock::now();
    // At least one piece a call, so that a busy machine gets on too.
    do {
        const auto piece = std::chrono::steady_clock::now();
        const int count = state_->batchesAtOnce;
        picture.draw(count);
        glFinish();
        // Pieces of about a third of the budget keep the overshoot small.
        const double took = std::max(millisecondsSince(piece), 0.1);
        state_->batchesAtOnce =
            int(std::clamp(count * (budgetMs / 3) / took, 1.0, double(std::min(picture.mostAtOnce(), 4096))));
    } while (!picture.done() && millisecondsSince(start) < budgetMs);
    return picture.done();
}

double SliceRenderer::progress() const {
    const PictureWork* picture = state_->picture.get();
    if (!picture || picture->pieceCount() == 0) return 1;
    return double(picture->piecesDone()) / picture->pieceCount();
}

unsigned SliceRenderer::texture() const {
    return state_->workshop.target.texture();
}

Picture SliceRenderer::readBack() const {
    const Vec3f background = state_->background;
    const Index2 size = state_->workshop.target.size();
    Picture picture(size);
    state_->workshop.target.read(picture.pixels);
    const auto row = [&](int y) { return picture.pixels.begin() + std::ptrdiff_t(y) * size.x; };
    for (int y = 0; y < size.y / 2; ++y) std::swap_ranges(row(y), row(y + 1), row(size.y - 1 - y));
    for (Vec4f& p : picture.pixels) p = Vec4f(Vec3f(p) + (1 - p.a) * background, p.a);
    return picture;
}

const std::vector<std::string>& SliceRenderer::notices() const {
    return state_->fitter.notices();
}

const SliceStatistics& SliceRenderer::statistics() const {
    static const SliceStatistics none;
    return state_->picture ? state_->picture->statistics() : none;
}

Picture renderSlices(SliceRenderer& renderer, const CompiledScene& scene, Index2 size) {
    renderer.begin(scene, size);
    renderer.advance(0);
    return renderer.readBack();
}

}  // namespace voledit
