#include "render/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "core/base/parallel.h"
#include "render/cell_cut.h"

namespace voledit {

namespace {

/// Bricks of 8³ voxels: larger ones skip less of what is empty, smaller ones cost more polygons (measured:
/// render/README.md).
constexpr int kBrickSide = 8;

/// Voxels around a box that Visibility answers for by itself, less a little for the GPU's rounding.
constexpr double kAnswered = 0.98;

/// How far slabs reach beyond what they cut of `box`, in index units and more than Visibility answers for, d index / d
/// world having these rows' lengths: half their extent along the ray to either side, at the domain's faces the whole.
Vec3 marginOf(const Box3& box, const Vec3& indexPerWorld, double slab, const Box3& domain) {
    const Vec3 whole = indexPerWorld * slab;
    const bool inside =
        glm::all(glm::greaterThan(box.min - whole, domain.min)) && glm::all(glm::lessThan(box.max + whole, domain.max));
    return glm::max(whole * (inside ? 0.5 : 1.0) - kAnswered, Vec3(0));
}

Vec3 rowLengths(const Mat3& m) {
    const Mat3 rows = glm::transpose(m);
    return {glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2])};
}

/// Gives each pair of vertices one number.
class EdgeNumbers {
public:
    /// @param capacity  for each vertex, how many edges may start there, this being the lower of the two
    explicit EdgeNumbers(const std::vector<std::uint32_t>& capacity) : first_(capacity.size() + 1, 0) {
        for (std::size_t v = 0; v < capacity.size(); ++v) first_[v + 1] = first_[v] + capacity[v];
        used_.assign(capacity.size(), 0);
        entries_.resize(first_.back());
    }

    std::uint32_t number(std::uint32_t a, std::uint32_t b, std::vector<std::array<std::uint32_t, 2>>& edges) {
        if (a > b) std::swap(a, b);
        const std::size_t begin = first_[a], end = begin + used_[a];
        for (std::size_t n = begin; n < end; ++n)
            if (entries_[n].to == b) return entries_[n].edge;
        const auto edge = std::uint32_t(edges.size());
        edges.push_back({a, b});
        entries_[end] = {b, edge};
        ++used_[a];
        return edge;
    }

private:
    struct Entry {
        std::uint32_t to, edge;
    };
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> used_;
    std::vector<Entry> entries_;
};

/// Fills in the edges of all cells.
void numberEdges(CellMesh& mesh, std::span<const std::array<int, 2>> edgesOfCell) {
    std::vector<std::uint32_t> capacity(mesh.position.size(), 0);
    const std::size_t stride = std::size_t(mesh.verticesPerCell());
    for (std::size_t c = 0; c < mesh.cellVertices.size(); c += stride)
        for (const auto& [a, b] : edgesOfCell)
            ++capacity[std::min(mesh.cellVertices[c + std::size_t(a)], mesh.cellVertices[c + std::size_t(b)])];
    EdgeNumbers numbers(capacity);
    mesh.cellEdges.reserve(mesh.cellCount() * edgesOfCell.size());
    for (std::size_t c = 0; c < mesh.cellVertices.size(); c += stride)
        for (const auto& [a, b] : edgesOfCell)
            mesh.cellEdges.push_back(numbers.number(mesh.cellVertices[c + std::size_t(a)],
                                                    mesh.cellVertices[c + std::size_t(b)], mesh.edges));
}

/// Positions and sources of all vertices, and the lengths of their Jacobians' rows.
void placeVertices(const MappedCells& cells, const Mat4& worldFromDeformed, const Mat4& indexFromSource, CellMesh& mesh,
                   std::span<Vec3> indexPerWorld) {
    mesh.kind = CellMesh::Kind::Tetrahedron;
    const std::size_t vertices = cells.deformed().size();
    mesh.position.resize(vertices);
    mesh.source.resize(vertices);
    const Mat3 deformedFromWorld = glm::inverse(Mat3(worldFromDeformed));
    parallelFor(vertices, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const Mat3 jacobian = Mat3(indexFromSource) * cells.jacobians()[v] * deformedFromWorld;
            mesh.position[v] = transformPoint(worldFromDeformed, cells.deformed()[v]);
            mesh.source[v] = {Vec3f(transformPoint(indexFromSource, cells.source()[v])), Mat3f(jacobian)};
            indexPerWorld[v] = rowLengths(jacobian);
        }
    });
}

}  // namespace

bool canBeSeen(Box3 box, const Vec3& margin, const Box3& domain, const Visibility& visibility) {
    if (visibility.seesEverything()) return true;
    box = {box.min - margin, box.max + margin};
    for (int a = 0; a < 3; ++a)
        if (box.max[a] < domain.min[a] - 0.01 || box.min[a] > domain.max[a] + 0.01) return false;
    return visibility.visible(box);
}

