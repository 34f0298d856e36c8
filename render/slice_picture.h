#pragma once
// One picture under way: which slices of which meshes are drawn with which programs.

#include <memory>
#include <vector>

#include "core/scene/compile.h"
#include "render/cell_slicer.h"
#include "render/fold_target.h"
#include "render/light_uniforms.h"
#include "render/march_resources.h"
#include "render/picture_work.h"
#include "render/shader_library.h"
#include "render/slice_content.h"
#include "render/slice_geometry.h"
#include "render/slice_renderer.h"
#include "render/slice_resources.h"
#include "render/slice_target.h"
#include "render/term_mesh.h"
#include "render/term_resources.h"

namespace voledit {

/// What pictures share and keep from one to the next.
struct SliceWorkshop {
    explicit SliceWorkshop(const SliceOptions& o);

    SliceOptions options;
    ShaderLibrary shaders;
    SliceResources resources;  // of chains
    TermResources terms;       // of any other term
    MarchResources march;      // of volumes that rays walk through
    TermMesh termMesh;
    SliceTarget target;
    FoldTarget fold;
    SurroundingsTexture surroundings;
    /// Polygons of the bricks, of the cells, and of those that overlap no other; batches are kept for their memory.
    SliceGeometry bricks{false}, cells{true}, aloneCells{true};
    std::vector<SliceBatch> brickBatches, cellBatches, aloneBatches;
};

/// Slices of a scene from one camera, drawn in batches of kBatchSlices, front to back. Slices are counted from the
/// nearest point of all cells, seen or not, so that neither culling nor the size of pieces changes the picture.
class SlicePicture final : public PictureWork {
public:
    static constexpr int kBatchSlices = 8;

    /// Prepares resources and clears the target. Throws Error for a term that slices cannot draw.
    SlicePicture(SliceWorkshop& workshop, const CompiledScene& scene, Index2 size, double stepScale);

    /// Pieces are batches.
    int pieceCount() const override { return endBatch_ - firstBatch_; }
    int piecesDone() const override { return nextBatch_ - firstBatch_; }
    /// Polygons are made in parallel.
    void draw(int count) override;
    int mostAtOnce() const override;

    const SliceStatistics& statistics() const override { return statistics_; }

private:
    /// The bricks or the cells of this picture.
    struct Layer {
        bool mapped;
        bool alone;           // drawn at once, where others' pre-images combine
        Mat4 placeFromWorld;  // for bricks
        CellSlicer slicer;
        SliceGeometry* geometry;
        std::vector<SliceBatch>* batches;
        std::array<Program*, 2> programs;  // of the passes
    };

    void addLayer(const SliceContent::Part& part);
    void setUniforms(Program& program, const Layer& layer, const CompiledScene& scene) const;
    void setCompositeUniforms(const CompiledScene& scene);
    void layOut();
    void cut(int count);
    void drawBatch(int number);
    void drawFolded(int number);
    void drawLayer(const Layer& layer, std::size_t pass, int number, std::size_t slice);
    /// Pixels that the polygons of one slice that combine may cover (glScissor).
    std::array<int, 4> windowOfSlice(int number, std::size_t slice) const;

    SliceWorkshop& workshop_;
    View view_;
    std::unique_ptr<SliceContent> content_;
    std::optional<Combine> folded_;
    bool surrounded_ = false;  // shadows or occlusion
    double slabDepth_ = 1;
    std::vector<Layer> layers_;
    Program* composite_ = nullptr;
    double start_ = 0, referenceDepth_ = 0;
    std::array<int, 4> window_{};
    int firstBatch_ = 0, nextBatch_ = 0, endBatch_ = 0;
    SliceStatistics statistics_;
};

}  // namespace voledit
