#pragma once
// One picture under way whose fragments walk their rays: tile by tile.

#include <limits>

#include "render/march_plan.h"
#include "render/picture_work.h"
#include "render/slice_picture.h"

namespace voledit {

/// A picture of rays through one volume. A tile is complete when it is drawn.
class MarchPicture final : public PictureWork {
public:
    /// A picture of what the workshop's MarchResources were prepared for, by `plan` and a step of `step` world units.
    /// Clears the target.
    MarchPicture(SliceWorkshop& workshop, const CompiledScene& scene, MarchPlan plan, Index2 size, double step);

    int pieceCount() const override { return columns_ * rows_; }
    int piecesDone() const override { return next_; }
    void draw(int count) override;
    int mostAtOnce() const override { return std::numeric_limits<int>::max(); }
    const SliceStatistics& statistics() const override { return statistics_; }

private:
    void findPlaces();
    void layOut();
    void setUniforms(const CompiledScene& scene);
    void setVolumeUniforms();
    void drawTiles(Index2 first, Index2 end);

    SliceWorkshop& workshop_;
    MarchPlan plan_;
    View view_;
    double step_;
    double referenceDepth_ = 0;
    Mat4 placeFromWorld_{1};
    Box3 box_;      // where there are places
    Box3 visible_;  // those that can be seen lie in it
    Program* program_ = nullptr;
    bool surrounded_ = false;                // shadows or occlusion
    std::array<int, 4> window_{};            // pixels that may show something
    int columns_ = 0, rows_ = 0, next_ = 0;  // tiles
    SliceStatistics statistics_;
};

}  // namespace voledit
