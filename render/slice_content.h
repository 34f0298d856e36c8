#pragma once
// What the slices of a picture show: a chain of maps over one volume, or any term.

#include <memory>
#include <optional>
#include <vector>

#include "core/scene/compile.h"
#include "render/cell_mesh.h"
#include "render/shader_library.h"

namespace voledit {

struct SliceWorkshop;

/// Cells to cut, the programs that draw their polygons, and what those read. Made anew for every picture, of what the
/// workshop keeps.
class SliceContent {
public:
    virtual ~SliceContent() = default;

    /// Cells of one kind, and from the world to what their programs call a place (shaders/common/slice_input.glsl).
    struct Part {
        const CellMesh* mesh;
        Mat4 placeFromWorld;
        /// Where pre-images combine: the cells of this part have one each, so that their fragments are complete.
        bool alone = false;
    };
    /// Bricks, tetrahedra, or one of each; tetrahedra that are alone, and those that are not.
    virtual std::vector<Part> parts() const = 0;
    /// For meshes with margins: what can be seen, by places, and the box that these may lie in.
    virtual const Visibility& visibility() const = 0;
    virtual Box3 domain() const = 0;

    /// Parts of a slab that are classified by themselves, each a step long.
    virtual int stepsOfSlab() const = 0;
    /// How pre-images combine slice by slice (fold_target.h); nullopt: a fragment is complete.
    virtual std::optional<Combine> folded() const { return std::nullopt; }

    /// The program that draws a part in pass `pass` (of pre-images that combine, else 0).
    virtual ProgramVariant variant(const Part& part, int pass) const = 0;
    /// Sets uniforms that only this content has.
    virtual void setUniforms(Program& program) const = 0;
    /// Binds textures and buffers.
    virtual void bind() const = 0;
};

/// The content of `scene`'s root, its resources prepared. Throws Error for a term that slices cannot draw.
/// @param step  along the view axis, world units; @param longestRay  world length of unit depth at most
std::unique_ptr<SliceContent> makeContent(SliceWorkshop& workshop, const CompiledScene& scene, double step,
                                          double longestRay);

}  // namespace voledit
