#include "core/rays/packet_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voledit {

namespace {

constexpr double kBeyond = 1e-3;  // voxels outside the domain that count as inside, as volume.h has it

Mat3 edges(const std::array<Vec3, 4>& v) {
    return Mat3(v[1] - v[0], v[2] - v[0], v[3] - v[0]);
}

bool before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The plane through the three vertices other than `v`. They are taken in an order of their own, so that both cells on
/// a face get the same numbers but for the sign.
Vec4 planeOpposite(std::size_t v, const std::array<Vec3, 4>& p) {
    std::array<Vec3, 3> face;
    for (std::size_t n = 0, at = 0; n < 4; ++n)
        if (n != v) face[at++] = p[n];
    std::sort(face.begin(), face.end(), before);
    const Vec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    const Vec4 plane(normal, -glm::dot(normal, face[0]));
    return glm::dot(normal, p[v] - face[0]) < 0 ? -plane : plane;
}

}  // namespace

PacketCell packetCell(const std::array<Vec3, 4>& p, const std::array<Vec3, 4>& x) {
    PacketCell cell{};
    for (std::size_t v = 0; v < 4; ++v) {
        const Vec4 plane = planeOpposite(v, p);
        for (int c = 0; c < 4; ++c) cell.plane[std::size_t(c)][v] = static_cast<float>(plane[c]);
    }
    const Mat3 stretch = edges(x) * glm::inverse(edges(p));
    const Vec3 offset = x[0] - stretch * p[0];
    for (int a = 0; a < 3; ++a) {
        for (int c = 0; c < 3; ++c) cell.index[std::size_t(c)][std::size_t(a)] = static_cast<float>(stretch[c][a]);
        cell.index[3][std::size_t(a)] = static_cast<float>(offset[a]);
    }
    return cell;
}

GradientTurn gradientTurn(const Mat3& turn) {
    GradientTurn result{};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) result[std::size_t(c)][std::size_t(r)] = static_cast<float>(turn[c][r]);
    return result;
}

bool touchesAny(std::span<const Vec4> faces, const std::array<Vec3, 4>& places, double slack) {
    return std::any_of(faces.begin(), faces.end(), [&](const Vec4& face) {
        return std::any_of(places.begin(), places.end(),
                           [&](const Vec3& place) { return std::abs(glm::dot(Vec3(face), place) + face.w) <= slack; });
    });
}

std::uint8_t sidesBeyond(const Box3& box, const Box3& domain) {
    unsigned sides = 0;
    for (int a = 0; a < 3; ++a) {
        if (box.min[a] < domain.min[a] - kBeyond) sides |= 1U << 2 * a;
        if (box.max[a] > domain.max[a] + kBeyond) sides |= 2U << 2 * a;
    }
    return std::uint8_t(sides);
}

bool PacketCells::hasEnds() const {
    return std::any_of(atEnd.begin(), atEnd.end(), [](std::uint8_t at) { return at; });
}

void PacketCells::findBounds() {
    bounds = {};
    for (const auto& vertices : corners)
        for (const std::uint32_t v : vertices) bounds = join(bounds, position[v]);
}

}  // namespace voledit
