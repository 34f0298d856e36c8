#include "app/editor/platform/viewport_picture.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "app/editor/renderer_choice.h"
#include "core/base/error.h"

namespace voledit {

namespace {

using Clock = std::chrono::steady_clock;

// A picture of 1/divisor of the viewport's size, with steps so many times as long.
struct Level {
    int divisor;
    double step;
};
constexpr std::array<Level, 5> kLevels{{{1, 1}, {2, 1.25}, {3, 1.5}, {4, 2}, {5, 2.5}}};
constexpr int kCoarsest = int(kLevels.size()) - 1;
// A preview longer than that makes the next coarser, shorter than a share of it finer. A level costs between two and
// four times the next coarser one, so that the two do not chase each other. Coarser than the last level, surfaces break
// up into blocks and speckles: a picture that comes a little later is better to work on.
constexpr double kTooSlowMs = 80, kFastShare = 0.25;
constexpr int kMeasureLevel = 3;

const ProgramVariant kPresent{"screen.vert", "present.frag", {}};

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Index2 sizeAt(Index2 size, int level) {
    const int d = kLevels[std::size_t(level)].divisor;
    return glm::max((size + Index2(d - 1)) / d, Index2(1));
}

bool softwareGl() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view name = text ? text : "";
    return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos || name.find("swrast") != name.npos;
}

// The volumes that a term shows and the transfers between: what makes one renderer faster than another.
void collectShape(const Term& term, std::vector<const void*>& shape) {
    if (const auto* volume = std::get_if<VolumeTerm>(&term.node)) shape.push_back(volume->volume.get());
    if (const auto* transfer = std::get_if<TransferTerm>(&term.node)) {
        shape.push_back(nullptr);
        if (transfer->of) collectShape(*transfer->of, shape);
    }
}

GLuint makeSampler(GLenum filter) {
    GLuint name = 0;
    glCreateSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(filter));
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GLint(filter));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return name;
}

void deleteSampler(GLuint name) {
    glDeleteSamplers(1, &name);
}

}  // namespace

struct ViewportPicture::Samplers {
    GlHandle<deleteSampler> nearest{makeSampler(GL_NEAREST)}, linear{makeSampler(GL_LINEAR)};
};

ViewportPicture::ViewportPicture(ShaderLibrary& shaders)
    : shaders_(shaders), noVertices_(makeVertexArray()), samplers_(std::make_unique<Samplers>()) {}

ViewportPicture::~ViewportPicture() = default;

PictureSource& ViewportPicture::source(bool rays) {
    auto& source = sources_[rays ? 1 : 0];
    if (!source) source = rays ? makeRaySource() : makeSliceSource();
    return *source;
}

void ViewportPicture::ensureTargets(Index2 size) {
    if (size == size_) return;
    size_ = size;
    base_ = makeTexture2D(GL_RGBA8, size);
    shown_ = makeTexture2D(GL_RGBA8, size);
    baseTarget_ = makeFramebuffer(base_.name(), 0, false);
    shownTarget_ = makeFramebuffer(shown_.name(), 0, false);
}

// ---- Choosing -----------------------------------------------------------------------------------------------------

bool ViewportPicture::wantRays(const CompiledScene& scene, RendererChoice choice) {
    if (choice != RendererChoice::Auto) return choice == RendererChoice::Rays;
    // Slices that cannot draw are found out, and told, where they are tried.
    if (!softwareGl() || !whySlicesCannotDraw(scene.root).empty()) return false;
    std::vector<const void*> shape;
    collectShape(*scene.root, shape);
    if (shape != measuredFor_) {
        measuredFor_ = shape;
        measureSources(scene);
    }
    return raysAreFaster_;
}

// Without a GPU both renderers work on the same cores, and which is faster depends on the scene: try both.
void ViewportPicture::measureSources(const CompiledScene& scene) {
    try {
        const double rays = drawLevel(source(true), scene, kMeasureLevel);
        drawLevel(source(false), scene, kMeasureLevel);  // uploads
        raysAreFaster_ = rays < drawLevel(source(false), scene, kMeasureLevel);
    } catch (const Error&) {
        raysAreFaster_ = true;  // slices cannot draw it
    }
}

