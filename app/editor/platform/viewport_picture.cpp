#include "app/editor/platform/viewport_picture.h"

#include <chrono>
#include <cmath>
#include <string_view>

#include "app/editor/platform/enlarge.h"
#include "core/scene/tones.h"

namespace voledit {

namespace {

ProgramVariant presentVariant(bool enlarged, bool toned) {
    ProgramVariant variant{"screen.vert", "present.frag", {}};
    if (enlarged) variant.defines.push_back("ENLARGED");
    if (toned) variant.defines.push_back("TONED");
    return variant;
}

double millisecondsNow() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
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

bool softwareGl() {
    const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view name = text ? text : "";
    return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos || name.find("swrast") != name.npos;
}

struct ViewportPicture::Samplers {
    GlHandle<deleteSampler> nearest{makeSampler(GL_NEAREST)}, linear{makeSampler(GL_LINEAR)};
};

// Without a GPU both renderers work on the same cores, and rays make more of them.
ViewportPicture::ViewportPicture(ShaderLibrary& shaders, bool headless)
    : shaders_(shaders),
      softwareGl_(softwareGl()),
      schedule_([](bool rays) { return rays ? makeRaySource() : makeSliceSource(); }, millisecondsNow,
                !headless && softwareGl_),
      noVertices_(makeVertexArray()),
      samplers_(std::make_unique<Samplers>()) {}

ViewportPicture::~ViewportPicture() = default;

void ViewportPicture::ensureTargets(Index2 size) {
    if (size == size_) return;
    size_ = size;
    base_ = makeTexture2D(GL_RGBA8, size);
    shown_ = makeTexture2D(GL_RGBA8, size);
    baseTarget_ = makeFramebuffer(base_.name(), 0, false);
    shownTarget_ = makeFramebuffer(shown_.name(), 0, false);
}

// Without a GPU the processor enlarges pictures several times as fast by itself, and its own need no detour.
void ViewportPicture::present(const RenderSettings& settings) {
    if (!softwareGl_ || (!schedule_.drawnByRays() && schedule_.pictureSize() == size_)) return presentTexture(settings);
    RenderSettings shown = settings;
    shown.transparent = false;
    if (Tones(shown).none())
        enlarge(schedule_.picture(), size_, bytes_);
    else
        enlarge(finishedPicture(schedule_.picture(), shown), size_, bytes_);
    glTextureSubImage2D(base_.name(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
}

void ViewportPicture::presentTexture(const RenderSettings& settings) {
    const SourceTexture texture = schedule_.texture();
    const Index2 from = schedule_.pictureSize();
    glBindFramebuffer(GL_FRAMEBUFFER, baseTarget_.name());
    glViewport(0, 0, size_.x, size_.y);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    const bool toned = !Tones(settings).none();
    Program& program = shaders_.get(presentVariant(from != size_, toned));
    if (toned) {
        program.set("exposureGain", float(std::exp2(settings.exposure)));
        program.set("filmicCurve", int(settings.toneMapping == ToneMapping::Filmic));
    }
    program.set("picture", 0);
    program.set("flipped", int(texture.flipped));
    program.set("background", Vec3f(settings.background));
    program.set("opaque", int(texture.opaque));
    // A picture's height is the camera's field of view; whole pixels make it a little wider or narrower than the view.
    const double wide = double(size_.x) / size_.y * from.y / from.x;
    if (from != size_) program.set("wide", float(wide));
    program.use();
    glBindTextureUnit(0, texture.name);
    glBindSampler(0, (from == size_ ? samplers_->nearest : samplers_->linear).name());
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindSampler(0, 0);
}

bool ViewportPicture::update(const CompiledScene& scene, Index2 size, RendererChoice choice,
                             const PictureSchedule::Frame& frame) {
    ensureTargets(size);
    const bool complete = schedule_.update(scene, size, choice, frame);
    if (complete) present(scene.render);
    return complete;
}

void ViewportPicture::finish(const CompiledScene& scene, Index2 size, RendererChoice choice) {
    ensureTargets(size);
    if (schedule_.finish(scene, size, choice)) present(scene.render);
}

GLuint ViewportPicture::framebuffer(const Overlay& overlay, const Camera& camera) {
    if (overlay.lines.empty() && overlay.points.empty()) return baseTarget_.name();
    glBlitNamedFramebuffer(baseTarget_.name(), shownTarget_.name(), 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, shownTarget_.name());
    glViewport(0, 0, size_.x, size_.y);
    overlays_.draw(overlay, camera, size_);
    return shownTarget_.name();
}

}  // namespace voledit
