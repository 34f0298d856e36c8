#include "core/skeleton/limb_jacobians.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voledit {
namespace {

/// Sums over a vertex' sides: (du/dp)·|volume| and |volume|.
struct Sum {
    Mat3 moved{0.0};
    double volume = 0;
};

/// Derivatives of p and u = p − q along the grid's lines at one vertex: `ahead` and `behind` are the neighbours, or the
/// vertex itself on an outer face.
struct Lines {
    std::uint32_t behind[3], ahead[3];
};

void add(std::span<const Vec3> deformed, std::span<const Vec3> source, const Lines& lines, const Vec3& cells,
         Sum& sum) {
    Mat3 p, u;
    double deformedSquare = 1, restSquare = 1;  // of the products of the lines' lengths
    for (int a = 0; a < 3; ++a) {
        const std::uint32_t behind = lines.behind[a], ahead = lines.ahead[a];
        const Vec3 q = (source[ahead] - source[behind]) * cells[a];
        p[a] = (deformed[ahead] - deformed[behind]) * cells[a];
        u[a] = p[a] - q;
        deformedSquare *= glm::dot(p[a], p[a]);
        restSquare *= glm::dot(q, q);
    }
    const Vec3 yz = glm::cross(p[1], p[2]);
    const Mat3 adjugate = glm::transpose(Mat3(yz, glm::cross(p[2], p[0]), glm::cross(p[0], p[1])));
    const double volume = glm::dot(p[0], yz);
    // A region that is nearly flat, or nearly a line, has no useful inverse: what one such vertex says must not drown
    // its neighbours.
    const double least = 1e-3 * std::sqrt(std::max(deformedSquare, restSquare));
    const double bounded = std::max(std::abs(volume), least);
    if (!(bounded > 0)) return;
    sum.moved += u * adjugate * (std::copysign(1.0, volume) * std::abs(volume) / bounded);
    sum.volume += std::abs(volume);
}

}  // namespace

std::vector<Mat3> limbJacobians(std::span<const Vec3> deformed, std::span<const Vec3> source, const LimbGrid& grid,
                                const LimbLayers& layers) {
    std::vector<Sum> sums(deformed.size());
    const Index3 cells = grid.cells;
    const std::uint32_t row = std::uint32_t(cells.x) + 1;
    for (const auto& limb : layers)
        for (int k = 0; k <= cells.z; ++k) {
            const std::size_t below = std::size_t(std::max(k - 1, 0)), above = std::size_t(std::min(k + 1, cells.z));
            for (int j = 0; j <= cells.y; ++j)
                for (int i = 0; i <= cells.x; ++i) {
                    const std::uint32_t in = std::uint32_t(i) + row * std::uint32_t(j), at = limb[std::size_t(k)] + in;
                    const Lines lines{{at - (i > 0), j > 0 ? at - row : at, limb[below] + in},
                                      {at + (i < cells.x), j < cells.y ? at + row : at, limb[above] + in}};
                    // Two cells inside, one on the faces.
                    const Vec3 spans(1.0 / ((i > 0) + (i < cells.x)), 1.0 / ((j > 0) + (j < cells.y)),
                                     1.0 / ((k > 0) + (k < cells.z)));
                    add(deformed, source, lines, spans, sums[at]);
                }
        }
    std::vector<Mat3> jacobians(deformed.size(), Mat3(1));
    for (std::size_t v = 0; v < sums.size(); ++v)
        if (sums[v].volume > 0) jacobians[v] = Mat3(1) - sums[v].moved / sums[v].volume;
    return jacobians;
}

}  // namespace voledit
