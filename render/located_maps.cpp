#include "render/located_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "render/cell_mesh.h"

namespace voledit {

namespace {

/// Vertices of a map whose source goes on by `nextFromSource`.
std::vector<CellArrays::Vertex> verticesOf(const MappedCells& cells, const CellGrid& grid, const Mat4& nextFromSource) {
    std::vector<CellArrays::Vertex> vertices(cells.source().size());
    const Mat3 deformedFromGrid = glm::inverse(Mat3(grid.gridFromDeformed));
    parallelFor(vertices.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            vertices[v] = {Vec3f(transformPoint(nextFromSource, cells.source()[v])),
                           Mat3f(Mat3(nextFromSource) * cells.jacobians()[v] * deformedFromGrid)};
    });
    return vertices;
}

/// False only if nothing can be seen at any point of `box`, which lies in the source space of the map above `chain`.
bool mayBeSeen(std::span<const LocatedTransfer> chain, const Box3& box, const SlicePlan& plan,
               const Visibility& visibility) {
    if (chain.empty())
        return canBeSeen(transformed(box, plan.indexFromSource), Vec3(0.01), plan.volume->volume->grid().indexDomain(),
                         visibility);
    const SpatialTransferFunction& map = *chain[0].transfer->by;
    const Box3 here = transformed(box, chain[0].deformedFromSource);
    if (map.outside() == Outside::Keep && mayBeSeen(chain.subspan(1), here, plan, visibility)) return true;
    return map.cells()->anySourceBox(
        here, [&](const Box3& source) { return mayBeSeen(chain.subspan(1), source, plan, visibility); });
}

}  // namespace

LocatedMaps makeLocatedMaps(const SlicePlan& plan) {
    LocatedMaps made;
    std::vector<CellGrid> grids;
    for (const LocatedTransfer& located : plan.located) grids.push_back(gridOver(*located.transfer->by->cells()));
    made.entryFromSource = grids[0].gridFromDeformed * plan.located[0].deformedFromSource;
    for (std::size_t m = 0; m < grids.size(); ++m) {
        const SpatialTransferFunction& map = *plan.located[m].transfer->by;
        const Mat4 nextFromSource = m + 1 < grids.size()
                                        ? grids[m + 1].gridFromDeformed * plan.located[m + 1].deformedFromSource
                                        : plan.indexFromSource;
        made.nextFromSource.push_back(nextFromSource);
        const Index3& r = grids[m].resolution;
        made.maps.push_back({Mat4f(nextFromSource * glm::inverse(grids[m].gridFromDeformed)),
                             {r.x, r.y, r.z, std::int32_t(made.cells.size())},
                             {map.outside() == Outside::Keep, 0, 0, 0}});
        appendCells(*map.cells(), grids[m], made);
        appendVertices(*map.cells(), verticesOf(*map.cells(), grids[m], nextFromSource), made);
    }
    return made;
}

std::vector<char> cellsSeen(const SlicePlan& plan, const Visibility& visibility, double slab) {
    const MappedCells& cells = *plan.forward->by->cells();
    if (visibility.seesEverything()) return std::vector<char>(cells.cellCount(), 1);
    return cellsSeen(cells, plan.worldFromDeformed, slab,
                     [&](const Box3& source) { return mayBeSeen(plan.located, source, plan, visibility); });
}

}  // namespace voledit
