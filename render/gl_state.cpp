#include "render/gl_state.h"

namespace voledit {

GlStateGuard::GlStateGuard() {
    glGetIntegerv(GL_VIEWPORT, viewport_);
    glGetIntegerv(GL_SCISSOR_BOX, scissor_);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertexArray_);
    glGetIntegerv(GL_DEPTH_FUNC, &depthFunction_);
    glGetIntegerv(GL_BLEND_SRC_RGB, &blend_[0]);
    glGetIntegerv(GL_BLEND_DST_RGB, &blend_[1]);
    glGetIntegerv(GL_BLEND_SRC_ALPHA, &blend_[2]);
    glGetIntegerv(GL_BLEND_DST_ALPHA, &blend_[3]);
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &blendEquation_[0]);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &blendEquation_[1]);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask_);
    glGetBooleanv(GL_COLOR_WRITEMASK, colorMask_);
    blends_ = glIsEnabled(GL_BLEND);
    depthTests_ = glIsEnabled(GL_DEPTH_TEST);
    scissors_ = glIsEnabled(GL_SCISSOR_TEST);
    culls_ = glIsEnabled(GL_CULL_FACE);
    stencils_ = glIsEnabled(GL_STENCIL_TEST);
}

GlStateGuard::~GlStateGuard() {
    const auto put = [](GLenum what, GLboolean on) { on ? glEnable(what) : glDisable(what); };
    put(GL_BLEND, blends_);
    put(GL_DEPTH_TEST, depthTests_);
    put(GL_SCISSOR_TEST, scissors_);
    put(GL_CULL_FACE, culls_);
    put(GL_STENCIL_TEST, stencils_);
    glColorMask(colorMask_[0], colorMask_[1], colorMask_[2], colorMask_[3]);
    glDepthMask(depthMask_);
    glDepthFunc(GLenum(depthFunction_));
    glBlendFuncSeparate(GLenum(blend_[0]), GLenum(blend_[1]), GLenum(blend_[2]), GLenum(blend_[3]));
    glBlendEquationSeparate(GLenum(blendEquation_[0]), GLenum(blendEquation_[1]));
    glBindVertexArray(GLuint(vertexArray_));
    glUseProgram(GLuint(program_));
    glBindFramebuffer(GL_FRAMEBUFFER, GLuint(framebuffer_));
    glScissor(scissor_[0], scissor_[1], scissor_[2], scissor_[3]);
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

}  // namespace voledit
