#include "core/stf/cell_overlap.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <optional>

#include "core/base/triangles.h"

namespace voledit {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// A tetrahedron's face on the outside of its cell.
struct Face {
    Triangle vertices;  // ascending
    int side;           // +1, −1: where the tetrahedron lies, seen from the vertices in this order
};

Face makeFace(Triangle v, int side) {
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}})
        if (v[std::size_t(a)] > v[std::size_t(b)]) {
            std::swap(v[std::size_t(a)], v[std::size_t(b)]);
            side = -side;
        }
    return {v, side};
}

bool repeats(const std::array<std::uint32_t, 4>& t) {
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] || t[2] == t[3];
}

/// The faces on the cells' outsides; nullopt if a hexahedron is folded or a tetrahedron degenerate. Tetrahedra with a
/// vertex twice are cells collapsed on purpose (a wedge): their neighbours share a face all the same.
std::optional<std::vector<Face>> outsides(const MappedCells& cells) {
    const auto tetrahedra = cells.tetrahedra();
    const std::size_t perCell = cells.tetrahedraPerCell();
    std::vector<Face> faces;
    faces.reserve((perCell == 1 ? 4 : 2) * tetrahedra.size());
    for (std::size_t c = 0; c < cells.cellCount(); ++c) {
        int orientation = 0;
        for (std::size_t n = perCell * c; n < perCell * (c + 1); ++n) {
            const auto& t = tetrahedra[n];
            if (repeats(t)) continue;
            if (cells.determinants()[n] == 0) return std::nullopt;
            const Vec3& origin = cells.deformed()[t[0]];
            const double volume = glm::determinant(Mat3(
                cells.deformed()[t[1]] - origin, cells.deformed()[t[2]] - origin, cells.deformed()[t[3]] - origin));
            const int side = volume > 0 ? 1 : -1;
            if (orientation == -side) return std::nullopt;
            orientation = side;
            faces.push_back(makeFace({t[0], t[1], t[2]}, side));
            faces.push_back(makeFace({t[1], t[2], t[3]}, -side));
            if (perCell > 1) continue;  // the other two hold the diagonal, between tetrahedra of this hexahedron
            faces.push_back(makeFace({t[0], t[2], t[3]}, side));
            faces.push_back(makeFace({t[0], t[1], t[3]}, -side));
        }
    }
    return faces;
}

/// Faces that belong to one tetrahedron only; nullopt if two on one face lie on the same side, or more than two share
/// it.
std::optional<std::vector<Triangle>> boundary(std::vector<Face> faces, std::size_t vertexCount) {
    // Sorted by the lowest vertex at first, by counting: each has a handful of faces.
    std::vector<std::uint32_t> starts(vertexCount + 1, 0);
    for (const Face& face : faces) ++starts[face.vertices[0] + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Face> sorted(faces.size());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (const Face& face : faces) sorted[next[face.vertices[0]]++] = face;

    std::vector<Triangle> result;
    for (std::size_t v = 0; v < vertexCount; ++v) {
        const auto first = sorted.begin() + starts[v], last = sorted.begin() + starts[v + 1];
        std::sort(first, last, [](const Face& a, const Face& b) { return a.vertices < b.vertices; });
        for (auto face = first; face != last;) {
            auto end = face + 1;
            while (end != last && end->vertices == face->vertices) ++end;
            if (end - face > 2 || (end - face == 2 && face->side == (face + 1)->side)) return std::nullopt;
            if (end - face == 1) result.push_back(face->vertices);
            face = end;
        }
    }
    return result;
}

/// True if two triangles touch elsewhere than in vertices that they share. Two on one edge touch only if folded flat
/// onto each other, which leaves no room for a cell to lie over another.
bool touchElsewhere(std::span<const Vec3> positions, const Triangle& a, const Triangle& b, double thickness) {
    std::array<int, 3> sharedA{}, sharedB{};
    int shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (a[i] == b[j]) {
                sharedA[i] = sharedB[j] = 1;
                ++shared;
            }
    const auto corners = [&](const Triangle& t) {
        return std::array<Vec3, 3>{positions[t[0]], positions[t[1]], positions[t[2]]};
    };
    const auto cornersA = corners(a), cornersB = corners(b);
    if (shared >= 2) return false;
    if (shared == 0) return trianglesTouch(cornersA, cornersB, thickness);
    // Two sheets through one vertex meet in a segment from there, which ends on the far edge of one of them.
    const auto farEdgeTouches = [&](const std::array<Vec3, 3>& t, const std::array<int, 3>& common,
                                    const std::array<Vec3, 3>& other) {
        const std::size_t v = common[0] ? 0 : common[1] ? 1 : 2;
        const Vec3 &start = t[(v + 1) % 3], &end = t[(v + 2) % 3];
        return trianglesTouch({start, end, end}, other, thickness);
    };
    return farEdgeTouches(cornersA, sharedA, cornersB) || farEdgeTouches(cornersB, sharedB, cornersA);
}

/// Boxes of the sets of cells that hang together by vertices.
std::vector<Box3> componentBoxes(const MappedCells& cells) {
    std::vector<std::uint32_t> parent(cells.deformed().size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto rootOf = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (std::size_t c = 0; c < cells.cellCount(); ++c)
        for (const std::uint32_t v : cells.cellVertices(c)) parent[rootOf(v)] = rootOf(cells.cellVertices(c)[0]);
    std::vector<Box3> boxOfRoot(parent.size());
    for (std::size_t c = 0; c < cells.cellCount(); ++c)
        for (const std::uint32_t v : cells.cellVertices(c)) {
            Box3& box = boxOfRoot[rootOf(v)];
            box = join(box, cells.deformed()[v]);
        }
    std::erase_if(boxOfRoot, [](const Box3& box) { return box.empty(); });
    return boxOfRoot;
}

/// True too where so many boxes meet that trying all pairs would take too long.
bool somePair(std::span<const Box3> boxes, const std::function<bool(std::uint32_t, std::uint32_t)>& met) {
    std::size_t tries = 1'000'000 + 100 * boxes.size();
    return anyPairOfBoxes(boxes, [&](std::uint32_t a, std::uint32_t b) { return tries-- == 0 || met(a, b); });
}

bool someBoxWithinAnother(std::span<const Box3> boxes) {
    const auto within = [](const Box3& a, const Box3& b) { return b.contains(a.min) && b.contains(a.max); };
    return somePair(boxes, [&](std::uint32_t a, std::uint32_t b) {
        return within(boxes[a], boxes[b]) || within(boxes[b], boxes[a]);
    });
}

}  // namespace

bool cellsMayOverlap(const MappedCells& cells) {
    auto faces = outsides(cells);
    if (!faces) return true;
    const auto triangles = boundary(std::move(*faces), cells.deformed().size());
    if (!triangles) return true;
    std::vector<Box3> boxes(triangles->size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const std::uint32_t v : (*triangles)[i]) boxes[i] = join(boxes[i], cells.deformed()[v]);
        boxes[i].max += cells.thickness();
    }
    const bool touch = somePair(boxes, [&](std::uint32_t a, std::uint32_t b) {
        return touchElsewhere(cells.deformed(), (*triangles)[a], (*triangles)[b], cells.thickness());
    });
    return touch || someBoxWithinAnother(componentBoxes(cells));
}

}  // namespace voledit
