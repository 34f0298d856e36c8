#include "render/cell_arrays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/box3.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

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

std::array<Vec3, 4> cornersOf(const MappedCells& cells, std::size_t tetrahedron, const Mat4& gridFromDeformed) {
    std::array<Vec3, 4> corners;
    for (std::size_t n = 0; n < 4; ++n)
        corners[n] = transformPoint(gridFromDeformed, cells.deformed()[cells.tetrahedra()[tetrahedron][n]]);
    return corners;
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

CellArrays::Tetrahedron packed(const Weights& weights, double tolerance) {
    CellArrays::Tetrahedron made;
    made.origin = Vec4f(Vec3f(weights.origin), float(tolerance * glm::length(weights.rate[0])));
    for (std::size_t n = 0; n < 3; ++n)
        made.weight[n] = Vec4f(Vec3f(weights.rate[n + 1]), float(tolerance * glm::length(weights.rate[n + 1])));
    return made;
}

}  // namespace

std::pair<Index3, Index3> CellGrid::range(std::span<const Vec3, 4> corners) const {
    Box3 box;
    for (const Vec3& corner : corners) box = join(box, corner);
    const Index3 top = resolution - 1;
    return {glm::clamp(Index3(glm::floor(box.min - tolerance)), Index3(0), top),
            glm::clamp(Index3(glm::floor(box.max + tolerance)), Index3(0), top)};
}

CellGrid gridOver(const MappedCells& cells) {
    const Box3& bounds = cells.bounds();
    const Vec3 size = bounds.size();
    const Vec3 extent = glm::max(size, Vec3(std::max({size.x, size.y, size.z, 1e-30}) * 1e-6));
    const double count = kGridCellsPerCell * double(std::max<std::size_t>(cells.cellCount(), 1));
    for (double side = std::cbrt(extent.x * extent.y * extent.z / count);; side *= 1.5) {
        CellGrid grid;
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

void appendCells(const MappedCells& cells, const CellGrid& grid, CellArrays& made) {
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

void appendVertices(const MappedCells& cells, std::span<const CellArrays::Vertex> vertices, CellArrays& made) {
    const std::size_t first = made.vertices.size();
    made.vertices.insert(made.vertices.end(), vertices.begin(), vertices.end());
    for (auto corners : cells.tetrahedra()) {
        for (std::uint32_t& corner : corners) corner += std::uint32_t(first);
        made.corners.push_back(corners);
    }
}

}  // namespace voledit
