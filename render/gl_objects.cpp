#include "render/gl_objects.h"

#include "core/base/error.h"

namespace voledit {

void deleteTexture(GLuint name) {
    glDeleteTextures(1, &name);
}
void deleteBuffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
void deleteFramebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
void deleteVertexArray(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
void deleteProgram(GLuint name) {
    glDeleteProgram(name);
}

Texture makeTexture(GLenum target, GLenum minify, GLenum magnify) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    Texture texture(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(minify));
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GLint(magnify));
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    return texture;
}

Texture makeTexture2D(GLenum format, Index2 size) {
    Texture texture = makeTexture(GL_TEXTURE_2D, GL_NEAREST, GL_NEAREST);
    glTextureStorage2D(texture.name(), 1, format, size.x, size.y);
    return texture;
}

Texture makeTable(GLenum format, int width, std::span<const float> values) {
    Texture texture = makeTexture(GL_TEXTURE_1D, GL_LINEAR, GL_LINEAR);
    const std::size_t channels = values.size() / std::size_t(width);
    glTextureStorage1D(texture.name(), 1, format, width);
    glTextureSubImage1D(texture.name(), 0, 0, width,
                        channels == 4   ? GL_RGBA
                        : channels == 2 ? GL_RG
                                        : GL_RED,
                        GL_FLOAT, values.data());
    return texture;
}

Texture makeTables(int width, int rows, std::span<const float> values) {
    Texture texture = makeTexture(GL_TEXTURE_1D_ARRAY, GL_LINEAR, GL_LINEAR);
    glTextureStorage2D(texture.name(), 1, GL_RGBA32F, width, rows);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, rows, GL_RGBA, GL_FLOAT, values.data());
    return texture;
}

Buffer makeBuffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return Buffer(name);
}

Framebuffer makeFramebuffer(GLuint color, GLuint depth, bool stencil) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer framebuffer(name);
    if (color)
        glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color, 0);
    else
        glNamedFramebufferDrawBuffer(name, GL_NONE);
    if (depth) glNamedFramebufferTexture(name, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth, 0);
    if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("OpenGL", "the driver refuses a framebuffer of 32-bit floats", "use --renderer rays");
    return framebuffer;
}

VertexArray makeVertexArray() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}

void floatAttribute(const VertexArray& array, GLuint location, int count, std::size_t offset) {
    glEnableVertexArrayAttrib(array.name(), location);
    glVertexArrayAttribFormat(array.name(), location, count, GL_FLOAT, GL_FALSE, GLuint(offset));
    glVertexArrayAttribBinding(array.name(), location, 0);
}

GLint Program::location(const char* uniform) {
    const auto found = locations_.find(uniform);
    if (found != locations_.end()) return found->second;
    return locations_[uniform] = glGetUniformLocation(name(), uniform);
}

}  // namespace voledit
