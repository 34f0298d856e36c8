#pragma once
// What a term program reads, on the GPU, kept between pictures.

#include <memory>
#include <optional>
#include <vector>

#include "render/cell_arrays.h"
#include "render/gl_objects.h"
#include "render/term_program.h"
#include "render/volume_texture.h"

namespace voledit {

/// Numbers, textures and buffers of the program prepared last. Only what differs is made anew: volumes and cells are
/// compared by identity, tables by value.
class TermResources {
public:
    /// Throws Error where the GPU has too little of something.
    void prepare(TermProgram program);
    /// The program that was prepared; only if there is one.
    const TermProgram& program() const { return *program_; }
    /// True if the program prepared last is that of `root`.
    bool holds(const TermPtr& root) const { return program_ && program_->root == root; }
    /// Binds the numbers to uniform block 0, the tables to texture unit 0, the volumes from unit 1 on, cells to the
    /// storage buffers of shaders/common/cell_search.glsl.
    void bind() const;

private:
    struct Volumes {
        std::weak_ptr<const Volume> source;
        int channel;
        VolumeTexture texture;
    };
    void prepareVolumes();
    void prepareTables();
    void prepareCells();
    void setGroup(int group, const Vec4& numbers);
    void setMatrix(int group, const Mat4& matrix);

    std::optional<TermProgram> program_;
    Buffer numbers_ = makeBuffer();
    std::vector<Volumes> volumes_;
    std::vector<ProgramTable> tables_;  // as the texture has them
    Texture tableTexture_;
    std::vector<std::weak_ptr<const void>> cells_;  // as the buffers have them
    Vec3 cellsOrigin_{0};
    std::vector<Mat4> gridFromDeformed_;
    std::array<Buffer, 5> cellBuffers_;
};

}  // namespace voledit
