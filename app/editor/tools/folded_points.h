#pragma once
// Which control points fold a lattice, found once for each map.

#include <vector>

#include "core/stf/lattice.h"

namespace voledit {

/// Remembers the answer for the last map, for callers that ask every frame.
class FoldedPoints {
public:
    /// Control points that fold `map` (LatticeMap::foldingPoints), sorted; none where it is null or no lattice's.
    const std::vector<std::size_t>& of(const TransferPtr& map) {
        if (map != map_) {
            const auto* lattice = dynamic_cast<const LatticeMap*>(map.get());
            points_ = lattice ? lattice->foldingPoints() : std::vector<std::size_t>{};
            map_ = map;
        }
        return points_;
    }

private:
    TransferPtr map_;
    std::vector<std::size_t> points_;
};

}  // namespace voledit