// ---- Drawing ------------------------------------------------------------------------------------------------------

void ViewportPicture::begin(PictureSource& source, const CompiledScene& scene, int level) {
    source.begin(scene, sizeAt(size_, level), kLevels[std::size_t(level)].step);
    working_ = level;
}

double ViewportPicture::drawLevel(PictureSource& source, const CompiledScene& scene, int level) {
    const Clock::time_point start = Clock::now();
    begin(source, scene, level);
    source.advance(0);
    present(source.texture());
    glFinish();
    return millisecondsSince(start);
}

void ViewportPicture::present(const SourceTexture& texture) {
    glBindFramebuffer(GL_FRAMEBUFFER, baseTarget_.name());
    glViewport(0, 0, size_.x, size_.y);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    Program& program = shaders_.get(kPresent);
    program.set("picture", 0);
    program.set("flipped", int(texture.flipped));
    program.set("background", background_);
    program.set("opaque", int(texture.opaque));
    program.use();
    glBindTextureUnit(0, texture.name);
    glBindSampler(0, (working_ == 0 ? samplers_->nearest : samplers_->linear).name());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindSampler(0, 0);
    level_ = working_;
}

double ViewportPicture::drawOrLeaveToRays(const CompiledScene& scene, int level) {
    slicesProblem_.clear();
    if (!rays_) {
        try {
            return drawLevel(source(false), scene, level);
        } catch (const Error& error) {
            slicesProblem_ = error.what();
            rays_ = true;
        }
    }
    return drawLevel(source(true), scene, level);
}

void ViewportPicture::drawPreview(const CompiledScene& scene, const Budget& budget) {
    // Of a played frame a part is left to all else that is done for it.
    const double most = std::min(kTooSlowMs, 0.75 * budget.playedMs.value_or(kInfinity));
    const double took = drawOrLeaveToRays(scene, previewLevel_[rays_ ? 1 : 0]);
    int& level = previewLevel_[rays_ ? 1 : 0];
    if (took > most)
        level = std::min(level + (took > 4 * most ? 2 : 1), kCoarsest);
    else if (took < kFastShare * most)
        level = std::max(level - 1, 0);
}

void ViewportPicture::update(const CompiledScene& scene, Index2 size, RendererChoice choice, const Budget& budget) {
    ensureTargets(size);
    background_ = Vec3f(scene.render.background);
    Wanted wanted{scene.root, scene.camera, scene.render, scene.opacityDistance, scene.unitStep, size, choice};
    changed_ = !wanted_ || *wanted_ != wanted;
    if (changed_) {
        wanted_ = std::move(wanted);
        refining_ = false;
        rays_ = wantRays(scene, choice);
        drawPreview(scene, budget);
        return;
    }
    if (finished() || budget.playedMs) return;
    if (!refining_) begin(source(rays_), scene, level_ > 2 ? 1 : 0);
    refining_ = !source(rays_).advance(budget.refineMs);
    if (!refining_) present(source(rays_).texture());
}

void ViewportPicture::finish(const CompiledScene& scene, Index2 size, RendererChoice choice) {
    ensureTargets(size);
    background_ = Vec3f(scene.render.background);
    Wanted wanted{scene.root, scene.camera, scene.render, scene.opacityDistance, scene.unitStep, size, choice};
    if (wanted_ && *wanted_ == wanted && finished()) return;
    rays_ = wantRays(scene, choice);
    wanted_ = std::move(wanted);
    refining_ = false;
    drawOrLeaveToRays(scene, 0);
}

double ViewportPicture::progress() const {
    if (finished()) return 1;
    const double done = refining_ ? sources_[rays_ ? 1 : 0]->progress() : 0;
    return working_ == 0 && refining_ ? 0.25 + 0.75 * done : 0.25 * done;
}

GLuint ViewportPicture::texture(const Overlay& overlay, const Camera& camera) {
    if (overlay.lines.empty() && overlay.points.empty()) return base_.name();
    glBlitNamedFramebuffer(baseTarget_.name(), shownTarget_.name(), 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, shownTarget_.name());
    glViewport(0, 0, size_.x, size_.y);
    overlays_.draw(overlay, camera, size_);
    return shown_.name();
}

}  // namespace voledit
