#include "core/rays/volume_look.h"

#include <algorithm>

#include "core/rays/packet_caster.h"

namespace voledit {

namespace {

Interval rangeOf(const ValueBricks& bricks) {
    Interval range{kInfinity, -kInfinity};
    for (std::size_t n = 0; n < bricks.low.size(); ++n) range = join(range, Interval{bricks.low[n], bricks.high[n]});
    return range;
}

bool whole(VoxelType type) {
    return type != VoxelType::Float && type != VoxelType::Double;
}

}  // namespace

bool packable(const VolumeTerm& term) {
    return term.interpolation == Interpolation::Linear && term.channel == 0 && packable(*term.volume);
}

bool VolumeLook::reachesFaces(double voxels) const {
    const double side = double(1 << skip().shift);
    const Box3 domain = volumeTerm().volume->grid().indexDomain();
    for (int a = 0; a < 3; ++a)
        if (side * skip().first[a] < domain.min[a] + voxels || side * skip().end[a] > domain.max[a] - voxels)
            return true;
    return false;
}

std::shared_ptr<const VolumeLook> volumeLook(const TermPtr& term, double unit,
                                             const std::shared_ptr<const VolumeLook>& previous) {
    if (previous && previous->term == term && previous->unit == unit) return previous;
    auto look = std::make_shared<VolumeLook>();
    look->term = term;
    look->unit = unit;
    const VolumeTerm& node = look->volumeTerm();
    const ValueBricks& bricks = node.volume->bricks(node.channel);
    look->table = makeOpticalTable(node.appearance, rangeOf(bricks), whole(node.volume->type()), unit);
    look->steepness = makeSteepnessTable(node.appearance.gradientOpacity);
    look->grid = previous && previous->term == term
                     ? previous->grid
                     : std::make_shared<const SkipGrid>(makeSkipGrid(bricks, look->table));
    return look;
}

}  // namespace voledit
