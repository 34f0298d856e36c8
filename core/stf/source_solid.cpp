#include "core/stf/source_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voledit {

namespace {

constexpr double kFlat = 1e-6;  // of the box's diagonal: how far from a face its vertices may lie

using Triangle = std::array<std::uint32_t, 3>;

Mat3 sourceEdges(const MappedCells& cells, const std::array<std::uint32_t, 4>& t) {
    const auto q = [&](std::size_t n) { return cells.source()[t[n]]; };
    return Mat3(q(1) - q(0), q(2) - q(0), q(3) - q(0));
}

/// The triangles that belong to one tetrahedron only.
std::vector<Triangle> openTriangles(const MappedCells& cells) {
    std::vector<Triangle> all;
    all.reserve(4 * cells.tetrahedra().size());
    for (auto t : cells.tetrahedra()) {
        std::sort(t.begin(), t.end());
        all.push_back({t[0], t[1], t[2]});
        all.push_back({t[0], t[1], t[3]});
        all.push_back({t[0], t[2], t[3]});
        all.push_back({t[1], t[2], t[3]});
    }
    std::sort(all.begin(), all.end());
    std::vector<Triangle> open;
    for (std::size_t n = 0; n < all.size();) {
        std::size_t next = n + 1;
        while (next < all.size() && all[next] == all[n]) ++next;
        if (next == n + 1) open.push_back(all[n]);
        n = next;
    }
    return open;
}

/// The planes that `triangles` lie in, their normals towards `inside`; none where there are too many.
std::vector<Vec4> planesOf(const MappedCells& cells, const std::vector<Triangle>& triangles, const Vec3& inside,
                           double slack) {
    std::vector<Vec4> planes;
    const auto liesIn = [&](const Triangle& t, const Vec4& plane) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
            return std::abs(glm::dot(Vec3(plane), cells.source()[v]) + plane.w) <= slack;
        });
    };
    for (const Triangle& t : triangles) {
        if (std::any_of(planes.begin(), planes.end(), [&](const Vec4& plane) { return liesIn(t, plane); })) continue;
        const Vec3 &a = cells.source()[t[0]], &b = cells.source()[t[1]], &c = cells.source()[t[2]];
        const Vec3 across = glm::cross(b - a, c - a);
        const double area = glm::length(across);
        if (!(area > slack * slack)) continue;
        const Vec3 normal = glm::dot(across, inside - a) < 0 ? -across / area : across / area;
        if (planes.size() == kMostSourceFaces) return {};
        planes.emplace_back(normal, -glm::dot(normal, a));
    }
    return planes;
}

/// How many tetrahedra's sources hold q.
int holding(const MappedCells& cells, const Vec3& q) {
    int count = 0;
    for (const auto& t : cells.tetrahedra()) {
        const Mat3 edges = sourceEdges(cells, t);
        if (glm::determinant(edges) == 0) continue;
        const Vec3 weight = glm::inverse(edges) * (q - cells.source()[t[0]]);
        count += std::min({weight.x, weight.y, weight.z, 1 - weight.x - weight.y - weight.z}) >= 0;
    }
    return count;
}

}  // namespace

Box3 sourceBox(const MappedCells& cells) {
    Box3 box;
    for (const Vec3& q : cells.source()) box = join(box, q);
    return box;
}

bool fillSourceBox(const MappedCells& cells) {
    const Vec3 size = sourceBox(cells).size();
    double volume = 0;
    for (const auto& t : cells.tetrahedra()) volume += std::abs(glm::determinant(sourceEdges(cells, t))) / 6;
    const double whole = size.x * size.y * size.z;
    return whole > 0 && std::abs(volume - whole) <= 1e-6 * whole;
}

std::vector<Vec4> findSourceFaces(const MappedCells& cells) {
    const Box3 box = sourceBox(cells);
    std::vector<Vec4> faces;
    if (fillSourceBox(cells)) {
        for (int a = 0; a < 3; ++a) {
            Vec3 normal(0);
            normal[a] = 1;
            faces.emplace_back(normal, -box.min[a]);
            faces.emplace_back(-normal, box.max[a]);
        }
        return faces;
    }
    if (cells.tetrahedra().empty()) return {};
    const double slack = kFlat * glm::length(box.size());
    Vec3 middle(0);
    for (const Vec3& q : cells.source()) middle += q / double(cells.source().size());
    faces = planesOf(cells, openTriangles(cells), middle, slack);
    const bool convex = std::all_of(cells.source().begin(), cells.source().end(), [&](const Vec3& q) {
        return std::all_of(faces.begin(), faces.end(),
                           [&](const Vec4& face) { return glm::dot(Vec3(face), q) + face.w >= -slack; });
    });
    // A little off the middle, where no faces of regular cells lie.
    const Vec3 inside = middle + 1e-3 * box.size() * Vec3(0.31, 0.74, -0.53);
    return convex && holding(cells, inside) == 1 ? faces : std::vector<Vec4>();
}

std::vector<Vec4> sourceFacesIn(const MappedCells& cells, const Mat4& spaceFromSource) {
    const Mat4 faceFromSourceFace = glm::transpose(glm::inverse(spaceFromSource));
    std::vector<Vec4> faces(cells.sourceFaces().begin(), cells.sourceFaces().end());
    for (Vec4& face : faces) {
        face = faceFromSourceFace * face;
        face /= glm::length(Vec3(face));
    }
    return faces;
}

std::vector<Vec4> facesThrough(std::vector<Vec4> faces, const Box3& box) {
    const double slack = kFlat * glm::length(box.size());
    std::erase_if(faces, [&](const Vec4& face) {
        double least = kInfinity;
        for (int c = 0; c < 8; ++c) least = std::min(least, glm::dot(Vec3(face), box.corner(c)) + face.w);
        return least >= -slack;
    });
    return faces;
}

}  // namespace voledit
