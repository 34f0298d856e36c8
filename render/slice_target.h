#pragma once
// Where slices are composited.

#include <array>
#include <span>

#include "render/gl_objects.h"
#include "render/shader_library.h"

namespace voledit {

/// A picture in 32-bit floats, premultiplied, and a depth buffer that masks pixels which are nearly opaque.
class SliceTarget {
public:
    /// Alpha from which on a pixel is masked: what lies behind would change it by a quarter of one of 255 levels.
    static constexpr float kOpaque = 0.999F;

    /// Clears it; makes new textures where the size differs. Without `masks` there is no depth buffer.
    void start(Index2 size, bool masks);
    /// Binds it for slices: front-to-back compositing, masked pixels closed.
    void bind() const;
    /// Draws `program` over `window` of the bound target.
    void drawWindow(Program& program, const std::array<int, 4>& window) const;
    /// Masks nearly opaque pixels of `window` (x, y, width, height), after a start with masks. Leaves the target
    /// unbound.
    void mask(ShaderLibrary& shaders, const std::array<int, 4>& window);

    GLuint texture() const { return color_.name(); }
    Index2 size() const { return size_; }
    /// The pixels, bottom row first, premultiplied: size.x · size.y.
    void read(std::span<Vec4f> pixels) const;

private:
    const Framebuffer& drawn() const { return masks_ ? slices_ : plain_; }

    Index2 size_{0, 0};
    bool masks_ = false;
    Texture color_, depth_;
    Framebuffer plain_;             // has only the colour
    Framebuffer slices_, masking_;  // the second has only the depth, so that the colour may be read
    VertexArray nothing_;
};

}  // namespace voledit
