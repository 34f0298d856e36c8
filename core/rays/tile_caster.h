#pragma once
// What draws the tiles of a picture, chosen by the kind of term.

#include <memory>

#include "core/base/picture.h"
#include "core/rays/volume_look.h"
#include "core/scene/compile.h"

namespace voledit {

struct CellLook;

/// Draws rectangles of one picture. Immutable; safe from many threads for disjoint rectangles.
class TileCaster {
public:
    virtual ~TileCaster() = default;
    /// Draws the pixels from `first` up to but without `end` into `picture`; gives the samples taken.
    virtual std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const = 0;
};

/// What is kept from picture to picture.
struct RayCache {
    std::shared_ptr<const VolumeLook> look;
    std::shared_ptr<const CellLook> cells;
};

/// The caster for `scene` (kept by it) in a picture of `size`; `rough` as CellWish has it.
std::unique_ptr<const TileCaster> makeTileCaster(const CompiledScene& scene, Index2 size, RayCache& cache,
                                                 bool rough = false);

/// Any term, by blocks of samples: the reference's own way.
std::unique_ptr<const TileCaster> makeGeneralTiles(const CompiledScene& scene);

/// A volume term under affine maps alone. `indexFromWorld` takes the root's space to the volume's index space.
std::unique_ptr<const TileCaster> makeStraightTiles(const CompiledScene& scene, Index2 size,
                                                    std::shared_ptr<const VolumeLook> look, const Mat4& indexFromWorld);

}  // namespace voledit
