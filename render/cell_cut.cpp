#include "render/cell_cut.h"

#include <vector>

namespace voledit {

const std::array<std::array<int, 2>, 6> kTetrahedronEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
const std::array<std::array<int, 2>, 12> kBrickEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

namespace {

using Edges = std::span<const std::array<int, 2>>;
using Faces = std::span<const std::uint32_t>;  // masks of vertices

/// Each face that the plane meets joins two cut edges; walking from face to face gives the polygon.
CutPolygon cut(std::uint32_t mask, Edges edges, Faces faces) {
    std::vector<std::array<int, 2>> segments;
    for (const std::uint32_t face : faces) {
        std::vector<int> crossed;
        for (int e = 0; e < int(edges.size()); ++e) {
            const auto [a, b] = edges[std::size_t(e)];
            const bool onFace = (face >> a & 1) && (face >> b & 1);
            if (onFace && (mask >> a & 1) != (mask >> b & 1)) crossed.push_back(e);
        }
        if (crossed.size() > 2) return {};
        if (crossed.size() == 2) segments.push_back({crossed[0], crossed[1]});
    }
    CutPolygon polygon;
    if (segments.empty() || segments.size() > polygon.edge.size()) return {};
    int next = segments[0][0];
    std::vector<bool> used(segments.size(), false);
    for (std::size_t n = 0; n < segments.size(); ++n) {
        polygon.edge[polygon.count++] = std::uint8_t(next);
        for (std::size_t s = 0; s < segments.size(); ++s) {
            if (used[s] || (segments[s][0] != next && segments[s][1] != next)) continue;
            used[s] = true;
            next = segments[s][0] == next ? segments[s][1] : segments[s][0];
            break;
        }
    }
    // Two separate loops: no plane does that.
    return next == polygon.edge[0] ? polygon : CutPolygon{};
}

std::vector<CutPolygon> allCuts(int vertices, Edges edges, Faces faces) {
    std::vector<CutPolygon> cuts;
    for (std::uint32_t mask = 0; mask < 1U << vertices; ++mask) cuts.push_back(cut(mask, edges, faces));
    return cuts;
}

}  // namespace

std::span<const CutPolygon> tetrahedronCuts() {
    static const std::array<std::uint32_t, 4> faces{0b0111, 0b1011, 0b1101, 0b1110};
    static const auto cuts = allCuts(4, kTetrahedronEdges, faces);
    return cuts;
}

std::span<const CutPolygon> brickCuts() {
    static const std::array<std::uint32_t, 6> faces{0b01010101, 0b10101010, 0b00110011,
                                                    0b11001100, 0b00001111, 0b11110000};
    static const auto cuts = allCuts(8, kBrickEdges, faces);
    return cuts;
}

}  // namespace voledit
