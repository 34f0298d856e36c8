#include "app/io/split_cells.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace voledit {

namespace {

/// A face's vertices, around it; a triangle ends in -1.
using Face = std::array<int, 4>;

struct Shape {
    std::size_t vertices = 0;
    std::vector<Face> faces;
};

const Shape& shapeOf(std::uint32_t type) {
    static const Shape none;
    static const std::map<std::uint32_t, Shape> shapes{
        {10, {4, {{0, 1, 2, -1}, {0, 1, 3, -1}, {0, 2, 3, -1}, {1, 2, 3, -1}}}},
        {11, {8, {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}}},
        {12, {8, {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}}},
        {13, {6, {{0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
        {14, {5, {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}}};
    const auto found = shapes.find(type);
    return found == shapes.end() ? none : found->second;
}

}  // namespace

std::size_t verticesOfCell(std::uint32_t type) {
    return shapeOf(type).vertices;
}

void appendTetrahedra(std::uint32_t type, std::span<const std::uint32_t> vertices,
                      std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
    const Shape& shape = shapeOf(type);
    assert(vertices.size() == shape.vertices && shape.vertices > 0);
    const std::uint32_t apex = *std::ranges::min_element(vertices);
    const auto append = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && a != c && b != c) tetrahedra.push_back({apex, a, b, c});
    };
    for (const Face& face : shape.faces) {
        const std::size_t sides = face[3] < 0 ? 3 : 4;
        std::array<std::uint32_t, 4> corner{};
        for (std::size_t n = 0; n < sides; ++n) corner[n] = vertices[std::size_t(face[n])];
        const auto first = corner.begin(), last = corner.begin() + std::ptrdiff_t(sides);
        if (std::find(first, last, apex) != last) continue;
        std::rotate(first, std::min_element(first, last), last);
        append(corner[0], corner[1], corner[2]);
        if (sides == 4) append(corner[0], corner[2], corner[3]);
    }
}

std::string nameOfCell(std::uint32_t type) {
    static const std::map<std::uint32_t, std::string> names{{0, "empty cell"},
                                                            {1, "vertex"},
                                                            {2, "poly-vertex"},
                                                            {3, "line"},
                                                            {4, "poly-line"},
                                                            {5, "triangle"},
                                                            {6, "triangle strip"},
                                                            {7, "polygon"},
                                                            {8, "pixel"},
                                                            {9, "quadrilateral"},
                                                            {15, "pentagonal prism"},
                                                            {16, "hexagonal prism"},
                                                            {21, "quadratic edge"},
                                                            {22, "quadratic triangle"},
                                                            {23, "quadratic quadrilateral"},
                                                            {24, "quadratic tetrahedron"},
                                                            {25, "quadratic hexahedron"},
                                                            {42, "polyhedron"}};
    const auto found = names.find(type);
    return found == names.end() ? "type " + std::to_string(type) : found->second;
}

}  // namespace voledit
