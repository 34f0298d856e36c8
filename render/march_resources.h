#pragma once
// What fragments that walk rays need of a volume, and of the map that it lies under, kept between pictures.

#include <memory>
#include <optional>
#include <span>

#include "core/eval/baked_map.h"
#include "render/gl_objects.h"
#include "render/march_cells.h"
#include "render/march_plan.h"

namespace voledit {

/// How a picture wants maps to be baked.
struct BakeRequest {
    bool cull = true;     // false: everything counts as visible
    bool moving = false;  // a coarse map will do, whatever its error
    bool lit = true;      // its Jacobians are needed
    double step = 1;      // world units
};

/// The table of a volume's appearance and which of its bricks can be seen; the map that it lies under, at the nodes of
/// a grid. `prepare` makes anew only what differs; the volume's texture is that of SliceResources.
class MarchResources {
public:
    /// Cells farther from all that can be seen are passed in strides of so many.
    static constexpr int kFarthest = 24;
    /// Error of a baked map that pictures at rest may have, voxels.
    static constexpr double kLargestError = 0.1;

    /// False where a map cannot be baked well enough: then slices have to draw it.
    bool prepare(const MarchPlan& plan, const BakeRequest& request);

    const MarchTable& table() const { return look_->table; }
    /// Cells that rays have to look into: bricks of the volume, places being index coordinates; under a map cells of
    /// its grid, places being grid coordinates. Their sides are cellSide() places long.
    const BrickSet& cells() const { return baked_ ? baked_->cells : look_->cull ? look_->bricks.set : look_->all; }
    double cellSide() const { return baked_ ? baked_->side : look_->bricks.side(); }
    /// The grid of the map; null where there is none.
    const BakeGrid* grid() const { return baked_ ? &baked_->grid : nullptr; }
    /// Steps that rays may go straight.
    int stepsOfBlock() const { return baked_ ? baked_->steps : 4; }
    /// Binds the tables to texture units 1 … 3, the cells' distances to 4, the map and its Jacobians, if there are, to
    /// 5 … 8.
    void bind() const;

private:
    struct Look {
        std::weak_ptr<const Volume> source;
        int channel;
        TransferFunction appearance;
        bool cull;
        MarchTable table;
        VisibleBricks bricks;
        BrickSet all;  // where nothing is culled
        Texture next, depth, color, distances;
    };
    struct Baked {
        std::vector<std::weak_ptr<const SpatialTransferFunction>> source;
        Mat4 worldFromDeformed, indexFromSource;
        BakeRequest request;
        bool good = false;      // else it is not to be used
        bool hopeless = false;  // finer grids would not do, either: it is undefined where something is seen
        BakeGrid grid = {};
        BrickSet cells = {};
        double side = 1;
        int steps = 1;
        Texture nodes = {}, distances = {};
        std::array<Texture, 3> jacobian = {};  // where they were asked for
    };
    void prepareLook(const VolumeTerm& term, bool cull);
    bool holds(const MarchPlan& plan, const BakeRequest& request) const;
    bool bakeFinely(const MarchPlan& plan, const BakeRequest& request, int most);

    std::optional<Look> look_;
    std::optional<Baked> baked_;  // of look_
};

}  // namespace voledit
