#include "core/stf/overlapping_cells.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/base/triangles.h"

namespace voledit {

namespace {

/// A cell as what separating planes need of it.
struct Hull {
    std::array<Vec3, 8> corner;
    std::size_t corners = 0;
    std::array<Vec3, 6> normal;  // of the faces, any length
    std::size_t normals = 0;
    Vec3 middle{0};
};

Hull hullOf(const MappedCells& cells, std::size_t c) {
    // Faces of a hexahedron as two pairs of opposite corners each, of a tetrahedron as three corners.
    static constexpr int kQuads[6][4] = {{0, 3, 1, 2}, {4, 7, 5, 6}, {0, 5, 1, 4},
                                         {2, 7, 3, 6}, {0, 6, 2, 4}, {1, 7, 3, 5}};
    static constexpr int kTriangles[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    Hull hull;
    for (const std::uint32_t v : cells.cellVertices(c)) {
        hull.middle += cells.deformed()[v];
        hull.corner[hull.corners++] = cells.deformed()[v];
    }
    hull.middle /= double(hull.corners);
    const auto at = [&](int v) { return hull.corner[std::size_t(v)]; };
    if (hull.corners == 8)
        for (const auto& q : kQuads) hull.normal[hull.normals++] = glm::cross(at(q[1]) - at(q[0]), at(q[3]) - at(q[2]));
    else
        for (const auto& t : kTriangles)
            hull.normal[hull.normals++] = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    return hull;
}

std::pair<double, double> extent(const Hull& hull, const Vec3& along) {
    double low = kInfinity, high = -kInfinity;
    for (std::size_t v = 0; v < hull.corners; ++v) {
        const double s = glm::dot(hull.corner[v], along);
        low = std::min(low, s);
        high = std::max(high, s);
    }
    return {low, high};
}

bool separates(const Vec3& along, const Hull& a, const Hull& b) {
    const auto [lowA, highA] = extent(a, along);
    const auto [lowB, highB] = extent(b, along);
    return highA < lowB || highB < lowA;
}

bool lieApart(const Hull& a, const Hull& b) {
    if (separates(b.middle - a.middle, a, b)) return true;
    for (std::size_t n = 0; n < a.normals; ++n)
        if (separates(a.normal[n], a, b)) return true;
    for (std::size_t n = 0; n < b.normals; ++n)
        if (separates(b.normal[n], a, b)) return true;
    return false;
}

/// 1 for cells with a tetrahedron that is degenerate, or inverted unlike most of them.
std::vector<char> foldedCells(const MappedCells& cells) {
    const auto determinants = cells.determinants();
    const auto negative = std::count_if(determinants.begin(), determinants.end(), [](double d) { return d < 0; });
    const double usual = 2 * std::size_t(negative) > determinants.size() ? -1 : 1;
    std::vector<char> folded(cells.cellCount(), 0);
    for (std::size_t t = 0; t < determinants.size(); ++t)
        if (!(determinants[t] * usual > 0)) folded[t / cells.tetrahedraPerCell()] = 1;
    return folded;
}

}  // namespace

std::vector<char> overlappingCells(const MappedCells& cells) {
    const std::size_t count = cells.cellCount();
    const std::vector<char> folded = foldedCells(cells);
    std::vector<char> overlapping = folded;
    std::vector<Hull> hulls(count);
    std::vector<Box3> boxes(count);
    for (std::size_t c = 0; c < count; ++c) {
        hulls[c] = hullOf(cells, c);
        for (std::size_t v = 0; v < hulls[c].corners; ++v) boxes[c] = join(boxes[c], hulls[c].corner[v]);
        boxes[c].min -= cells.thickness();
        boxes[c].max += cells.thickness();
    }
    const auto meet = [&](std::uint32_t a, std::uint32_t b) {
        for (const std::uint32_t v : cells.cellVertices(a))
            for (const std::uint32_t w : cells.cellVertices(b))
                if (v == w) return folded[a] || folded[b];
        return !lieApart(hulls[a], hulls[b]);
    };
    std::size_t tries = 1'000'000 + 100 * count;
    const bool tooMany = anyPairOfBoxes(boxes, [&](std::uint32_t a, std::uint32_t b) {
        if (!(overlapping[a] && overlapping[b]) && meet(a, b)) overlapping[a] = overlapping[b] = 1;
        return tries-- == 0;
    });
    if (tooMany) std::fill(overlapping.begin(), overlapping.end(), char(1));
    return overlapping;
}

}  // namespace voledit
