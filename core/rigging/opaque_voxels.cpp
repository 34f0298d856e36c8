#include "core/rigging/opaque_voxels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace voledit {

namespace {

/// Which object axis each grid axis runs along, if the grid stands straight; else no answer.
std::optional<Index3> axesOf(const Mat4& worldFromIndex) {
    Index3 axes(-1);
    for (int i = 0; i < 3; ++i) {
        const Vec3 step(worldFromIndex[i]);
        for (int a = 0; a < 3; ++a) {
            if (step[a] == 0) continue;
            if (axes[i] >= 0) return std::nullopt;
            axes[i] = a;
        }
        if (axes[i] < 0) return std::nullopt;
    }
    return axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2] ? std::optional(axes) : std::nullopt;
}

/// The volume's own samples as cells, if they stand straight and are not more than `longest` an axis.
std::optional<OpaqueVoxels> ownCells(const VolumeTerm& volume, int longest) {
    const VolumeGrid& grid = volume.volume->grid();
    const auto axes = axesOf(grid.worldFromIndex);
    if (!axes || std::max({grid.size.x, grid.size.y, grid.size.z}) > longest) return std::nullopt;
    OpaqueVoxels cells;
    for (int i = 0; i < 3; ++i) {
        const int a = (*axes)[i];
        const double step = grid.worldFromIndex[i][a];
        cells.size[a] = grid.size[i];
        cells.spacing[a] = std::abs(step);
        cells.origin[a] = grid.origin()[a] + std::min(0.0, step * (grid.size[i] - 1));
    }
    return cells;
}

OpaqueVoxels cubesOver(const Box3& box, int longest) {
    const Vec3 extent = box.size();
    const double side = std::max({extent.x, extent.y, extent.z});
    if (!std::isfinite(side))
        throw Error("rigging", "the object has no bounds, so there is no box to look for its opaque parts in",
                    "give it bounds");
    OpaqueVoxels cells;
    const double step = side > 0 ? side / longest : 1;
    for (int a = 0; a < 3; ++a) {
        cells.size[a] = std::max(1, static_cast<int>(std::ceil(extent[a] / step - 1e-9)));
        cells.spacing[a] = step;
        cells.origin[a] = box.center()[a] - 0.5 * step * (cells.size[a] - 1);
    }
    return cells;
}

}  // namespace

std::size_t OpaqueVoxels::count() const {
    return static_cast<std::size_t>(std::count(opaque.begin(), opaque.end(), std::uint8_t(1)));
}

Box3 OpaqueVoxels::bounds() const {
    Index3 low = size, high(-1);
    for (Index3 c(0); c.z < size.z; ++c.z)
        for (c.y = 0; c.y < size.y; ++c.y)
            for (c.x = 0; c.x < size.x; ++c.x)
                if (opaque[indexOf(c)]) {
                    low = glm::min(low, c);
                    high = glm::max(high, c);
                }
    return high.x < 0 ? Box3{} : Box3{centre(low), centre(high)};
}

OpaqueVoxels opaqueVoxels(const Term& term, double threshold, int longest, Progress* progress) {
    OpaqueVoxels cells;
    if (term.bounds.empty()) return cells;
    const auto* volume = std::get_if<VolumeTerm>(&term.node);
    auto own = volume ? ownCells(*volume, longest) : std::nullopt;
    cells = own ? std::move(*own) : cubesOver(term.bounds, longest);
    const std::size_t rows = std::size_t(cells.size.y) * std::size_t(cells.size.z);
    cells.opaque.resize(rows * std::size_t(cells.size.x));
    const auto sampleRow = [&](std::size_t row, std::vector<Vec3>& p, std::vector<ObjectSample>& found) {
        const int y = static_cast<int>(row % std::size_t(cells.size.y));
        const int z = static_cast<int>(row / std::size_t(cells.size.y));
        for (int x = 0; x < cells.size.x; ++x) p[std::size_t(x)] = cells.centre({x, y, z});
        sample(term, p, found, false, "");
        std::uint8_t* out = cells.opaque.data() + row * std::size_t(cells.size.x);
        for (const ObjectSample& s : found) *out++ = s.opacity >= threshold ? 1 : 0;
    };
    // Slice by slice, so that long work can be watched and stopped.
    for (int z = 0; z < cells.size.z; ++z) {
        report(progress, double(z) / cells.size.z);
        parallelFor(std::size_t(cells.size.y), 16, [&](std::size_t begin, std::size_t end) {
            std::vector<Vec3> p(std::size_t(cells.size.x));
            std::vector<ObjectSample> found(p.size());
            for (std::size_t y = begin; y < end; ++y)
                sampleRow(y + std::size_t(z) * std::size_t(cells.size.y), p, found);
        });
    }
    report(progress, 1);
    return cells;
}

}  // namespace voledit
