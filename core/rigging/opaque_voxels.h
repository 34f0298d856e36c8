#pragma once
// Which voxels of a grid are opaque: what rigging looks at.

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/objects/term.h"

namespace voledit {

/// A grid of cells over a box, one byte a cell: 1 where the object is opaque at the cell's centre.
struct OpaqueVoxels {
    Index3 size{0};
    Vec3 origin{0};                    // centre of cell (0, 0, 0), the object's space
    Vec3 spacing{1};                   // of the centres, > 0
    std::vector<std::uint8_t> opaque;  // size.x·y·z, x fastest

    std::size_t count() const;
    Vec3 centre(const Index3& cell) const { return origin + Vec3(cell) * spacing; }
    std::size_t indexOf(const Index3& c) const {
        return std::size_t(c.x) + std::size_t(size.x) * (std::size_t(c.y) + std::size_t(size.y) * std::size_t(c.z));
    }
    /// Box of the opaque cells' centres; empty where none is opaque.
    Box3 bounds() const;
};

/// Samples `term` over its bounds: opaque is opacity ≥ `threshold` (0…1]. Cells are cubes such that the longest side
/// has `longest` of them; for a volume alone whose axes stand straight and have no more samples than that, its samples
/// are the cells. No cells where nothing has bounds. Throws Error for an object without finite bounds, and Cancelled
/// when `progress` (may be null) is.
OpaqueVoxels opaqueVoxels(const Term& term, double threshold, int longest = 256, Progress* progress = nullptr);

}  // namespace voledit