CellMesh brickMesh(const Index3& count, const std::vector<char>& seen,
                   const std::function<Vec3(const Index3&)>& positionOf) {
    CellMesh mesh;
    mesh.kind = CellMesh::Kind::Brick;
    const auto vertexAt = [&](Index3 corner) {
        return std::uint32_t(corner.x + (count.x + 1) * (corner.y + (count.y + 1) * corner.z));
    };
    for (int k = 0; k <= count.z; ++k)
        for (int j = 0; j <= count.y; ++j)
            for (int i = 0; i <= count.x; ++i) mesh.position.push_back(positionOf({i, j, k}));
    std::size_t n = 0;
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i, ++n) {
                if (!seen[n]) {
                    ++mesh.culled;
                    continue;
                }
                for (int v = 0; v < 8; ++v)
                    mesh.cellVertices.push_back(vertexAt({i + (v & 1), j + (v >> 1 & 1), k + (v >> 2)}));
            }
    numberEdges(mesh, kBrickEdges);
    return mesh;
}

CellMesh brickMesh(const VolumeGrid& grid, const Mat4& worldFromIndex, const Visibility& visibility, double slab) {
    const Box3 domain = grid.indexDomain();
    const Vec3 indexPerWorld = rowLengths(glm::inverse(Mat3(worldFromIndex)));
    Index3 count;
    for (int a = 0; a < 3; ++a) count[a] = std::max(int(std::ceil(domain.size()[a] / kBrickSide)), 1);
    const auto indexAt = [&](Index3 corner) {
        return glm::min(domain.min + Vec3(corner) * double(kBrickSide), domain.max);
    };
    std::vector<char> seen;
    for (int k = 0; k < count.z; ++k)
        for (int j = 0; j < count.y; ++j)
            for (int i = 0; i < count.x; ++i) {
                const Box3 box{indexAt({i, j, k}), indexAt({i + 1, j + 1, k + 1})};
                seen.push_back(canBeSeen(box, marginOf(box, indexPerWorld, slab, domain), domain, visibility));
            }
    return brickMesh(count, seen,
                     [&](const Index3& corner) { return transformPoint(worldFromIndex, indexAt(corner)); });
}

std::vector<char> cellsSeen(const MappedCells& cells, const Mat4& worldFromDeformed, double slab,
                            const std::function<bool(const Box3&)>& mayBeSeen) {
    std::vector<char> seen(cells.cellCount());
    const Mat3 deformedFromWorld = glm::inverse(Mat3(worldFromDeformed));
    parallelFor(seen.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            Box3 box;
            Vec3 reach(0);
            for (const std::uint32_t v : cells.cellVertices(c)) {
                box = join(box, cells.source()[v]);
                reach = glm::max(reach, rowLengths(cells.jacobians()[v] * deformedFromWorld));
            }
            // Slabs reach as far as the neighbouring slice, and the GPU's places are rounded.
            const Vec3 margin = reach * slab + 1e-5 * cells.bounds().size();
            seen[c] = mayBeSeen({box.min - margin, box.max + margin});
        }
    });
    return seen;
}

CellMesh boxMesh(const Box3& box, const Mat4& worldFromBox) {
    CellMesh mesh;
    for (int c = 0; c < 8; ++c) {
        mesh.position.push_back(transformPoint(worldFromBox, box.corner(c)));
        mesh.cellVertices.push_back(std::uint32_t(c));
    }
    numberEdges(mesh, kBrickEdges);
    return mesh;
}

CellMesh tetrahedronMesh(const MappedCells& cells, const Mat4& worldFromDeformed, const Mat4& indexFromSource,
                         const VolumeGrid& grid, const Visibility& visibility, double slab,
                         const std::vector<char>& wanted) {
    CellMesh mesh;
    std::vector<Vec3> indexPerWorld(cells.deformed().size());
    placeVertices(cells, worldFromDeformed, indexFromSource, mesh, indexPerWorld);
    const Box3 domain = grid.indexDomain();
    const auto tetrahedra = cells.tetrahedra();
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
        if (cells.determinants()[t] == 0) continue;
        if (!wanted.empty() && !wanted[t / cells.tetrahedraPerCell()]) continue;
        Box3 box;
        Vec3 steepest(0);
        for (const std::uint32_t v : tetrahedra[t]) {
            box = join(box, Vec3(mesh.source[v].index));
            steepest = glm::max(steepest, indexPerWorld[v]);
        }
        const Vec3 margin = marginOf(box, steepest, slab, domain);
        if (canBeSeen(box, margin, domain, visibility)) {
            mesh.cellVertices.insert(mesh.cellVertices.end(), tetrahedra[t].begin(), tetrahedra[t].end());
            if (!visibility.seesEverything()) mesh.margin.push_back(Vec3f(margin) * 1.0001F);
        } else {
            ++mesh.culled;
        }
    }
    numberEdges(mesh, kTetrahedronEdges);
    return mesh;
}

CellMesh tetrahedronMesh(const MappedCells& cells, const Mat4& worldFromDeformed, const Mat4& entryFromSource,
                         const std::vector<char>& seen) {
    CellMesh mesh;
    std::vector<Vec3> unused(cells.deformed().size());
    placeVertices(cells, worldFromDeformed, entryFromSource, mesh, unused);
    const auto tetrahedra = cells.tetrahedra();
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
        if (cells.determinants()[t] == 0) continue;
        if (seen[t / cells.tetrahedraPerCell()])
            mesh.cellVertices.insert(mesh.cellVertices.end(), tetrahedra[t].begin(), tetrahedra[t].end());
        else
            ++mesh.culled;
    }
    numberEdges(mesh, kTetrahedronEdges);
    return mesh;
}

}  // namespace voledit
