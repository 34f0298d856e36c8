#pragma once
// Polygons of slices on the GPU.

#include "render/cell_slicer.h"
#include "render/gl_objects.h"

namespace voledit {

/// One batch of slices as buffers for slice.vert.
class SliceGeometry {
public:
    explicit SliceGeometry(bool mapped);
    /// Replaces what was there.
    void upload(const SliceBatch& batch);
    /// Triangles made of indices [first, end) of the batch.
    void draw(std::size_t first, std::size_t end) const;

private:
    Buffer vertices_ = makeBuffer(), indices_ = makeBuffer();
    VertexArray array_ = makeVertexArray();
};

}  // namespace voledit
