#include "render/located_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/cell_mesh.h"

namespace voledit {

namespace {

constexpr double kGridCellsPerCell = 4;
constexpr int kMaxResolution = 256;
/// Grid cells that the boxes of a map's tetrahedra may meet, for each of them; cells that are long and oblique get a
/// coarser grid.
constexpr std::size_t kEntriesPerTetrahedron = 64;

/// How far beyond its faces a tetrahedron accepts points, in units of grid cells: rounding to single precision.
double toleranceOf(const Index3& resolution) {
    return 16 * double(std::numeric_limits<float>::epsilon()) * std::max({resolution.x, resolution.y, resolution.z, 8});
}

struct Grid {
    Index3 resolution{1};
    Mat4 gridFromDeformed{1};
    double tolerance = 0;

    /// First and last cell that the box of `corners` meets.
    std::pair<Index3, Index3> range(std::span<const Vec3, 4> corners) const {
        Box3 box;
        for (const Vec3& corner : corners) box = join(box, corner);
        const Index3 top = resolution - 1;
        return {glm::clamp(Index3(glm::floor(box.min - tolerance)), Index3(0), top),
                glm::clamp(Index3(glm::floor(box.max + tolerance)), Index3(0), top)};
    }
};

std::array<Vec3, 4> cornersOf(const MappedCells& cells, std::size_t tetrahedron, const Mat4& gridFromDeformed) {
    std::array<Vec3, 4> corners;
    for (std::size_t n = 0; n < 4; ++n)
        corners[n] = transformPoint(gridFromDeformed, cells.deformed()[cells.tetrahedra()[tetrahedron][n]]);
    return corners;
}

Grid gridOver(const MappedCells& cells) {
    const Box3& bounds = cells.bounds();
    const Vec3 size = bounds.size();
    const Vec3 extent = glm::max(size, Vec3(std::max({size.x, size.y, size.z, 1e-30}) * 1e-6));
    const double count = kGridCellsPerCell * double(std::max<std::size_t>(cells.cellCount(), 1));
    for (double side = std::cbrt(extent.x * extent.y * extent.z / count);; side *= 1.5) {
        Grid grid;
        grid.resolution =
            glm::clamp(Index3(glm::min(extent / side, Vec3(kMaxResolution))), Index3(1), Index3(kMaxResolution));
        grid.tolerance = toleranceOf(grid.resolution);
        const Vec3 perUnit = Vec3(grid.resolution) / extent;
        for (int a = 0; a < 3; ++a) {
            grid.gridFromDeformed[a][a] = perUnit[a];
            grid.gridFromDeformed[3][a] = -bounds.min[a] * perUnit[a];
        }
        if (grid.resolution == Index3(1)) return grid;
        std::size_t entries = 0;
        for (std::size_t t = 0; t < cells.tetrahedra().size(); ++t) {
            const auto [first, last] = grid.range(cornersOf(cells, t, grid.gridFromDeformed));
            const Index3 n = last - first + 1;
            entries += std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z);
        }
        if (entries <= kEntriesPerTetrahedron * cells.tetrahedra().size()) return grid;
    }
}

/// Weights of the vertices as affine functions: of vertices 1, 2, 3 the rows, of vertex 0 what is left of 1.
struct Weights {
    Vec3 origin;
    std::array<Vec3, 4> rate;  // of vertices 0, 1, 2, 3

    explicit Weights(std::span<const Vec3, 4> corners) : origin(corners[0]) {
        const Vec3 e1 = corners[1] - origin, e2 = corners[2] - origin, e3 = corners[3] - origin;
        const double volume = glm::dot(e1, glm::cross(e2, e3));
        rate = {Vec3(0), glm::cross(e2, e3) / volume, glm::cross(e3, e1) / volume, glm::cross(e1, e2) / volume};
        rate[0] = -(rate[1] + rate[2] + rate[3]);
    }

