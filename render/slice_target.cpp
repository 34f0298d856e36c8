#include "render/slice_target.h"

namespace voledit {

void SliceTarget::start(Index2 size, bool masks) {
    if (size != size_) {
        size_ = size;
        color_ = makeTexture2D(GL_RGBA32F, size);
        plain_ = makeFramebuffer(color_.name(), 0, false);
        depth_ = {};
        if (!nothing_) nothing_ = makeVertexArray();
    }
    masks_ = masks;
    if (masks && !depth_) {
        depth_ = makeTexture2D(GL_DEPTH_COMPONENT24, size);
        slices_ = makeFramebuffer(color_.name(), depth_.name(), false);
        masking_ = makeFramebuffer(0, depth_.name(), false);
    }
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    const float clear[4] = {0, 0, 0, 0}, far = 1;
    glClearNamedFramebufferfv(drawn().name(), GL_COLOR, 0, clear);
    if (masks) glClearNamedFramebufferfv(drawn().name(), GL_DEPTH, 0, &far);
}

void SliceTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn().name());
    glViewport(0, 0, size_.x, size_.y);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
}

void SliceTarget::drawWindow(Program& program, const std::array<int, 4>& window) const {
    program.use();
    glEnable(GL_SCISSOR_TEST);
    glScissor(window[0], window[1], window[2], window[3]);
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

void SliceTarget::mask(ShaderLibrary& shaders, const std::array<int, 4>& window) {
    Program& program = shaders.get({"fullscreen.vert", "mask.frag", {}});
    program.set("accumulated", 0);
    program.set("opaque", kOpaque);
    glBindTextureUnit(0, color_.name());
    glBindFramebuffer(GL_FRAMEBUFFER, masking_.name());
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    drawWindow(program, window);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void SliceTarget::read(std::span<Vec4f> pixels) const {
    glGetTextureImage(color_.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(pixels.size_bytes()), pixels.data());
}

}  // namespace voledit
