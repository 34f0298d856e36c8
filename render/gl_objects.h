#pragma once
// Thin, move-only owners of OpenGL objects. All calls use direct state access (OpenGL 4.5).

#include <glad/gl.h>

#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// A GL name that is deleted with its owner; 0 owns nothing. The context of its making must be current then.
template <void (*Delete)(GLuint)>
class GlHandle {
public:
    GlHandle() = default;
    explicit GlHandle(GLuint name) : name_(name) {}
    GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlHandle() {
        if (name_) Delete(name_);
    }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

void deleteTexture(GLuint name);
void deleteBuffer(GLuint name);
void deleteFramebuffer(GLuint name);
void deleteVertexArray(GLuint name);
void deleteProgram(GLuint name);

using Texture = GlHandle<deleteTexture>;
using Buffer = GlHandle<deleteBuffer>;
using Framebuffer = GlHandle<deleteFramebuffer>;
using VertexArray = GlHandle<deleteVertexArray>;

/// A texture of `target`, without a store yet, clamped to its edges, with these filters.
Texture makeTexture(GLenum target, GLenum minify, GLenum magnify);
/// Immutable 2-D texture of one level, nearest filtering, clamped.
Texture makeTexture2D(GLenum format, Index2 size);
/// Immutable 1-D texture of one level, linear filtering, clamped, filled with `values` (width · channels floats; the
/// format's channels are 1, 2 or 4).
Texture makeTable(GLenum format, int width, std::span<const float> values);

/// Immutable array of `rows` such textures of four channels (RGBA32F), one after the other in `values`.
Texture makeTables(int width, int rows, std::span<const float> values);

Buffer makeBuffer();
/// Replaces the buffer's whole store, orphaning the old one, so that the GPU need not be waited for.
template <class T>
void fill(const Buffer& buffer, std::span<const T> values, GLenum usage = GL_STREAM_DRAW) {
    glNamedBufferData(buffer.name(), GLsizeiptr(values.size_bytes()), values.data(), usage);
}

/// A framebuffer of one colour texture and one depth or depth-stencil texture; either may be 0. Throws Error where the
/// driver refuses it.
Framebuffer makeFramebuffer(GLuint color, GLuint depth, bool stencil);

VertexArray makeVertexArray();
/// Attribute `location`: `count` floats at `offset` bytes within a vertex, from binding 0.
void floatAttribute(const VertexArray& array, GLuint location, int count, std::size_t offset);

/// A linked program whose uniforms are set by name. Setting one that the driver dropped does nothing, as variants use
/// different ones.
class Program {
public:
    Program() = default;
    explicit Program(GLuint name) : handle_(name) {}

    GLuint name() const { return handle_.name(); }
    void use() const { glUseProgram(name()); }

    void set(const char* uniform, int v) { glProgramUniform1i(name(), location(uniform), v); }
    void set(const char* uniform, float v) { glProgramUniform1f(name(), location(uniform), v); }
    void set(const char* uniform, const Vec2f& v) { glProgramUniform2fv(name(), location(uniform), 1, &v.x); }
    void set(const char* uniform, const Vec3f& v) { glProgramUniform3fv(name(), location(uniform), 1, &v.x); }
    void set(const char* uniform, const Vec4f& v) { glProgramUniform4fv(name(), location(uniform), 1, &v.x); }
    void set(const char* uniform, const Mat3f& m) {
        glProgramUniformMatrix3fv(name(), location(uniform), 1, GL_FALSE, &m[0].x);
    }
    void set(const char* uniform, const Mat4f& m) {
        glProgramUniformMatrix4fv(name(), location(uniform), 1, GL_FALSE, &m[0].x);
    }

private:
    GLint location(const char* uniform);

    GlHandle<deleteProgram> handle_;
    std::unordered_map<std::string, GLint> locations_;
};

}  // namespace voledit
