#pragma once
// Leaves GL as it was found, since renderers share their context with the window's interface.

#include <glad/gl.h>

namespace voledit {

/// Notes the pieces of GL state that slices change and puts them back.
class GlStateGuard {
public:
    GlStateGuard();
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

private:
    GLint viewport_[4], scissor_[4], framebuffer_, program_, vertexArray_, depthFunction_;
    GLint blend_[4], blendEquation_[2];
    GLboolean depthMask_, colorMask_[4];
    GLboolean blends_, depthTests_, scissors_, culls_, stencils_;
};

}  // namespace voledit
