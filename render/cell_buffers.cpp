#include "render/cell_buffers.h"

#include "core/base/error.h"

namespace voledit {

namespace {

template <class T>
Buffer makeStorage(std::span<const T> values) {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (GLint64(values.size_bytes()) > most)
        throw Error("OpenGL", "the driver cannot hold the cells of a map", "use --renderer rays");
    Buffer buffer = makeBuffer();
    fill(buffer, values, GL_STATIC_DRAW);
    return buffer;
}

}  // namespace

std::array<Buffer, 5> cellBuffers(const CellArrays& arrays) {
    return {makeStorage(std::span(arrays.maps)), makeStorage(std::span(arrays.cells)),
            makeStorage(std::span(arrays.tetrahedra)), makeStorage(std::span(arrays.corners)),
            makeStorage(std::span(arrays.vertices))};
}

void bindCells(const std::array<Buffer, 5>& buffers) {
    for (std::size_t n = 0; n < buffers.size(); ++n)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(n), buffers[n].name());
}

}  // namespace voledit
