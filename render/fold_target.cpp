#include "render/fold_target.h"

namespace voledit {

namespace {
void attach(const Framebuffer& framebuffer, GLuint sampled, GLuint lit) {
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, sampled, 0);
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT1, lit, 0);
    const GLenum buffers[2] = {sampled ? GLenum(GL_COLOR_ATTACHMENT0) : GLenum(GL_NONE),
                               lit ? GLenum(GL_COLOR_ATTACHMENT1) : GLenum(GL_NONE)};
    glNamedFramebufferDrawBuffers(framebuffer.name(), 2, buffers);
}
}  // namespace

void FoldTarget::resize(Index2 size) {
    if (size == size_) return;
    size_ = size;
    sampled_ = makeTexture2D(GL_RGBA32F, size);
    lit_ = makeTexture2D(GL_RGBA32F, size);
    depth_ = makeTexture2D(GL_DEPTH32F_STENCIL8, size);
    for (Framebuffer* framebuffer : {&both_, &onlySampled_, &onlyLit_})
        *framebuffer = makeFramebuffer(sampled_.name(), depth_.name(), true);
    attach(both_, sampled_.name(), lit_.name());
    attach(onlySampled_, sampled_.name(), 0);
    attach(onlyLit_, 0, lit_.name());
}

void FoldTarget::start(Combine combine, int pass) const {
    const bool smallest = combine == Combine::Intersection && pass == 1;
    const bool adds = combine == Combine::Merge && pass == 0;
    const Framebuffer& target = passes(combine) == 1 ? both_ : pass == 0 ? onlySampled_ : onlyLit_;
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(adds ? GL_ALWAYS : smallest ? GL_GREATER : GL_LESS);
    adds ? glEnable(GL_BLEND) : glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    const float nothing[4] = {0, 0, 0, 0};
    for (GLint buffer = 0; buffer < 2; ++buffer)
        if (passes(combine) == 1 || buffer == pass) glClearBufferfv(GL_COLOR, buffer, nothing);
    glStencilMask(0xff);
    glClearBufferfi(GL_DEPTH_STENCIL, 0, smallest ? 0.0F : 1.0F, 0);
    glEnable(GL_STENCIL_TEST);
}

void FoldTarget::drawCells() const {
    glStencilFunc(GL_ALWAYS, 1, 0xff);
    glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE);
}

void FoldTarget::drawUncovered() const {
    glStencilFunc(GL_EQUAL, 0, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

void FoldTarget::bindTextures() const {
    glBindTextureUnit(0, sampled_.name());
    glBindTextureUnit(1, lit_.name());
}

}  // namespace voledit
