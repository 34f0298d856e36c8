#include "render/slice_geometry.h"

namespace voledit {

SliceGeometry::SliceGeometry(bool mapped) {
    const GLsizei stride = (mapped ? 15 : 3) * sizeof(float);
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, stride);
    glVertexArrayElementBuffer(array_.name(), indices_.name());
    for (GLuint location = 0; location < (mapped ? 5U : 1U); ++location)
        floatAttribute(array_, location, 3, location * 3 * sizeof(float));
}

void SliceGeometry::upload(const SliceBatch& batch) {
    if (batch.indices.empty()) return;
    fill(vertices_, std::span(batch.vertices));
    fill(indices_, std::span(batch.indices));
}

void SliceGeometry::draw(std::size_t first, std::size_t end) const {
    if (first >= end) return;
    glBindVertexArray(array_.name());
    glDrawElements(GL_TRIANGLES, GLsizei(end - first), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

}  // namespace voledit