    /// False only if one weight is below −2 tolerances (as distances) all over the grid cell: its face separates them.
    bool mayMeet(const Index3& cell, double tolerance) const {
        const Vec3 middle = Vec3(cell) + 0.5 - origin;
        for (std::size_t n = 0; n < 4; ++n) {
            const double reach = glm::dot(glm::abs(rate[n]), Vec3(0.5)) + 2 * tolerance * glm::length(rate[n]);
            if ((n == 0 ? 1 : 0) + glm::dot(rate[n], middle) + reach < 0) return false;
        }
        return true;
    }
};

LocatedMaps::Tetrahedron packed(const Weights& weights, double tolerance) {
    LocatedMaps::Tetrahedron made;
    made.origin = Vec4f(Vec3f(weights.origin), float(tolerance * glm::length(weights.rate[0])));
    for (std::size_t n = 0; n < 3; ++n)
        made.weight[n] = Vec4f(Vec3f(weights.rate[n + 1]), float(tolerance * glm::length(weights.rate[n + 1])));
    return made;
}

/// Appends tetrahedra, and the grid's starts and lists.
void appendCells(const MappedCells& cells, const Grid& grid, LocatedMaps& made) {
    const std::size_t count = cells.tetrahedra().size(), firstTetrahedron = made.tetrahedra.size();
    made.tetrahedra.resize(firstTetrahedron + count);
    const Index3 r = grid.resolution;
    std::vector<std::vector<std::uint32_t>> meets(count);  // grid cells of each tetrahedron
    parallelFor(count, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            if (cells.determinants()[t] == 0) continue;
            const auto corners = cornersOf(cells, t, grid.gridFromDeformed);
            const Weights weights(corners);
            made.tetrahedra[firstTetrahedron + t] = packed(weights, grid.tolerance);
            const auto [first, last] = grid.range(corners);
            for (int k = first.z; k <= last.z; ++k)
                for (int j = first.y; j <= last.y; ++j)
                    for (int i = first.x; i <= last.x; ++i)
                        if (weights.mayMeet({i, j, k}, grid.tolerance))
                            meets[t].push_back(std::uint32_t(i + r.x * (j + r.y * k)));
        }
    });
    const std::size_t firstStart = made.cells.size(),
                      gridCells = std::size_t(r.x) * std::size_t(r.y) * std::size_t(r.z);
    std::vector<std::size_t> next(gridCells + 1, 0);
    for (const auto& list : meets)
        for (const std::uint32_t cell : list) ++next[cell + 1];
    next[0] = firstStart + gridCells + 1;
    for (std::size_t c = 0; c < gridCells; ++c) next[c + 1] += next[c];
    if (next.back() > std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw Error("mapped cells", "they are too many for slices", "use --renderer rays");
    made.cells.insert(made.cells.end(), next.begin(), next.end());
    made.cells.resize(next.back());
    for (std::size_t t = 0; t < count; ++t)
        for (const std::uint32_t cell : meets[t]) made.cells[next[cell]++] = std::uint32_t(firstTetrahedron + t);
}

/// Appends vertices and the tetrahedra's corners.
void appendVertices(const MappedCells& cells, const Grid& grid, const Mat4& nextFromSource, LocatedMaps& made) {
    const std::size_t firstVertex = made.vertices.size(), count = cells.source().size();
    made.vertices.resize(firstVertex + count);
    const Mat3 deformedFromGrid = glm::inverse(Mat3(grid.gridFromDeformed));
    parallelFor(count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            made.vertices[firstVertex + v] = {Vec3f(transformPoint(nextFromSource, cells.source()[v])),
                                              Mat3f(Mat3(nextFromSource) * cells.jacobians()[v] * deformedFromGrid)};
    });
    for (auto corners : cells.tetrahedra()) {
        for (std::uint32_t& corner : corners) corner += std::uint32_t(firstVertex);
        made.corners.push_back(corners);
    }
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
    std::vector<Grid> grids;
    for (const LocatedTransfer& located : plan.located) grids.push_back(gridOver(*located.transfer->by->cells()));
    made.entryFromSource = grids[0].gridFromDeformed * plan.located[0].deformedFromSource;
    for (std::size_t m = 0; m < grids.size(); ++m) {
        const SpatialTransferFunction& map = *plan.located[m].transfer->by;
        const Mat4 nextFromSource = m + 1 < grids.size()
                                        ? grids[m + 1].gridFromDeformed * plan.located[m + 1].deformedFromSource
                                        : plan.indexFromSource;
        const Index3& r = grids[m].resolution;
        made.maps.push_back({Mat4f(nextFromSource * glm::inverse(grids[m].gridFromDeformed)),
                             {r.x, r.y, r.z, std::int32_t(made.cells.size())},
                             {map.outside() == Outside::Keep, 0, 0, 0}});
        appendCells(*map.cells(), grids[m], made);
        appendVertices(*map.cells(), grids[m], nextFromSource, made);
    }
    return made;
}

std::vector<char> hexahedraSeen(const SlicePlan& plan, const Visibility& visibility, double slab) {
    const MappedCells& cells = *plan.forward->by->cells();
    std::vector<char> seen(cells.cellCount(), 1);
    if (visibility.seesEverything()) return seen;
    const Mat3 deformedFromWorld = glm::inverse(Mat3(plan.worldFromDeformed));
    parallelFor(seen.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            Box3 box;
            Vec3 reach(0);
            for (const std::uint32_t v : cells.cellVertices(h)) {
                box = join(box, cells.source()[v]);
                const Mat3 rows = glm::transpose(cells.jacobians()[v] * deformedFromWorld);
                reach = glm::max(reach, Vec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2])));
            }
            // Slabs reach as far as the neighbouring slice, and the GPU's places are rounded.
            const Vec3 margin = reach * slab + 1e-5 * cells.bounds().size();
            seen[h] = mayBeSeen(plan.located, {box.min - margin, box.max + margin}, plan, visibility);
        }
    });
    return seen;
}

}  // namespace voledit
